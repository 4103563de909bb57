/// The factor that one step leaves to the next. It is kept until a step with it costs more than its steps did
/// on average, its making included: from there on the average would rise, so a new factor is cheaper.
#pragma once

#include "fluid/newton.hpp"

namespace fpi::fluid {

class KeptFactor {
 public:
  /// Gives the factor to a step of this inertia [1/s], or none where it does not fit. A linear
  /// problem trusts a factor, so there it must fit to the bit; else a fifth more or less serves.
  void lend(Iterate& iterate, double inertia, bool is_linear) const;
  /// Takes what an accepted step ended with.
  void take(const Iterate& iterate, double inertia);
  void drop() { *this = {}; }

 private:
  std::shared_ptr<const Factor> factor_;
  double cost_ = 0;     // of the factor and all solves with it
  unsigned steps_ = 0;  // that it has served
  double inertia_ = 0;  // of the last of them
};

}  // namespace fpi::fluid
