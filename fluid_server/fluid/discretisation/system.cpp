#include "fluid/discretisation/system.hpp"

#include <algorithm>
#include <ranges>
#include <utility>

#include "core/error.hpp"
#include "fluid/discretisation/arc_points.hpp"
#include "fluid/linear/bordered_factor.hpp"

namespace fpi::fluid {
namespace {

using block_size::arc, block_size::cell, block_size::ghost;

/// Pressures of an element do not meet each other.
const BlockMask& cell_mask() {
  static const BlockMask mask = [] {
    BlockMask m = BlockMask::dense(cell);
    for (int i = 12; i < 15; ++i)
      for (int j = 12; j < 15; ++j) m.coupled[i + cell * j] = 0;
    return m;
  }();
  return mask;
}
/// x meets x and y meets y, unless a slip node mixes them.
const BlockMask& ghost_mask(bool mixed) {
  static const BlockMask full = BlockMask::dense(ghost);
  static const BlockMask mask = [] {
    BlockMask m = full;
    for (int i = 0; i < ghost; ++i)
      for (int j = 0; j < ghost; ++j) m.coupled[i + ghost * j] = (i < 9) == (j < 9);
    return m;
  }();
  return mixed ? full : mask;
}
const BlockMask& ghost_pressure_mask() {
  static const BlockMask mask = BlockMask::dense(4);
  return mask;
}
/// λx, λy of both ends of an arc, then ux of six nodes, then uy.
const BlockMask& arc_mask(bool mixed) {
  static const auto make = [](bool full) {
    BlockMask m{arc, std::vector<std::uint8_t>(arc * arc, 0)};
    for (int i = 4; i < arc; ++i)
      for (int c = 0; c < 4; ++c)
        if (full || (i < 10) == (c % 2 == 0)) m.coupled[i + arc * c] = m.coupled[c + arc * i] = 1;
    return m;
  };
  static const BlockMask apart = make(false), full = make(true);
  return mixed ? full : apart;
}

}  // namespace

System::System(const Space& space, const scene::Fluid& parameters, std::vector<Interface> interfaces,
               const CutMesh& before, Timers& timers)
    : space_(space),
      embedding_(parameters.embedding),
      linear_solver_(parameters.linear_solver),
      interfaces_(std::move(interfaces)),
      matrix_(0) {
  {
    const ScopedTimer timer(timers, "interface");
    cut_ = cut_mesh(space.mesh, space.locator, interfaces_, before);
    components_ = find_components(space.mesh, cut_);
    drop_pockets(space.mesh, interfaces_, components_, cut_);
    for (const Interface& interface : interfaces_)
      arc_lengths_.push_back(
          wanted_arc_length(space.mesh, space.locator, interface.surface, embedding_.arc_ratio));
  }
  const ScopedTimer timer(timers, "assembly");
  numbering_ = number_unknowns(space.mesh, space.boundary, cut_, components_, interfaces_);
  free_bodies_ = FreeBodies(interfaces_, cut_, numbering_);
  order_cells();
  require(numbering_.n_equations > 0,
          "a part of the mesh must be fluid; the bodies cover all of it: make them smaller");
  load_ = Vector::Zero(2 * space.mesh.n_nodes());
  declare_blocks();
  set_velocities(interfaces_);
  drives_ = make_drives(parameters);
}

void System::order_cells() {
  const Mesh& mesh = space_.mesh;
  std::vector<Index> cut_number(mesh.n_cells(), -1);
  for (std::size_t k = 0; k < cut_.cut_cells.size(); ++k)
    cut_number[cut_.cut_cells[k]->cell] = static_cast<Index>(k);
  enum Kind { straight, curved, single };
  std::vector<std::array<std::vector<Index>, 3>> cells(space_.colouring.n);
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    if (!cut_.is_active(c)) continue;
    const Kind whole = mesh.is_curved(c) ? curved : straight;
    require(
        cut_number[c] < 0 || whole == straight,
        "a body may cut straight triangles only; one cuts the curved triangle at ({:.4g}, {:.4g}) m: keep "
        "bodies away from curved boundaries, or make the mesh of first order there",
        mesh.corners(c)[0].x(), mesh.corners(c)[0].y());
    const Kind kind = cut_number[c] >= 0 || has_slip_node(mesh.cell_nodes(c)) ? single : whole;
    cells[space_.colouring.of_cell[c]][kind].push_back(c);
  }
  const auto append = [&](const std::vector<Index>& some) {
    active_cells_.insert(active_cells_.end(), some.begin(), some.end());
    return static_cast<Index>(active_cells_.size());
  };
  for (const auto& of_colour : cells) {
    const Index begin = static_cast<Index>(active_cells_.size());
    const Index first_curved = append(of_colour[straight]), first_single = append(of_colour[curved]);
    stretches_.push_back({begin, first_curved, first_single, append(of_colour[single])});
  }
  for (Index c : active_cells_) cut_index_.push_back(cut_number[c]);
}

