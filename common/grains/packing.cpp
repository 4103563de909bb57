#include "grains/packing.hpp"

#include <algorithm>
#include <numeric>
#include <random>

#include "grains/close_pairs.hpp"
#include "grains/radii.hpp"

namespace fpi::grains {
namespace {

constexpr int most_iterations = 20000;
/// Net over pair forces below which overlaps hold each other in balance.
constexpr double balance = 1e-5;

/// In [0, 1); std::uniform_real_distribution is not the same everywhere.
double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

/// How much larger than asked for all distances are aimed at, so that the last of each overlap need not be
/// waited for: a third of the way to where spheres jam.
double inflation_for(const Box& box, std::span<const double> radii, double gap) {
  const double jammed = box.axes == 2 ? 0.84 : 0.64;
  double volume = 0;
  for (const double radius : radii)
    volume += unit_volume(box.axes) * std::pow(radius + gap / 2, static_cast<double>(box.axes));
  const double room = std::pow(jammed * box.volume() / volume, 1 / static_cast<double>(box.axes)) - 1;
  return std::clamp(room / 3, 1e-3, 0.05);
}

/// The order in which points follow each other along rows of cells, so that neighbours lie close in memory.
std::vector<std::size_t> order_along_rows(const Box& box, const std::vector<Vec3>& points) {
  const double per_axis = std::pow(static_cast<double>(points.size()), 1 / static_cast<double>(box.axes));
  std::vector<std::array<int, 3>> cells;
  for (const Vec3& point : points) {
    std::array<int, 3>& cell = cells.emplace_back();
    for (std::size_t k = 0; k < box.axes; ++k)
      cell[2 - k] = static_cast<int>(per_axis * (point[k] - box.lower[k]) / (box.upper[k] - box.lower[k]));
  }
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&cells](std::size_t i) { return cells[i]; });
  return order;
}

/// Soft spheres in a box: unit masses, overlaps pushed back by unit springs.
class SoftSpheres {
 public:
  SoftSpheres(const Box& box, std::span<const double> radii, double gap, std::span<const Sphere> obstacles,
              std::uint64_t seed)
      : box_(box), gap_(gap), inflation_(inflation_for(box, radii, gap)), n_(radii.size()) {
    std::mt19937_64 random(seed);
    std::vector<Vec3> points(n_);
    for (Vec3& point : points)
      for (std::size_t k = 0; k < box.axes; ++k)
        point[k] = box.lower[k] + uniform(random) * (box.upper[k] - box.lower[k]);
    order_ = order_along_rows(box, points);
    for (const std::size_t i : order_) spheres_.push_back({points[i], radii[i]});
    skin_ = 0.6 * std::accumulate(radii.begin(), radii.end(), 0.0) / static_cast<double>(n_);
    spheres_.insert(spheres_.end(), obstacles.begin(), obstacles.end());
    velocities_.resize(n_);
    forces_.resize(spheres_.size());
  }

