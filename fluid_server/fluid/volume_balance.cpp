#include "fluid/volume_balance.hpp"

#include "fluid/quadrature.hpp"

namespace fpi::fluid {
namespace {

constexpr int points_on_piece = 4;

/// Unit normal of an outline at a point x of a piece, out of the body.
Vec2 normal(const Outline& outline, const ArcPiece& piece, const Vec2& x) {
  if (const Disc* disc = outline.disc()) return (x - disc->centre).normalized();
  const Vec2 along = outline.at(piece.end) - outline.at(piece.start);
  return Vec2(along.y(), -along.x()).normalized();
}

struct OutlineFlow {
  double body = 0, fluid = 0;  ///< ∫V·n and ∫u·n, n out of the bodies [m²/s]
};

OutlineFlow through_outlines(const System& system, const Vector& u) {
  const Space& space = system.space();
  OutlineFlow flow;
  for (const ArcPiece& piece : system.cut().pieces) {
    const Interface& interface = system.interfaces()[piece.interface];
    const auto nodes = space.mesh.cell_nodes(piece.cell);
    for (const LinePoint& point : gauss_legendre(points_on_piece)) {
      const double parameter = piece.start + point.s * (piece.end - piece.start);
      const Vec2 x = interface.outline.at(parameter);
      const Padded shape = p2_at(space.triangles[piece.cell].barycentric(x + piece.shift));
      Vec2 velocity = Vec2::Zero();
      for (int i = 0; i < 6; ++i) velocity += shape[i] * u.segment<2>(2 * nodes[i]);
      const Vec2 n = point.weight * interface.outline.length(piece.start, piece.end) *
                     normal(interface.outline, piece, x);
      flow.body += n.dot(interface.velocity(piece.arc, parameter));
      flow.fluid += n.dot(velocity);
    }
  }
  return flow;
}

}  // namespace

double VolumeBalance::rest() const {
  double sum = 0;
  for (const Term& term : terms) sum += term.inflow;
  return sum;
}

VolumeBalance volume_balance(const System& system, const Vector& u) {
  const Space& space = system.space();
  const std::vector<Outline> bodies = outlines(system.cut().images);
  VolumeBalance out;
  for (Index b = 0; b < static_cast<Index>(space.mesh.boundary_names.size()); ++b) {
    Vector inward = Vector::Zero(u.size());
    space.boundary.add_pressure(b, {bodies, system.components().of_boundary}, inward);
    out.terms.push_back({"boundary:" + space.mesh.boundary_names[b], inward.dot(u)});
  }
  const OutlineFlow flow = through_outlines(system, u);
  out.terms.push_back({"bodies", flow.body});
  out.terms.push_back({"leak", flow.fluid - flow.body});
  return out;
}

}  // namespace fpi::fluid