bool System::same_geometry(const std::vector<Interface>& interfaces) const {
  return std::equal(interfaces.begin(), interfaces.end(), interfaces_.begin(), interfaces_.end(),
                    [](const Interface& a, const Interface& b) { return a.same_geometry(b); });
}

bool System::has_slip_node(std::span<const Index> nodes) const {
  return std::any_of(nodes.begin(), nodes.end(),
                     [&](Index n) { return space_.boundary.constraint(n) == Constraint::normal; });
}

void System::declare_blocks() {
  matrix_ = BlockMatrix(numbering_.n_equations);
  const auto& v = numbering_.velocity;
  std::vector<Index> equations;
  for (Index c : active_cells_) {
    equations.clear();
    for (int component = 0; component < 2; ++component)
      for (Index node : space_.mesh.cell_nodes(c)) equations.push_back(v[2 * node + component]);
    for (Index vertex : space_.mesh.cell_vertices(c)) equations.push_back(numbering_.pressure[vertex]);
    matrix_.declare(equations, cell_mask());
  }
  first_ghost_ = matrix_.n_blocks();
  for (const auto& face : cut_.ghost_faces) {
    equations.clear();
    for (int component = 0; component < 2; ++component)
      for (Index node : face->nodes) equations.push_back(v[2 * node + component]);
    matrix_.declare(equations, ghost_mask(has_slip_node(face->nodes)));
    equations.clear();
    for (Index vertex : face->vertices) equations.push_back(numbering_.pressure[vertex]);
    matrix_.declare(equations, ghost_pressure_mask());
  }
  first_piece_ = matrix_.n_blocks();
  for (const ArcPiece& piece : cut_.pieces) {
    const auto nodes = space_.mesh.cell_nodes(piece.cell);
    equations.clear();
    for (const Index m : piece.multipliers)
      for (int component = 0; component < 2; ++component)
        equations.push_back(numbering_.multiplier[2 * m + component]);
    for (int component = 0; component < 2; ++component)
      for (Index node : nodes) equations.push_back(v[2 * node + component]);
    matrix_.declare(equations, arc_mask(has_slip_node(nodes)));
  }
  free_bodies_.declare_blocks(numbering_, matrix_);
  matrix_.finish();
}

void System::set_velocities(const std::vector<Interface>& interfaces) {
  interfaces_ = interfaces;
  pieces_.resize(cut_.pieces.size());
  free_bodies_.clear_integrals();
  for (std::size_t k = 0; k < pieces_.size(); ++k) {
    const ArcPiece& piece = cut_.pieces[k];
    const Interface& interface = interfaces_[piece.interface];
    PieceIntegrals& integrals = pieces_[k] = {};
    for (const auto& [parameter, x, n, w] : arc_points(space_, interface, piece)) {
      const auto hats = cut_.multiplier_nodes[piece.interface].hats(piece.arc, parameter);
      for (int end = 0; end < 2; ++end) {
        const double weight = w * hats[end];
        integrals.shape[end] += weight * n;
        if (!interface.balance) integrals.velocity[end] += weight * interface.velocity(piece.arc, parameter);
        integrals.arm[end] += weight * (x - interface.rigid.centre);
        integrals.length[end] += weight;
      }
    }
    for (int end = 0; end < 2; ++end)
      free_bodies_.add_integrals(piece.multipliers[end], integrals.length[end], integrals.arm[end]);
  }
}

Vector System::motions(const Vector& rigid) const {
  Vector out = rigid;
  for (std::size_t i = 0; i < interfaces_.size(); ++i) {
    if (interfaces_[i].balance) continue;
    const RigidVelocity& given = interfaces_[i].rigid;
    out.segment<3>(3 * static_cast<Eigen::Index>(i)) << given.translation, given.spin;
  }
  return out;
}

void System::keep_motions(const Vector& rigid) {
  for (std::size_t i = 0; i < interfaces_.size(); ++i) {
    if (!interfaces_[i].balance) continue;
    const auto motion = rigid.segment<3>(3 * static_cast<Eigen::Index>(i));
    interfaces_[i].rigid = {interfaces_[i].rigid.centre, motion.head<2>(), motion[2]};
    interfaces_[i].sampled.clear();
  }
}

Quadrature System::quadrature(std::size_t k) const {
  if (cut_index_[k] < 0) return space_.quadrature(active_cells_[k]);
  const CutCell& cut = *cut_.cut_cells[cut_index_[k]];
  return {cut.points, {&cut.metric, 1}};
}

