/// Several numbers at once: formulas written for `template <class Real>` serve one double and, with Real =
/// Lanes, four. Branches become select, max and min, which both have.
#pragma once

#ifdef __AVX__
#include <immintrin.h>
#endif

#include <algorithm>
#include <cmath>

namespace fpi {

/// Four doubles; arithmetic and comparison act on each.
typedef double Lanes __attribute__((vector_size(32)));
inline constexpr int n_lanes = 4;

/// Number `lane` of a value that holds one or several.
inline double& part(double& value, int) { return value; }
inline double& part(Lanes& value, int lane) { return reinterpret_cast<double*>(&value)[lane]; }

/// a where `where`, else b. Both are computed.
inline double select(bool where, double a, double b) { return where ? a : b; }
template <class Mask>
Lanes select(Mask where, Lanes a, Lanes b) {
  return where ? a : b;
}

inline double sqrt(double v) { return std::sqrt(v); }
inline Lanes sqrt(Lanes v) {
#ifdef __AVX__
  return _mm256_sqrt_pd(v);
#else
  return Lanes{std::sqrt(v[0]), std::sqrt(v[1]), std::sqrt(v[2]), std::sqrt(v[3])};
#endif
}

inline double max(double a, double b) { return std::max(a, b); }
inline Lanes max(Lanes a, Lanes b) { return a < b ? b : a; }
inline double min(double a, double b) { return std::min(a, b); }
inline Lanes min(Lanes a, Lanes b) { return b < a ? b : a; }

}  // namespace fpi
