#include "coupling/iqn_ils.hpp"

#include "core/error.hpp"

namespace fpi::coupling {

IqnIls::IqnIls(double first) : first_(first) {
  require(first > 0 && first <= 2, "a first relaxation factor in (0, 2] is required; got {}", first);
}

void IqnIls::begin_step() {
  current_.clear();
  last_.reset();
}

void IqnIls::learn(const Eigen::VectorXd& x, const Eigen::VectorXd& residual) {
  Column now{residual, x + residual};
  if (last_) {
    Column column{now.residual - last_->residual, now.result - last_->result};
    if (column.residual.norm() > 0) current_.push_front(std::move(column));
  }
  last_ = std::move(now);
}

/// Columns in the order of their age are made orthogonal one by one; min |r + V α| then takes one product
/// each, and α follows from the triangle R.
Eigen::VectorXd IqnIls::next(const Eigen::VectorXd& x, const Eigen::VectorXd& residual) {
  learn(x, residual);
  const auto most = static_cast<std::size_t>(x.size());
  std::vector<const Column*> kept;
  Eigen::MatrixXd Q(x.size(), x.size()), R = Eigen::MatrixXd::Zero(x.size(), x.size());
  const auto try_column = [&](const Column& column, bool must) {
    if (kept.size() == most) return;
    const auto k = static_cast<Eigen::Index>(kept.size());
    Eigen::VectorXd q = column.residual, above = Eigen::VectorXd::Zero(k);
    for (int twice = 0; twice < 2; ++twice) {  // once more against round-off
      const Eigen::VectorXd along = Q.leftCols(k).transpose() * q;
      q -= Q.leftCols(k) * along;
      above += along;
    }
    const double left = q.norm();
    if (left <= (must ? 0 : filter * column.residual.norm())) return;
    R.col(k).head(k) = above;
    R(k, k) = left;
    Q.col(k) = q / left;
    kept.push_back(&column);
  };
  bool newest = true;
  for (const Column& column : current_) try_column(column, std::exchange(newest, false));
  for (const Columns& step : before_)
    for (const Column& column : step) try_column(column, false);
  if (kept.empty()) return x + first_ * residual;

  const auto n = static_cast<Eigen::Index>(kept.size());
  const Eigen::VectorXd against = Q.leftCols(n).transpose() * residual;
  const Eigen::VectorXd alpha = R.topLeftCorner(n, n).triangularView<Eigen::Upper>().solve(-against);
  // What no column spans is relaxed as without any.
  Eigen::VectorXd out = x + residual - (1 - first_) * (residual - Q.leftCols(n) * against);
  for (Eigen::Index k = 0; k < n; ++k) out += alpha[k] * kept[k]->result;
  return out;
}

void IqnIls::finish(const Eigen::VectorXd& x, const Eigen::VectorXd& residual) { learn(x, residual); }

void IqnIls::accept() {
  if (!current_.empty()) before_.push_front(std::move(current_));
  if (before_.size() > reused_steps) before_.pop_back();
  begin_step();
}

void IqnIls::reject() {
  before_.clear();
  begin_step();
}

/// Size of a column, then for each step its number of columns and their numbers.
std::vector<double> IqnIls::state() const {
  std::vector<double> state{before_.empty() ? 0.0
                                            : static_cast<double>(before_.front().front().residual.size())};
  for (const Columns& step : before_) {
    state.push_back(static_cast<double>(step.size()));
    for (const Column& column : step)
      for (const Eigen::VectorXd* v : {&column.residual, &column.result})
        state.insert(state.end(), v->begin(), v->end());
  }
  return state;
}

void IqnIls::set_state(std::span<const double> state) {
  before_.clear();
  begin_step();
  const auto size = static_cast<std::size_t>(state[0]);
  const auto take = [&state](std::size_t n) {
    const std::span<const double> taken = state.first(n);
    state = state.subspan(n);
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(taken.data(), static_cast<Eigen::Index>(n)));
  };
  take(1);
  while (!state.empty()) {
    Columns step(static_cast<std::size_t>(take(1)[0]));
    for (Column& column : step) {
      column.residual = take(size);
      column.result = take(size);
    }
    before_.push_back(std::move(step));
  }
}

}  // namespace fpi::coupling
