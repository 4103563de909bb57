/// The factor that one step leaves to the next, to be used as it is or, where bodies have moved, as the
/// reference of another. It is kept until a step with it costs more than its steps did on average, its
/// making included: from there on the average would rise, so a new factor is cheaper.
#pragma once

#include "fluid/solve/newton.hpp"

namespace fpi::fluid {

class FactorCache {
 public:
  /// For a step of this inertia [1/s], a fifth more or less than that of the reference. Another system than
  /// the one that left it gets the reference alone.
  Corrector lend(double inertia, bool is_same_system) const;
  /// Takes what an accepted step ended with.
  void take(const Corrector& corrector);
  void drop() { *this = {}; }
  /// From here on the next step is as if there were no factor: only one that it would make again, to the bit,
  /// is lent.
  void forget() { is_forgotten_ = true; }

 private:
  Corrector corrector_;
  unsigned steps_ = 0;  // that its reference has served
  bool is_forgotten_ = false;
};

}  // namespace fpi::fluid