Residual System::no_residual() const {
  return {Vector::Zero(load_.size()), Vector::Zero(space_.mesh.n_vertices()),
          Vector::Zero(2 * cut_.n_multipliers()),
          Vector::Zero(3 * static_cast<Eigen::Index>(interfaces_.size())), Vector::Zero(drives_.size())};
}

void System::check_closed_parts(const Residual& residual, const Vector& u) const {
  double moved = space_.boundary.flux(u).gross;
  for (std::size_t k = 0; k < pieces_.size(); ++k) {
    const auto& [shape, velocity, arm, length] = pieces_[k];
    const Interface& interface = interfaces_[cut_.pieces[k].interface];
    moved += interface.balance ? (length[0] + length[1]) * interface.rigid.translation.norm()
                               : (velocity[0] + velocity[1]).norm();
  }
  // The no-slip condition holds arc by arc, so a little flows through a surface that is at rest in a flow.
  const double leak = 0.01 * space_.smallest_size * u.lpNorm<Eigen::Infinity>();
  // A pore that bodies alone enclose shrinks as their contacts give way; its fluid is let go.
  std::vector<std::uint8_t> has_side(components_.n(), 0);
  for (const Index part : components_.of_boundary)
    if (part >= 0) has_side[part] = 1;
  for (Index part = 0; part < components_.n(); ++part) {
    const Index v = components_.pin(space_.mesh, part);
    if (has_side[part] == 0 || numbering_.pressure[v] >= 0) continue;
    const Vec2 x = space_.mesh.vertices[v];
    require(
        std::abs(residual.p[v]) <= 0.05 * moved + leak,
        "where no open boundary is reached, as much fluid must enter as leaves; around ({:.4g}, {:.4g}) m a "
        "net {:.4g} m²/s {}: leave a way to an open boundary, or balance the velocities",
        x.x(), x.y(), std::abs(residual.p[v]), residual.p[v] < 0 ? "leaves" : "enters");
  }
}

Vector System::gather(const Residual& residual) const {
  Vector out(n_unknowns());
  out.tail(drives_.size()) = residual.drive;
  for (Index node = 0; node < space_.mesh.n_nodes(); ++node) {
    const Index x = numbering_.velocity[2 * node], y = numbering_.velocity[2 * node + 1];
    if (x >= 0) {
      out[x] = residual.u[2 * node];
      out[y] = residual.u[2 * node + 1];
    } else if (y >= 0) {
      const Vec2& normal = space_.boundary.normal(node);
      out[y] = -normal.y() * residual.u[2 * node] + normal.x() * residual.u[2 * node + 1];
    }
  }
  for (Eigen::Index v = 0; v < residual.p.size(); ++v)
    if (numbering_.pressure[v] >= 0) out[numbering_.pressure[v]] = residual.p[v];
  for (Eigen::Index m = 0; m < residual.lambda.size(); ++m)
    if (numbering_.multiplier[m] >= 0) out[numbering_.multiplier[m]] = residual.lambda[m];
  for (Eigen::Index i = 0; i < residual.rigid.size(); ++i)
    if (numbering_.rigid[i] >= 0) out[numbering_.rigid[i]] = residual.rigid[i];
  return out;
}

void System::add(const Vector& update, double step, Fields& fields) const {
  for (Index node = 0; node < space_.mesh.n_nodes(); ++node) {
    const Index x = numbering_.velocity[2 * node], y = numbering_.velocity[2 * node + 1];
    if (x >= 0) {
      fields.u[2 * node] += step * update[x];
      fields.u[2 * node + 1] += step * update[y];
    } else if (y >= 0) {
      const Vec2& normal = space_.boundary.normal(node);
      fields.u.segment<2>(2 * node) += step * update[y] * Vec2(-normal.y(), normal.x());
    }
  }
  for (Eigen::Index v = 0; v < fields.p.size(); ++v)
    if (numbering_.pressure[v] >= 0) fields.p[v] += step * update[numbering_.pressure[v]];
  for (Eigen::Index m = 0; m < fields.lambda.size(); ++m)
    if (numbering_.multiplier[m] >= 0) fields.lambda[m] += step * update[numbering_.multiplier[m]];
  for (Eigen::Index i = 0; i < fields.rigid.size(); ++i)
    if (numbering_.rigid[i] >= 0) fields.rigid[i] += step * update[numbering_.rigid[i]];
  fields.drive += step * update.tail(drives_.size());
}

std::shared_ptr<const Factor> System::factor_of_matrix(Timers& timers) {
  if (!analysis_) {
    const std::vector<Index> rigid =
        wants_resistance_ ? free_bodies_.unknowns(numbering_) : std::vector<Index>{};
    analysis_ = analyse(matrix_, linear_solver_, numbering_.clusters, rigid);
    timers.counts["analyses"] += 1;
  }
  return analysis_->factor(matrix_);
}

