#include "fluid/linear/nested_dissection.hpp"

#include <metis.h>

#include <new>
#include <utility>

#include "core/error.hpp"

namespace fpi::fluid {
namespace {

/// Which clusters the matrix couples, as METIS wants it.
struct Graph {
  std::vector<idx_t> first_neighbour{0}, neighbours, weight;

  Graph(const BlockMatrix& matrix, std::span<const Cluster> clusters) {
    constexpr idx_t none = -1;
    const auto n = static_cast<idx_t>(clusters.size());
    std::vector<idx_t> cluster_of(matrix.n(), none), seen_from(n, none);
    for (idx_t k = 0; k < n; ++k)
      for (Index unknown = clusters[k].first; unknown < clusters[k].end; ++unknown) cluster_of[unknown] = k;
    for (idx_t k = 0; k < n; ++k) {
      seen_from[k] = k;
      const Index begin = matrix.column_start()[clusters[k].first];
      const Index end = matrix.column_start()[clusters[k].end];
      for (Index entry = begin; entry < end; ++entry) {
        const idx_t other = cluster_of[matrix.row()[entry]];
        if (other != none && std::exchange(seen_from[other], k) != k) neighbours.push_back(other);
      }
      first_neighbour.push_back(static_cast<idx_t>(neighbours.size()));
      weight.push_back(clusters[k].end - clusters[k].first);
    }
  }
  idx_t n() const { return static_cast<idx_t>(weight.size()); }
};

/// The clusters without those kept for last.
std::vector<Cluster> to_order(Index n_unknowns, std::span<const Cluster> clusters,
                              std::span<const Index> last) {
  std::vector<bool> is_last(n_unknowns, false);
  for (const Index unknown : last) is_last[unknown] = true;
  std::vector<Cluster> out(clusters.begin(), clusters.end());
  if (clusters.empty())
    for (Index unknown = 0; unknown < n_unknowns; ++unknown) out.push_back({unknown, unknown + 1});
  std::erase_if(out, [&](const Cluster& cluster) { return is_last[cluster.first]; });
  return out;
}

}  // namespace

std::vector<Index> nested_dissection(const BlockMatrix& matrix, std::span<const Cluster> clusters,
                                     std::span<const Index> last) {
  const std::vector<Cluster> ordered = to_order(matrix.n(), clusters, last);
  Graph graph(matrix, ordered);
  idx_t n = graph.n();
  std::vector<idx_t> sequence(n), turn(n), options(METIS_NOPTIONS);
  METIS_SetDefaultOptions(options.data());
  const int status = METIS_NodeND(&n, graph.first_neighbour.data(), graph.neighbours.data(),
                                  graph.weight.data(), options.data(), sequence.data(), turn.data());
  if (status == METIS_ERROR_MEMORY) throw std::bad_alloc();
  require(status == METIS_OK,
          "the nested dissection of {} unknowns failed: METIS status {}; please report it", matrix.n(),
          status);
  std::vector<Index> order;
  order.reserve(matrix.n());
  for (const idx_t k : sequence)
    for (Index unknown = ordered[k].first; unknown < ordered[k].end; ++unknown) order.push_back(unknown);
  return order;
}

}  // namespace fpi::fluid
