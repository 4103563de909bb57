#include "fluid/discretisation/zone_correction.hpp"

#include <algorithm>
#include <utility>

namespace fpi::fluid {
namespace {

constexpr int layers = 2;             ///< of elements around what moved
constexpr double largest_zone = 0.3;  ///< of the unknowns; at 0.4 it no longer pays (docs/numerics.md)

/// The zone, then all other equations that the matrix couples with it (its pattern is symmetric).
std::vector<Index> with_fringe(const std::vector<Index>& zone, const BlockMatrix& matrix) {
  std::vector<std::uint8_t> has(matrix.n(), 0);
  std::vector<Index> out = zone;
  for (const Index equation : zone) has[equation] = 1;
  for (const Index equation : zone)
    for (Index k = matrix.column_start()[equation]; k < matrix.column_start()[equation + 1]; ++k)
      if (const Index other = matrix.row()[k]; std::exchange(has[other], 1) == 0) out.push_back(other);
  return out;
}

class ZoneCorrectedFactor final : public Factor {
 public:
  ZoneCorrectedFactor(std::shared_ptr<const Background> reference, std::vector<Index> shared,
                      const std::vector<Index>& zone, const BlockMatrix& matrix, std::string_view solver)
      : Factor(matrix.n()),
        background_(std::move(reference)),
        shared_(std::move(shared)),
        n_zone_(static_cast<Eigen::Index>(zone.size())),
        fringe_(with_fringe(zone, matrix)),
        around_(matrix.part(fringe_)) {
    solve_cost_ = background_->factor->solve_cost();
    if (zone.empty()) return;
    const BlockMatrix inside = matrix.part(zone);
    inside_ = analyse(inside, solver)->factor(inside);
    is_singular_ = inside_->is_singular();
    factor_cost_ = inside_->factor_cost();
    solve_cost_ += 2 * inside_->solve_cost();
  }

 private:
  /// x = Z b; x += B (b − A x); x += Z (b − A x), with Z and B the inverses in the zone and of the
  /// reference. That of Aᵀ is the same with theirs.
  Vector back_solve(const Vector& b, Form form) const override {
    const Vector given = at_fringe(b), first = in_zone(given.head(n_zone_), form);
    Vector left = b;
    add_at_fringe(-product(first, form), left);
    Vector x = everywhere(left, form);
    add_at_fringe(first, x);
    add_at_fringe(in_zone((given - product(at_fringe(x), form)).head(n_zone_), form), x);
    return x;
  }

  Vector in_zone(const Vector& b, Form form) const { return inside_ ? solve(*inside_, b, form) : b; }

  /// With the reference's factor; what it does not know is zero.
  Vector everywhere(const Vector& b, Form form) const {
    Vector old = Vector::Zero(background_->layout.numbering.n_equations);
    for (Index k = 0; k < n_; ++k)
      if (shared_[k] >= 0) old[shared_[k]] = b[k];
    old = solve(*background_->factor, old, form);
    Vector x = Vector::Zero(n_);
    for (Index k = 0; k < n_; ++k)
      if (shared_[k] >= 0) x[k] = old[shared_[k]];
    return x;
  }

  Vector at_fringe(const Vector& all) const {
    Vector out(fringe_.size());
    for (std::size_t k = 0; k < fringe_.size(); ++k) out[static_cast<Eigen::Index>(k)] = all[fringe_[k]];
    return out;
  }
  /// Of as many as `some` has.
  void add_at_fringe(const Vector& some, Vector& all) const {
    for (Eigen::Index k = 0; k < some.size(); ++k) all[fringe_[k]] += some[k];
  }
  /// A x at the fringe, for x there or in the zone alone.
  Vector product(const Vector& x, Form form) const {
    Vector padded = Vector::Zero(around_.n());
    padded.head(x.size()) = x;
    if (form == Form::plain) return around_.view() * padded;
    return around_.view().transpose() * padded;
  }

  std::shared_ptr<const Background> background_;
  std::vector<Index> shared_;  // equation of the reference, or −1
  Eigen::Index n_zone_;
  std::vector<Index> fringe_;             // the zone first
  BlockMatrix around_;                    // the matrix at the fringe
  std::shared_ptr<const Factor> inside_;  // null: the zone is empty
};

}  // namespace

std::shared_ptr<const Factor> with_zone_correction(std::shared_ptr<const Background> reference,
                                                   const Mesh& mesh, const Layout& layout,
                                                   const BlockMatrix& matrix, std::string_view solver) {
  const Layout& before = reference->layout;
  if (before.numbering.pinned != layout.numbering.pinned) return nullptr;
  const std::vector<Index> zone = changed_zone(mesh, before, layout, layers);
  if (static_cast<double>(zone.size()) > largest_zone * matrix.n()) return nullptr;
  std::vector<Index> shared = shared_equations(before, layout);
  for (Index k = 0; k < matrix.n(); ++k)
    if (shared[k] < 0 && !std::ranges::binary_search(zone, k)) return nullptr;
  auto corrected =
      std::make_shared<ZoneCorrectedFactor>(std::move(reference), std::move(shared), zone, matrix, solver);
  return corrected->is_singular() ? nullptr : corrected;
}

}  // namespace fpi::fluid
