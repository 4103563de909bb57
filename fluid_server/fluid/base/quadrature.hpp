/// Quadrature on the unit interval and on the reference triangle, as compile-time tables.
#pragma once

#include <array>
#include <span>

namespace fpi::fluid {

/// A point s in [0, 1] with its weight; the weights of a rule add up to 1.
struct LinePoint {
  double s, weight;
};
/// Gauss–Legendre rule with n = 1 … 8 points: exact to degree 2n − 1.
std::span<const LinePoint> gauss_legendre(int n);

/// A point of the reference triangle by its barycentric coordinates; the weights of a rule add up to 1.
struct TrianglePoint {
  double l0, l1, l2, weight;
};

/// Radon's seven points, exact to degree 5: enough for P2 × (P2 · ∇P2), and so for every term of eq. (9).
inline constexpr std::array<TrianglePoint, 7> triangle_degree_5 = [] {
  constexpr double a = 0.059715871789769820, b = 0.470142064105115090, wa = 0.132394152788506181;
  constexpr double c = 0.797426985353087322, d = 0.101286507323456339, wc = 0.125939180544827153;
  constexpr double third = 1.0 / 3.0;
  return std::array<TrianglePoint, 7>{{{third, third, third, 0.225},
                                       {a, b, b, wa},
                                       {b, a, b, wa},
                                       {b, b, a, wa},
                                       {c, d, d, wc},
                                       {d, c, d, wc},
                                       {d, d, c, wc}}};
}();

/// Dunavant's twelve points, exact to degree 6 (Int. J. Numer. Methods Eng. 21, 1985).
inline constexpr std::array<TrianglePoint, 12> triangle_degree_6 = [] {
  constexpr double a = 0.501426509658179, b = 0.249286745170910, wa = 0.116786275726379;
  constexpr double c = 0.873821971016996, d = 0.063089014491502, wc = 0.050844906370207;
  constexpr double e = 0.053145049844817, f = 0.310352451033784, g = 0.636502499121399,
                   we = 0.082851075618374;
  return std::array<TrianglePoint, 12>{{{a, b, b, wa},
                                        {b, a, b, wa},
                                        {b, b, a, wa},
                                        {c, d, d, wc},
                                        {d, c, d, wc},
                                        {d, d, c, wc},
                                        {e, f, g, we},
                                        {e, g, f, we},
                                        {f, e, g, we},
                                        {f, g, e, we},
                                        {g, e, f, we},
                                        {g, f, e, we}}};
}();

}  // namespace fpi::fluid
