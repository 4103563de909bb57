/// The direct solver behind one small interface: analyse a pattern, factor values, solve. UMFPACK stays in
/// the source; every status it returns is checked.
#pragma once

#include <memory>

#include "fluid/block_matrix.hpp"
#include "fluid/types.hpp"

namespace fpi::fluid {

/// The ordering of a pattern, found once and shared by all factors of it.
class Analysis {
 public:
  explicit Analysis(const BlockMatrix& matrix);
  ~Analysis();
  Analysis(const Analysis&) = delete;
  Analysis& operator=(const Analysis&) = delete;
  void* handle() const { return symbolic_; }

 private:
  void* symbolic_ = nullptr;
};

/// LU factors of a matrix; never changed once made.
class Factor {
 public:
  /// Throws Error when there is not enough memory. A singular matrix gives `is_singular`.
  Factor(std::shared_ptr<const Analysis> analysis, const BlockMatrix& matrix);
  ~Factor();
  Factor(const Factor&) = delete;
  Factor& operator=(const Factor&) = delete;

  bool is_singular() const { return is_singular_; }
  /// x with A x = b.
  Vector solve(const Vector& b) const;

 private:
  std::shared_ptr<const Analysis> analysis_;
  Index n_;
  void* numeric_ = nullptr;
  bool is_singular_ = false;
};

}  // namespace fpi::fluid
