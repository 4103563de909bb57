#include "fluid/mesh/locator.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace fpi::fluid {
namespace {

/// A parabola lies in the hull of its ends and its control point.
std::pair<Vec2, Vec2> bounding_box(const Mesh& mesh, Index cell) {
  const auto c = mesh.corners(cell);
  std::pair box{c[0].cwiseMin(c[1]).cwiseMin(c[2]).eval(), c[0].cwiseMax(c[1]).cwiseMax(c[2]).eval()};
  for (const Index e : mesh.cell_edges[cell]) {
    const Vec2 control = 2 * mesh.middles[e] - mesh.chord_middle(e);
    box.first = box.first.cwiseMin(control);
    box.second = box.second.cwiseMax(control);
  }
  return box;
}

}  // namespace

Locator::Locator(const Mesh& mesh) : mesh_(mesh), lower_(mesh.vertices.front()), upper_(lower_) {
  for (const Vec2& v : mesh.vertices) {
    lower_ = lower_.cwiseMin(v);
    upper_ = upper_.cwiseMax(v);
  }
  const Vec2 extent = upper_ - lower_;
  bin_ = std::sqrt(extent.x() * extent.y() / mesh.n_cells()) * 1.5;
  const auto for_bins = [&](auto&& act) {
    for (Index c = 0; c < mesh_.n_cells(); ++c) {
      const auto [low, high] = bounding_box(mesh_, c);
      for (int j = row(low.y()); j <= row(high.y()); ++j)
        for (int i = column(low.x()); i <= column(high.x()); ++i) act(j * n_x_ + i, c);
    }
  };
  // Long thin triangles fill many bins: then larger bins serve better.
  for (std::size_t entries = 0, most = 64 + 30 * mesh.cells.size();; bin_ *= 2) {
    const auto bins_along = [&](double length) {
      return static_cast<int>(std::clamp(length / bin_, 1.0, 1e4));
    };
    n_x_ = bins_along(extent.x());
    n_y_ = bins_along(extent.y());
    entries = 0;
    for (Index c = 0; c < mesh.n_cells() && entries <= most; ++c) {
      const auto [low, high] = bounding_box(mesh, c);
      entries += static_cast<std::size_t>(column(high.x()) - column(low.x()) + 1) *
                 (row(high.y()) - row(low.y()) + 1);
    }
    if (entries <= most || n_x_ * n_y_ == 1) break;
  }
  first_.assign(n_x_ * n_y_ + 1, 0);
  for_bins([&](int bin, Index) { ++first_[bin + 1]; });
  for (std::size_t b = 1; b < first_.size(); ++b) first_[b] += first_[b - 1];
  cells_.resize(first_.back());
  std::vector<Index> next(first_.begin(), first_.end() - 1);
  for_bins([&](int bin, Index c) { cells_[next[bin]++] = c; });
}

int Locator::column(double x) const {
  return static_cast<int>(std::clamp((x - lower_.x()) / bin_, 0.0, static_cast<double>(n_x_ - 1)));
}
int Locator::row(double y) const {
  return static_cast<int>(std::clamp((y - lower_.y()) / bin_, 0.0, static_cast<double>(n_y_ - 1)));
}

std::vector<Index> Locator::near(const Vec2& lower, const Vec2& upper) const {
  std::vector<Index> out;
  for (int j = row(lower.y()); j <= row(upper.y()); ++j)
    for (int i = column(lower.x()); i <= column(upper.x()); ++i) {
      const int bin = j * n_x_ + i;
      out.insert(out.end(), cells_.begin() + first_[bin], cells_.begin() + first_[bin + 1]);
    }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

std::optional<Place> Locator::find(const Vec2& anywhere) const {
  const Vec2 x = mesh_.period.wrapped(anywhere);
  constexpr double round_off = 1e-10, off_the_circle = 1e-2;
  std::optional<Place> best;
  double best_least = -off_the_circle;
  const int bin = row(x.y()) * n_x_ + column(x.x());
  for (const Index c : std::span(cells_).subspan(first_[bin], first_[bin + 1] - first_[bin])) {
    const bool is_curved = mesh_.is_curved(c);
    const auto l = is_curved ? isoparametric_inverse(mesh_.cell_places(c), x)
                             : Triangle(mesh_.corners(c)).barycentric(x);
    if (!l) continue;
    const double least = std::min({(*l)[0], (*l)[1], (*l)[2]});
    if (least < (is_curved ? -off_the_circle : -round_off) || least < best_least) continue;
    best = {c, *l};
    best_least = least;
    if (least > round_off) break;  // it lies in no other
  }
  return best;
}

}  // namespace fpi::fluid
