#include "dem/neighbours.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace fpi::dem {
namespace {

constexpr std::size_t few = 16;           ///< bodies
constexpr std::size_t few_facets = 64;    ///< of walls
constexpr double skin_over_radius = 0.4;  ///< of the mean radius

/// Bodies sorted into cubes no smaller than the reach of any pair.
class Grid {
 public:
  Grid(const std::vector<Vec3>& position, double reach) : lower_(position[0]) {
    Vec3 upper = position[0];
    for (const Vec3& x : position) {
      lower_ = lower_.cwiseMin(x);
      upper = upper.cwiseMax(x);
    }
    choose_cells(upper - lower_, reach, 2 * position.size());
    std::vector<std::size_t> cell(position.size());
    start_.assign(n_[0] * n_[1] * n_[2] + 1, 0);
    for (std::size_t i = 0; i < position.size(); ++i) {
      cell[i] = index(coordinates(position[i]));
      ++start_[cell[i] + 1];
    }
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    body_.resize(position.size());
    std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
    for (std::size_t i = 0; i < position.size(); ++i) body_[next[cell[i]]++] = static_cast<std::uint32_t>(i);
  }

  /// Calls visit(j) for every body in the cell of x and those around it.
  template <class Visit>
  void around(const Vec3& x, Visit visit) const {
    const auto c = coordinates(x);
    const auto first = [&](int d) { return c[d] - std::min<std::size_t>(c[d], 1); };
    const auto last = [&](int d) { return std::min(c[d] + 1, n_[d] - 1); };
    for (std::size_t k = first(2); k <= last(2); ++k) {
      for (std::size_t j = first(1); j <= last(1); ++j) {
        const std::size_t row = (k * n_[1] + j) * n_[0];
        for (std::size_t at = start_[row + first(0)]; at < start_[row + last(0) + 1]; ++at) visit(body_[at]);
      }
    }
  }

 private:
  /// Cubes of at least `reach`, enlarged until there are no more than `most`.
  void choose_cells(const Vec3& extent, double reach, std::size_t most) {
    for (size_ = reach;; size_ *= 1.25) {
      double product = 1;
      for (int d = 0; d < 3; ++d) product *= std::floor(extent[d] / size_) + 1;
      if (product > static_cast<double>(most)) continue;
      for (int d = 0; d < 3; ++d) n_[d] = static_cast<std::size_t>(extent[d] / size_) + 1;
      return;
    }
  }
  std::array<std::size_t, 3> coordinates(const Vec3& x) const {
    std::array<std::size_t, 3> c;
    for (int d = 0; d < 3; ++d)
      c[d] = std::min(static_cast<std::size_t>((x[d] - lower_[d]) / size_), n_[d] - 1);
    return c;
  }
  std::size_t index(const std::array<std::size_t, 3>& c) const {
    return (c[2] * n_[1] + c[1]) * n_[0] + c[0];
  }

  Vec3 lower_;
  double size_ = 0;
  std::array<std::size_t, 3> n_{};
  std::vector<std::size_t> start_;  ///< of each cell in body_
  std::vector<std::uint32_t> body_;
};

double choose_skin(const Model& model) {
  const Bodies& bodies = model.bodies;
  if (lists_every_pair(model)) return std::numeric_limits<double>::infinity();
  const double sum = std::accumulate(bodies.radius.begin(), bodies.radius.end(), 0.0);
  return skin_over_radius * sum / static_cast<double>(bodies.size());
}

std::vector<Pair> near_pairs(const Model& model, const std::vector<Vec3>& position, double widest_gap) {
  const Bodies& bodies = model.bodies;
  const auto n = static_cast<std::uint32_t>(bodies.size());
  const double largest = *std::ranges::max_element(bodies.radius);
  const Grid grid(position, 2 * largest + widest_gap);
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < n; ++i) {
    const auto add_if_near = [&](std::uint32_t j) {
      const Pair pair{i, j};
      const bool moves = bodies.is_free(i) || bodies.is_free(j);
      if (moves && separation(model, position, pair).gap <= widest_gap) pairs.push_back(pair);
    };
    const std::size_t first = pairs.size();
    grid.around(position[i], [&](std::uint32_t j) {
      if (j > i) add_if_near(j);
    });
    std::sort(pairs.begin() + static_cast<std::ptrdiff_t>(first), pairs.end());
  }
  return pairs;
}

}  // namespace

bool lists_every_pair(const Model& model) {
  return model.bodies.size() <= few && model.walls.facets.size() <= few_facets;
}

void search(const Model& model, const std::vector<Vec3>& position, double reach, Neighbours& neighbours) {
  neighbours.skin = choose_skin(model);
  neighbours.reach = reach;
  neighbours.replace(near_pairs(model, position, neighbours.widest_gap()));
  neighbours.origin = position;
}

Near near(const Model& model, const std::vector<Vec3>& position, const Pair& pair) {
  return {pair.a, pair.b, separation(model, position, pair),
          model.laws(model.bodies.material[pair.a], model.bodies.material[pair.b])};
}

std::string names(const Model& model, const Pair& pair) {
  return model.bodies.name[pair.a] + " and " + model.bodies.name[pair.b];
}

}  // namespace fpi::dem