  /// False where they jam.
  bool relax() {
    constexpr double first_step = 0.1, largest_step = 0.5, first_mixing = 0.1;
    double step = first_step, mixing = first_mixing;
    int downhill = 0;
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      if (!overlap()) return true;
      if (is_balanced()) return false;
      if (power() > 0) {
        mix(mixing);
        if (++downhill > 5) {
          step = std::min(1.1 * step, largest_step);
          mixing *= 0.99;
        }
      } else {
        std::ranges::fill(velocities_, Vec3{});
        step *= 0.5;
        mixing = first_mixing;
        downhill = 0;
      }
      move(step);
    }
    return false;
  }

  /// In the order of the radii.
  std::vector<Vec3> centres() const {
    std::vector<Vec3> out(n_);
    for (std::size_t i = 0; i < n_; ++i) out[order_[i]] = spheres_[i].centre;
    return out;
  }

 private:
  /// Forces; true where a distance is smaller than asked for.
  bool overlap() {
    if (searched_.empty() || moved_far()) search();
    std::ranges::fill(forces_, Vec3{});
    squared_pair_forces_ = 0;
    bool any = false;
    for (const auto& [a, b] : pairs_) {
      const Vec3 d = difference(spheres_[a].centre, spheres_[b].centre, box_.periods);
      const double wanted = spheres_[a].radius + spheres_[b].radius + gap_, aim = (1 + inflation_) * wanted;
      const double squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
      if (squared >= aim * aim || squared == 0) continue;
      const double distance = std::sqrt(squared), push = (aim - distance) / distance;
      any = any || distance < wanted;
      squared_pair_forces_ += (aim - distance) * (aim - distance);
      for (std::size_t k = 0; k < box_.axes; ++k) {
        forces_[a][k] -= push * d[k];
        forces_[b][k] += push * d[k];
      }
    }
    std::fill(forces_.begin() + static_cast<std::ptrdiff_t>(n_), forces_.end(), Vec3{});  // obstacles stay
    for (std::size_t i = 0; i < n_; ++i) any = sides(i) || any;
    return any;
  }

  /// The sides of the box push grains in.
  bool sides(std::size_t i) {
    bool any = false;
    const double radius = spheres_[i].radius, reach = (1 + inflation_) * radius;
    for (std::size_t k = 0; k < box_.axes; ++k) {
      if (box_.periods[k] > 0) continue;
      const double low = spheres_[i].centre[k] - box_.lower[k], high = box_.upper[k] - spheres_[i].centre[k];
      forces_[i][k] += std::max(0.0, reach - low) - std::max(0.0, reach - high);
      any = any || low < radius || high < radius;
    }
    return any;
  }

  void search() {
    pairs_ = close_pairs(spheres_, gap_ + inflation_ * (largest_diameter() + gap_) + skin_, box_.periods);
    std::erase_if(pairs_, [this](const IndexPair& pair) { return pair[0] >= n_; });
    searched_ = spheres_;
  }
  double largest_diameter() const { return 2 * std::ranges::max(spheres_, {}, &Sphere::radius).radius; }
  bool moved_far() const {
    for (std::size_t i = 0; i < n_; ++i)
      if (length(difference(searched_[i].centre, spheres_[i].centre, {})) > skin_ / 2) return true;
    return false;
  }

  bool is_balanced() const {
    double squared = 0;
    for (const Vec3& force : forces_)
      squared += force[0] * force[0] + force[1] * force[1] + force[2] * force[2];
    return squared < balance * balance * squared_pair_forces_;
  }
  double power() const {
    double sum = 0;
    for (std::size_t i = 0; i < n_; ++i)
      for (std::size_t k = 0; k < 3; ++k) sum += forces_[i][k] * velocities_[i][k];
    return sum;
  }
  /// Turns the velocities towards the forces: v ← (1 − α) v + α |v| F/|F|.
  void mix(double alpha) {
    double speed = 0, force = 0;
    for (std::size_t i = 0; i < n_; ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        speed += velocities_[i][k] * velocities_[i][k];
        force += forces_[i][k] * forces_[i][k];
      }
    const double along = force > 0 ? alpha * std::sqrt(speed / force) : 0;
    for (std::size_t i = 0; i < n_; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        velocities_[i][k] = (1 - alpha) * velocities_[i][k] + along * forces_[i][k];
  }
  void move(double step) {
    for (std::size_t i = 0; i < n_; ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        velocities_[i][k] += step * forces_[i][k];
        spheres_[i].centre[k] += step * velocities_[i][k];
      }
  }

  Box box_;
  double gap_;  ///< [m]
  double inflation_;
  std::size_t n_;    ///< spheres that move; obstacles follow them
  double skin_ = 0;  ///< [m]
  double squared_pair_forces_ = 0;
  std::vector<std::size_t> order_;          ///< number of the radius of each
  std::vector<Sphere> spheres_, searched_;  ///< now, and at the last search
  std::vector<Vec3> velocities_, forces_;
  std::vector<IndexPair> pairs_;
};

/// Back into the box, where grains went around it.
void wrap(const Box& box, std::vector<Vec3>& centres) {
  for (Vec3& centre : centres)
    for (std::size_t k = 0; k < box.axes; ++k)
      if (box.periods[k] > 0)
        centre[k] -= box.periods[k] * std::floor((centre[k] - box.lower[k]) / box.periods[k]);
}

}  // namespace

std::optional<std::vector<Vec3>> pack(const Box& box, std::span<const double> radii, double gap,
                                      std::span<const Sphere> obstacles, std::uint64_t seed) {
  SoftSpheres spheres(box, radii, gap, obstacles, seed);
  if (!spheres.relax()) return std::nullopt;
  std::vector<Vec3> centres = spheres.centres();
  wrap(box, centres);
  return centres;
}

}  // namespace fpi::grains
