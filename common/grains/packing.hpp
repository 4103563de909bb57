/// Random packings: centres without order and without overlap.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "grains/sphere.hpp"

namespace fpi::grains {

/// Places for spheres of these radii in a box, at least `gap` [m] apart from each other and from `obstacles`.
/// Points thrown at random push each other apart until no two overlap (soft spheres, the energy of their
/// overlaps minimised by FIRE: Bitzek et al., Phys. Rev. Lett. 97, 170201, 2006), which ends where the
/// spheres jam: near 0.84 of the area for discs, 0.64 of the volume for spheres. Nothing where they do.
std::optional<std::vector<Vec3>> pack(const Box& box, std::span<const double> radii, double gap,
                                      std::span<const Sphere> obstacles, std::uint64_t seed);

}  // namespace fpi::grains
