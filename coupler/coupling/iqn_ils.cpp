#include "coupling/iqn_ils.hpp"

#include "core/error.hpp"

namespace fpi::coupling {

IqnIls::IqnIls(double first) : first_(first) {
  require(first > 0 && first <= 2, "a first relaxation factor in (0, 2] is required; got {}", first);
}

std::vector<const IqnIls::Column*> IqnIls::earlier() const {
  std::vector<const Column*> columns;
  for (const Columns& step : before_)
    for (const Column& column : step) columns.push_back(&column);
  return columns;
}

void IqnIls::accept() {
  if (!current().empty()) before_.push_front(take_current());
  if (before_.size() > reused_steps) before_.pop_back();
  begin_step();
}

void IqnIls::reject() {
  before_.clear();
  begin_step();
}

void IqnIls::forget(std::span<const Eigen::Index> rows) {
  QuasiNewton::forget(rows);
  for (Columns& step : before_)
    for (Column& column : step) column.forget(rows);
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
  reject();
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
