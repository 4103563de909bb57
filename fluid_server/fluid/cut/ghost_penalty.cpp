#include "fluid/cut/ghost_penalty.hpp"

#include <algorithm>

namespace fpi::fluid {
namespace {

/// Positions of the items of `second` in the list `items`, which starts with those of the first element and
/// gets the new ones appended.
template <std::size_t N, std::size_t M>
std::array<int, M> merge(std::array<Index, N>& items, const std::array<Index, M>& second) {
  std::array<int, M> place{};
  int end = M;
  for (std::size_t i = 0; i < M; ++i) {
    const auto it = std::find(items.begin(), items.begin() + M, second[i]);
    const bool shared = it != items.begin() + M;
    place[i] = shared ? static_cast<int>(it - items.begin()) : end++;
    items[place[i]] = second[i];
  }
  return place;
}

}  // namespace

GhostFace ghost_face(const Mesh& mesh, Index edge) {
  const auto [cell1, cell2] = mesh.edge_cells[edge];
  GhostFace face{};
  face.edge = edge;
  const auto nodes1 = mesh.cell_nodes(cell1);
  std::copy(nodes1.begin(), nodes1.end(), face.nodes.begin());
  std::copy_n(nodes1.begin(), 3, face.vertices.begin());
  const auto node_place = merge(face.nodes, mesh.cell_nodes(cell2));
  const auto vertex_place = merge(face.vertices, mesh.cell_vertices(cell2));

  face.velocity.setZero();
  face.pressure.setZero();
  auto beyond = mesh.corners(cell2);
  for (Vec2& x : beyond) x += mesh.shift_across(edge);
  const std::array<Triangle, 2> triangles{Triangle(mesh.corners(cell1)), Triangle(beyond)};
  face.h2 = 2 * std::sqrt(triangles[0].area * triangles[1].area);
  for (const Triangle& here : triangles) {
    for (const ElementPoint& point : standard_points()) {
      const Vec2 x = here.point(point.shape.l);
      const auto l1 = triangles[0].barycentric(x), l2 = triangles[1].barycentric(x);
      const Padded n1 = p2_at(l1), n2 = p2_at(l2);
      Eigen::Matrix<double, 9, 1> jump = Eigen::Matrix<double, 9, 1>::Zero();
      Eigen::Vector4d pressure_jump = Eigen::Vector4d::Zero();
      for (int i = 0; i < 6; ++i) {
        jump[i] += n1[i];
        jump[node_place[i]] -= n2[i];
      }
      for (int i = 0; i < 3; ++i) {
        pressure_jump[i] += l1[i];
        pressure_jump[vertex_place[i]] -= l2[i];
      }
      const double w = here.area * point.weight;
      face.velocity += w * jump * jump.transpose();
      face.pressure += w * pressure_jump * pressure_jump.transpose();
    }
  }
  return face;
}

GhostInertia ghost_inertia(const GhostFace& face, const Vector& mesh_velocity, double inertia) {
  constexpr double passing = 3;  // rate over speed/h, measured: less is noisier, more less exact
  double speed = 0;
  if (mesh_velocity.size() > 0)
    for (const Index node : face.nodes) speed = std::max(speed, mesh_velocity.segment<2>(2 * node).norm());
  if (speed == 0) return {true, inertia};
  return {false, std::min(inertia, passing * speed / std::sqrt(face.h2))};
}

}  // namespace fpi::fluid
