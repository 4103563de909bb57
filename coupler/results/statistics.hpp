/// Counts over the steps of a run: what the coupling took, and what it had to do again. Means leave out the
/// first five steps where there are more, since those start without history.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "step/coupled_state.hpp"

namespace fpi {

class Statistics {
 public:
  static constexpr std::uint64_t steps_left_out = 5;
  static constexpr std::size_t n_remedies = 3;

  void add_step(const Attempt& attempt);
  /// A step that did not converge, and one that is repeated although it did.
  void add_rejected() { ++rejected_; }
  void add_repeated() { ++repeated_; }
  /// What was done against stalls, in steps accepted or not.
  void add_stalls(const Attempt& attempt);

  std::uint64_t steps() const { return steps_; }
  std::uint32_t max_sub_iterations() const { return max_; }
  double mean_sub_iterations() const;
  double largest_overlap() const { return largest_overlap_; }  ///< [m]
  std::uint64_t rejected() const { return rejected_; }
  std::uint64_t repeated() const { return repeated_; }
  std::uint64_t recuts() const { return recuts_; }
  const std::array<std::uint64_t, n_remedies>& remedies() const { return remedies_; }
  double mean_columns() const { return steps_ == 0 ? 0 : columns_ / static_cast<double>(steps_); }
  std::uint64_t most_columns() const { return most_columns_; }
  std::uint64_t dropped_columns() const { return dropped_; }
  double largest_displacement() const { return displacement_; }  ///< of h
  double largest_miss() const { return miss_; }                  ///< of h
  /// The unknown that had the largest residual in most steps of several sub-iterations, and in how many.
  struct Worst {
    Eigen::Index unknown;
    std::uint64_t steps;
  };
  std::optional<Worst> worst() const;

  std::vector<double> numbers() const;
  void set_numbers(const std::vector<double>& numbers);

 private:
  template <class Visit>
  void each_number(Visit visit);

  std::uint64_t steps_ = 0, early_ = 0, late_ = 0;  ///< sub-iterations of the first five and the rest
  std::uint32_t max_ = 0;
  double largest_overlap_ = 0, columns_ = 0, displacement_ = 0, miss_ = 0;
  std::uint64_t rejected_ = 0, repeated_ = 0, recuts_ = 0, most_columns_ = 0, dropped_ = 0;
  std::array<std::uint64_t, n_remedies> remedies_{};
  std::vector<std::uint64_t> worst_;  ///< steps in which each unknown was
};

}  // namespace fpi
