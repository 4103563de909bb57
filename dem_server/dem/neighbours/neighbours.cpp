#include "dem/neighbours/neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/parallel.hpp"
#include "dem/neighbours/cells.hpp"
#include "dem/neighbours/images.hpp"

namespace fpi::dem {
namespace {

constexpr std::size_t few = 16;           ///< bodies
constexpr std::size_t few_facets = 64;    ///< of walls
constexpr double skin_over_radius = 0.4;  ///< of the mean radius
constexpr std::size_t chunk = 1024;       ///< bodies whose neighbours one thread looks for at once
constexpr std::size_t slab_size = 256;    ///< bodies that a slab has on average, at least

double mean_radius(const Bodies& bodies) {
  const double sum = std::accumulate(bodies.radius.begin(), bodies.radius.end(), 0.0);
  return sum / static_cast<double>(bodies.size());
}

double largest_radius(const Bodies& bodies) { return *std::ranges::max_element(bodies.radius); }

/// In a periodic box no pair may be within its skin of each other in two ways; where every pair is listed,
/// none may come to touch by another way than the shortest before the next search.
double choose_skin(const Model& model, double reach) {
  const bool every = lists_every_pair(model);
  double skin =
      every ? std::numeric_limits<double>::infinity() : skin_over_radius * mean_radius(model.bodies);
  for (const double length : model.periodic.length)
    if (length > 0)
      skin = std::min(skin, 0.5 * length - 2 * largest_radius(model.bodies) - (every ? 0 : reach));
  return skin;
}

/// Where the bodies are, in a periodic box if there is one.
std::vector<Record> places_of(const Model& model, const std::vector<Vec3>& position,
                              const std::vector<std::uint32_t>& order) {
  std::vector<Record> places;
  places.reserve(order.size());
  for (const std::uint32_t i : order) {
    const Vec3 x = model.periodic.inside(position[i]);
    places.emplace_back(x.x(), x.y(), x.z(), model.bodies.radius[i]);
  }
  return places;
}

std::vector<std::uint32_t> scene_order(std::size_t n) {
  std::vector<std::uint32_t> order(n);
  std::iota(order.begin(), order.end(), 0u);
  return order;
}

/// Of slabs in a ring none may be thin, as the last is, and every other one must be free of the rest: it
/// takes an even number. `first` are their first particles.
void close_ring(std::vector<std::uint32_t>& first) {
  if (first.size() > 1) first.pop_back();
  if (first.size() > 1 && first.size() % 2 == 1) first.pop_back();
}

/// Sorts the bodies into slabs across the longest axis, which it returns, no thinner than `reach` [m], and
/// within a slab by cells of `width` [m].
int sort_bodies(const Model& model, const std::vector<Vec3>& position, double reach, double width,
                Neighbours& found) {
  const std::size_t n = position.size();
  const std::vector<Record> places = places_of(model, position, scene_order(n));
  const Cells cells(places, width);
  const Cells::Index& along = cells.along();
  const std::size_t slow = static_cast<std::size_t>(std::ranges::max_element(along) - along.begin());
  const std::size_t middle = slow == 2 ? 1 : 2, fast = slow == 0 ? 1 : 0;
  const auto thinnest = static_cast<std::size_t>(std::ceil(reach / cells.width()));
  const std::size_t most_slabs = std::max<std::size_t>(1, n / slab_size);
  const std::size_t layers = std::max(thinnest, (along[slow] + most_slabs - 1) / most_slabs);
  std::vector<std::uint32_t> key;
  key.reserve(n);
  for (const Record& x : places) {
    const Cells::Index c = cells.coordinates(x);
    key.push_back(static_cast<std::uint32_t>((c[slow] * along[middle] + c[middle]) * along[fast] + c[fast]));
  }
  Sorted sorted(key, cells.size());
  for (std::size_t layer = 0; layer < along[slow]; layer += layers)
    found.slabs.push_back(sorted.start[layer * along[middle] * along[fast]]);
  const int across = static_cast<int>(slow);
  if (model.periodic.length[across] > 0) close_ring(found.slabs);
  found.slabs.push_back(static_cast<std::uint32_t>(n));
  found.order = std::move(sorted.entry);
  return across;
}

/// Bodies by size: the largest ask for cells of `reach` [m], each level for half of the one before.
std::vector<Level> make_levels(const std::vector<Record>& places, double reach, double widest) {
  std::vector<std::vector<std::uint32_t>> members;
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    const auto level = static_cast<std::size_t>(std::log2(reach / (2 * places[i][3] + widest)));
    if (level >= members.size()) members.resize(level + 1);
    members[level].push_back(i);
  }
  std::vector<Level> levels;
  for (std::size_t l = 0; l < members.size(); ++l) {
    if (!members[l].empty()) levels.emplace_back(places, std::move(members[l]), std::ldexp(reach, -int(l)));
  }
  return levels;
}

/// Pairs of particles, the lower one first, that members of a level make with each other and with larger
/// ones: each looks among its own level and the wider ones.
struct Search {
  const std::vector<Level>& levels;
  const std::vector<Record>& places;
  double widest;

