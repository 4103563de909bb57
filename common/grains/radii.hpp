/// The sizes of the grains of a group: one radius, a range, or a grading curve. Radii are spread evenly over
/// their distribution instead of drawn from it, so that few grains follow the curve as well as many.
#pragma once

#include <cstddef>
#include <vector>

#include "scene/grains.hpp"

namespace fpi::grains {

/// Radii between two limits with a number density ~ r^-exponent, and the class's share of the volume.
struct SizeClass {
  double smallest, largest;  ///< [m]
  double exponent;
  double share;
};

/// One class for a radius or a range (as many small as large grains); one a sieve interval for a grading
/// curve, between whose points the mass passing is linear in the logarithm of the size.
std::vector<SizeClass> size_classes(const scene::Grains& group);

/// Largest first, classes mixed: radii [m] whose volumes (areas of discs) add up to `volume` as nearly as
/// whole grains can.
std::vector<double> radii_of_volume(const std::vector<SizeClass>& classes, std::size_t axes, double volume);

/// The same for a number of grains.
std::vector<double> radii_of_count(const std::vector<SizeClass>& classes, std::size_t axes,
                                   std::size_t count);

/// Grains in a unit of solid volume (area of discs).
double number_density(const std::vector<SizeClass>& classes, std::size_t axes);

/// Of a grain of radius 1: π of a disc, 4/3 π of a sphere.
double unit_volume(std::size_t axes);

}  // namespace fpi::grains