std::shared_ptr<const Factor> System::factor(const TimeTerms& time,
                                             std::shared_ptr<const Background>& reference, Timers& timers) {
  Layout layout{interfaces_, cut_, numbering_, time.mesh_velocity, time.inertia};
  std::shared_ptr<const Factor> inner;
  if (reference && has_resistance(*reference))
    inner = with_zone_correction(reference, space_.mesh, layout, matrix_, linear_solver_);
  if (!inner) {
    inner = factor_of_matrix(timers);
    reference = std::make_shared<Background>(inner, std::move(layout));
  }
  if (drives_.size() == 0) return inner;
  Columns columns(numbering_.n_equations, drives_.size()), rows = columns;
  for (Index k = 0; k < drives_.size(); ++k) {
    Residual unit = no_residual();
    unit.u = drives_.all()[k].load;
    unit.rigid = drives_.all()[k].load_on_bodies;
    rows.col(k) = gather(unit).head(numbering_.n_equations);
    columns.col(k) = -rows.col(k);
  }
  return with_border(std::move(inner), columns, rows);
}

void System::want_resistance(bool wanted) {
  wanted = wanted && !free_bodies_.empty() && drives_.size() == 0 && gives_schur_complements(linear_solver_);
  if (std::exchange(wants_resistance_, wanted) != wanted) analysis_.reset();
}

bool System::has_resistance(const Background& reference) const {
  if (!wants_resistance_) return true;
  const auto is_free = [](const Interface& interface) { return interface.balance.has_value(); };
  const auto same_body = [](const Interface& a, const Interface& b) { return a.body == b.body; };
  auto now = interfaces_ | std::views::filter(is_free);
  auto before = reference.layout.interfaces | std::views::filter(is_free);
  return reference.factor->schur_complement().size() > 0 && std::ranges::equal(now, before, same_body);
}

Eigen::MatrixXd System::resistance(const Background& reference) const {
  Eigen::MatrixXd resistance;
  if (!wants_resistance_ || !has_resistance(reference)) return resistance;
  resistance = reference.factor->schur_complement();
  const auto add_own = [&](const std::vector<Interface>& interfaces, double sign) {
    Eigen::Index first = 0;
    for (const Interface& interface : interfaces) {
      if (!interface.balance) continue;
      const Balance& balance = *interface.balance;
      const Eigen::Vector3d own(balance.mass_rate, balance.mass_rate, balance.inertia_rate);
      resistance.diagonal().segment<3>(first) += sign * own;
      first += 3;
    }
  };
  add_own(reference.layout.interfaces, -1);
  add_own(interfaces_, 1);
  return resistance;
}

Vector System::velocity_weight() const {
  Vector weight = Vector::Zero(n_unknowns());
  for (Index equation : numbering_.velocity)
    if (equation >= 0) weight[equation] = 1;
  return weight;
}

std::vector<std::uint8_t> System::wet_nodes() const {
  std::vector<std::uint8_t> wet = numbering_.node_is_active;
  for (const CoveredNode& covered : cut_.covered) wet[covered.node] = 0;
  return wet;
}

double System::speed(const Vector& u) const {
  double squares = 0, n_active = 0;
  for (Index node = 0; node < space_.mesh.n_nodes(); ++node) {
    if (!numbering_.node_is_active[node]) continue;
    squares += u.segment<2>(2 * node).squaredNorm();
    ++n_active;
  }
  return n_active > 0 ? std::sqrt(squares / n_active) : 0;
}

std::string System::largest_residual(const Vector& gathered) const {
  Vec2 place = Vec2::Zero();
  double largest = -1;
  for (Index node = 0; node < space_.mesh.n_nodes(); ++node)
    for (const Index equation : {numbering_.velocity[2 * node], numbering_.velocity[2 * node + 1]}) {
      if (equation < 0 || std::abs(gathered[equation]) <= largest) continue;
      largest = std::abs(gathered[equation]);
      place = space_.mesh.node_position(node);
    }
  return fmt::format("the largest residual is {:.3g} N/m at ({:.4g}, {:.4g}) m", largest, place.x(),
                     place.y());
}

std::vector<System::Resultant> System::resultants(const Vector& lambda) const {
  std::vector<Resultant> out(interfaces_.size());
  for (std::size_t k = 0; k < pieces_.size(); ++k) {
    Resultant& resultant = out[cut_.pieces[k].interface];
    for (int end = 0; end < 2; ++end) {
      const Vec2 value = lambda.segment<2>(2 * cut_.pieces[k].multipliers[end]);
      resultant.force += pieces_[k].length[end] * value;
      resultant.torque += cross(pieces_[k].arm[end], value);
    }
  }
  return out;
}

double System::wetted_length() const {
  double sum = 0;
  for (const PieceIntegrals& piece : pieces_) sum += piece.length[0] + piece.length[1];
  return sum;
}

}  // namespace fpi::fluid
