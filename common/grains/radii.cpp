#include "grains/radii.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fpi::grains {
namespace {

/// ∫ r^power dr over the class.
double moment(const SizeClass& c, double power) {
  if (power == -1) return std::log(c.largest / c.smallest);
  return (std::pow(c.largest, power + 1) - std::pow(c.smallest, power + 1)) / (power + 1);
}

/// Of the mean grain of a class [m³ or m²].
double mean_volume(const SizeClass& c, std::size_t axes) {
  const auto d = static_cast<double>(axes);
  if (c.smallest == c.largest) return unit_volume(axes) * std::pow(c.smallest, d);
  return unit_volume(axes) * moment(c, d - c.exponent) / moment(c, -c.exponent);
}

/// The radius below which a part u of the grains of a class are.
double quantile(const SizeClass& c, double u) {
  const double power = 1 - c.exponent;
  const double low = std::pow(c.smallest, power), high = std::pow(c.largest, power);
  return std::clamp(std::pow(low + u * (high - low), 1 / power), c.smallest, c.largest);
}

std::vector<double> radii_of_counts(const std::vector<SizeClass>& classes,
                                    const std::vector<std::size_t>& counts) {
  std::vector<double> radii;
  for (std::size_t i = 0; i < classes.size(); ++i) {
    const auto n = static_cast<double>(counts[i]);
    for (std::size_t k = 0; k < counts[i]; ++k)
      radii.push_back(quantile(classes[i], (static_cast<double>(k) + 0.5) / n));
  }
  std::ranges::sort(radii, std::greater());
  return radii;
}

}  // namespace

double unit_volume(std::size_t axes) { return axes == 2 ? std::numbers::pi : 4.0 / 3.0 * std::numbers::pi; }

std::vector<SizeClass> size_classes(const scene::Grains& group) {
  if (!group.radius_range.empty()) return {{group.radius_range[0], group.radius_range[1], 0, 1}};
  if (group.sieve_sizes.empty()) return {{group.radius, group.radius, 0, 1}};
  // Mass linear in log r: volume density ~ 1/r, so numbers ~ r^-(d + 1).
  const double exponent = static_cast<double>(group.axes()) + 1;
  std::vector<SizeClass> classes;
  for (std::size_t i = 1; i < group.sieve_sizes.size(); ++i)
    classes.push_back({group.sieve_sizes[i - 1] / 2, group.sieve_sizes[i] / 2, exponent,
                       (group.passing[i] - group.passing[i - 1]) / 100});
  return classes;
}

double number_density(const std::vector<SizeClass>& classes, std::size_t axes) {
  double number = 0;
  for (const SizeClass& c : classes) number += c.share / mean_volume(c, axes);
  return number;
}

std::vector<double> radii_of_volume(const std::vector<SizeClass>& classes, std::size_t axes, double volume) {
  std::vector<std::size_t> counts;
  for (const SizeClass& c : classes)
    counts.push_back(static_cast<std::size_t>(std::lround(c.share * volume / mean_volume(c, axes))));
  return radii_of_counts(classes, counts);
}

std::vector<double> radii_of_count(const std::vector<SizeClass>& classes, std::size_t axes,
                                   std::size_t count) {
  const double total = number_density(classes, axes);
  std::vector<std::size_t> counts;
  double so_far = 0;
  std::size_t given = 0;
  for (const SizeClass& c : classes) {
    so_far += c.share / mean_volume(c, axes) / total;
    const auto until = static_cast<std::size_t>(std::lround(so_far * static_cast<double>(count)));
    counts.push_back(until - given);
    given = until;
  }
  return radii_of_counts(classes, counts);
}

}  // namespace fpi::grains
