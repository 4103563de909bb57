/// Several numbers at once: formulas written for `template <class Real>` serve one double and, with Real =
/// Lanes, four. Branches become select, max and min, which both have.
#pragma once

#ifdef __AVX__
#include <immintrin.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

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

/// To the nearest integer.
inline double round(double v) { return std::nearbyint(v); }
inline Lanes round(Lanes v) {
#ifdef __AVX__
  return _mm256_round_pd(v, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
#else
  return Lanes{std::nearbyint(v[0]), std::nearbyint(v[1]), std::nearbyint(v[2]), std::nearbyint(v[3])};
#endif
}

inline double max(double a, double b) { return std::max(a, b); }
inline Lanes max(Lanes a, Lanes b) { return a < b ? b : a; }
inline double min(double a, double b) { return std::min(a, b); }
inline Lanes min(Lanes a, Lanes b) { return b < a ? b : a; }

inline double abs(double v) { return std::abs(v); }
inline Lanes abs(Lanes v) { return max(v, -v); }

inline Lanes all_lanes(double v) { return Lanes{} + v; }
/// Four numbers one after another in memory.
inline Lanes load(const double* from) {
  Lanes v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
inline void store(Lanes v, double* to) { std::memcpy(to, &v, sizeof v); }

/// Bit k is set where lane k of a comparison holds.
template <class Mask>
unsigned bits(Mask where) {
#ifdef __AVX__
  return static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<__m256d>(where)));
#else
  unsigned set = 0;
  for (int lane = 0; lane < n_lanes; ++lane) set |= (where[lane] ? 1u : 0u) << lane;
  return set;
#endif
}

/// Whether a comparison holds in every lane, or in none.
inline bool holds_everywhere(bool where) { return where; }
template <class Mask>
bool holds_everywhere(Mask where) {
  return bits(where) == (1u << n_lanes) - 1;
}
inline bool holds_nowhere(bool where) { return !where; }
template <class Mask>
bool holds_nowhere(Mask where) {
  return bits(where) == 0;
}

/// Four records of four numbers become the four numbers of four records, and back.
inline void transpose(Lanes& a, Lanes& b, Lanes& c, Lanes& d) {
  typedef std::int64_t Order __attribute__((vector_size(32)));
  const Order even{0, 4, 2, 6}, odd{1, 5, 3, 7}, low{0, 1, 4, 5}, high{2, 3, 6, 7};
  const Lanes ab_even = __builtin_shuffle(a, b, even), ab_odd = __builtin_shuffle(a, b, odd);
  const Lanes cd_even = __builtin_shuffle(c, d, even), cd_odd = __builtin_shuffle(c, d, odd);
  a = __builtin_shuffle(ab_even, cd_even, low);
  b = __builtin_shuffle(ab_odd, cd_odd, low);
  c = __builtin_shuffle(ab_even, cd_even, high);
  d = __builtin_shuffle(ab_odd, cd_odd, high);
}

}  // namespace fpi
