/// Lubrication between two surfaces that are close to each other, as free functions of values: what a film
/// resists with, and how much of that a mesh does not resolve (docs/numerics.md, "Lubrication").
#pragma once

namespace fpi::dem {

/// Forces per speed [N s/m] of a film. With n from a to b, t along the surface, e = n × t, and spins w
/// relative to the line of centres (which turns at ω_L):
/// - normal: of the speed at which the surfaces approach along n;
/// - sliding: of R_a w_a + R_b w_b, the speed of one surface over the other;
/// - rolling: of R_a w_a − R_b w_b, twice the speed at which both drag the liquid through the gap.
struct Resistance {
  double normal = 0, sliding = 0, rolling = 0;
};

/// Shape of a gap: R_eff = R_a R_b/(R_a + R_b) and R_a + R_b [m]; a wall has R_b = ∞, so R_a and ∞.
struct GapShape {
  double radius, sum;
};
GapShape gap_shape(double radius_a, double radius_b);

/// Between discs, with ε = gap/R_eff: normal 3√2 π μ ε^(−3/2) [1 + (21/20 − 3/4 R_eff/(R_a + R_b)) ε],
/// sliding and rolling √2 π μ ε^(−1/2). `viscosity` is μ times the thickness [Pa s m]. Relative errors O(ε²)
/// and O(ε).
Resistance disc_film(double viscosity, const GapShape& shape, double gap);

/// Between spheres (Jeffrey & Onishi 1984): 6π μ R_eff [1/ε + (1/5 + R_eff/(R_a + R_b)) ln 1/ε],
/// 2π μ R_eff ln 1/ε, 6/5 π μ R_eff ln 1/ε. `viscosity` μ [Pa s]. Errors O(1) beside 1/ε and ln 1/ε.
Resistance sphere_film(double viscosity, const GapShape& shape, double gap);

using LubricationFilm = Resistance (*)(double viscosity, const GapShape& shape, double gap);

/// What a mesh that resolves gaps from `resolved` [m] on does not see of a film, none at wider gaps. At
/// narrower ones it resists as the film does at a wider gap, gap + s · resolved (1 − gap/resolved)^m: s and m
/// were measured on our fluid (docs/numerics.md). Without a mesh, `resolved` = 0, films fade out at R_eff.
Resistance unresolved(LubricationFilm law, double viscosity, const GapShape& shape, double gap,
                      double resolved);

}  // namespace fpi::dem
