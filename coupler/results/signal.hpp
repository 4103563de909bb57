/// What a sampled signal shows: extrema by a parabola through three samples, mean, and the frequency of its
/// oscillation from crossings of the mean over whole periods.
#pragma once

#include <optional>
#include <span>

namespace fpi {

struct Extremum {
  double value = 0;
  double time = 0;  ///< [s]
};

struct Oscillation {
  double frequency = 0;    ///< [1/s]
  int periods = 0;         ///< whole ones
  double peak_spread = 0;  ///< largest less smallest of the last five peaks, over the range of the signal

  /// Enough periods, and their peaks hardly differ.
  bool is_settled() const { return periods >= 5 && peak_spread <= 0.01; }
};

struct SignalFigures {
  Extremum smallest, largest;
  double mean = 0;  ///< over whole periods where it oscillates, else over all
  std::optional<Oscillation> oscillation;
};

/// Of samples in the order of time; of equal number, at least one.
SignalFigures analyse_signal(std::span<const double> time, std::span<const double> value);

}  // namespace fpi