  /// Of the members `first` … `last` of a level.
  void find(std::size_t level, std::size_t first, std::size_t last, std::vector<Pair>& pairs,
            std::uint64_t& distances) const {
    for (std::size_t k = first; k < last; ++k) {
      const std::uint32_t i = levels[level].member(k);
      const auto add = [&](std::uint32_t j) { pairs.push_back({std::min(i, j), std::max(i, j)}); };
      for (std::size_t wider = 0; wider <= level; ++wider)
        distances += levels[wider].near(places[i], widest, wider == level ? k + 1 : 0, add);
    }
  }
};

std::vector<Pair> near_pairs(const std::vector<Record>& places, const std::vector<Level>& levels,
                             double widest, std::uint64_t& distances) {
  struct Work {
    std::size_t level, first, last;
    std::vector<Pair> pairs{};
    std::uint64_t distances = 0;
  };
  std::vector<Work> works;
  for (std::size_t l = 0; l < levels.size(); ++l) {
    for (std::size_t first = 0; first < levels[l].size(); first += chunk)
      works.push_back({l, first, std::min(first + chunk, levels[l].size())});
  }
  const Search look{levels, places, widest};
  parallel_for(static_cast<int>(works.size()), [&](int w) {
    Work& work = works[static_cast<std::size_t>(w)];
    look.find(work.level, work.first, work.last, work.pairs, work.distances);
  });
  std::vector<Pair> pairs;
  for (const Work& work : works) {
    pairs.insert(pairs.end(), work.pairs.begin(), work.pairs.end());
    distances += work.distances;
  }
  return pairs;
}

std::vector<Pair> every_pair(std::size_t n) {
  std::vector<Pair> pairs;
  for (std::uint32_t a = 0; a < n; ++a) {
    for (std::uint32_t b = a + 1; b < n; ++b) pairs.push_back({a, b});
  }
  return pairs;
}

/// Lists pairs of particles by the lower one, without those of two bodies that are not free and of bodies
/// that left.
void list_pairs(const Bodies& bodies, std::vector<Pair> pairs, Neighbours& found) {
  std::erase_if(pairs, [&](const Pair& pair) {
    const std::uint32_t a = found.order[pair.a], b = found.order[pair.b];
    return (!bodies.is_free(a) && !bodies.is_free(b)) || bodies.left[a] || bodies.left[b];
  });
  std::vector<std::uint32_t> lower;
  lower.reserve(pairs.size());
  for (const Pair& pair : pairs) lower.push_back(pair.a);
  Sorted sorted(lower, found.size());
  found.start = std::move(sorted.start);
  for (std::uint32_t& p : sorted.entry) p = pairs[p].b;
  found.other = std::move(sorted.entry);
  for (std::size_t i = 0; i < found.size(); ++i)
    std::sort(found.other.begin() + found.start[i], found.other.begin() + found.start[i + 1]);
  found.other.resize(found.other.size() + n_lanes, 0);
}

}  // namespace

bool lists_every_pair(const Model& model) {
  return model.bodies.size() <= few && model.walls.facets.size() <= few_facets;
}

Neighbours search(const Model& model, const std::vector<Vec3>& position, double reach) {
  const Bodies& bodies = model.bodies;
  const auto n = static_cast<std::uint32_t>(bodies.size());
  Neighbours found;
  found.skin = choose_skin(model, reach);
  found.reach = reach;
  if (lists_every_pair(model)) {
    found.order = scene_order(n);
    found.slabs = {0, n};
    found.origin = position;
    list_pairs(bodies, every_pair(n), found);
    return found;
  }
  const double widest = found.widest_gap();
  const double farthest = 2 * largest_radius(bodies) + widest;
  const int across = sort_bodies(model, position, farthest, 2 * mean_radius(bodies) + widest, found);
  std::vector<Record> places = places_of(model, position, found.order);
  for (const std::uint32_t i : found.order) found.origin.push_back(position[i]);
  const Images images(model.periodic, farthest, across, places);
  const std::vector<Level> levels = make_levels(places, farthest, widest);
  std::vector<Pair> pairs = near_pairs(places, levels, widest, found.distances);
  images.resolve(n, pairs);
  list_pairs(bodies, std::move(pairs), found);
  return found;
}

Near near(const Model& model, const std::vector<Vec3>& position, const Pair& pair) {
  return {pair.a, pair.b, separation(model, position, pair),
          model.laws(model.bodies.material[pair.a], model.bodies.material[pair.b])};
}

std::string names(const Model& model, const Pair& pair) {
  return model.bodies.name[pair.a] + " and " + model.bodies.name[pair.b];
}

}  // namespace fpi::dem
