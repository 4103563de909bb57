#include "coupling/iqn_imvj.hpp"

#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>

#include "core/error.hpp"

namespace fpi::coupling {
namespace {

/// M = Q R with as many columns as M has rank at most.
struct ThinQr {
  Eigen::MatrixXd Q, R;
  explicit ThinQr(const Eigen::MatrixXd& M) {
    const Eigen::Index rank = std::min(M.rows(), M.cols());
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(M);
    Q = qr.householderQ() * Eigen::MatrixXd::Identity(M.rows(), rank);
    R = qr.matrixQR().topRows(rank).triangularView<Eigen::Upper>();
  }
};

void append(const Eigen::MatrixXd& columns, Eigen::MatrixXd& to) {
  to.conservativeResize(columns.rows(), to.cols() + columns.cols());
  to.rightCols(columns.cols()) = columns;
}

}  // namespace

IqnImvj::IqnImvj(double first) : first_(first) {
  require(first > 0 && first <= 2, "a first relaxation factor in (0, 2] is required; got {}", first);
}

Eigen::VectorXd IqnImvj::beyond(const Eigen::VectorXd& residual) const {
  Eigen::VectorXd out = (1 - first_) * residual;
  if (A_.size() > 0) out += A_ * (B_.transpose() * residual);
  return out;
}

void IqnImvj::accept() {
  const Columns columns = take_current();
  if (columns.empty()) return;
  std::vector<const Column*> known;
  for (const Column& column : columns) known.push_back(&column);
  const Basis b = basis(known, columns.front().residual.size());
  Eigen::MatrixXd news = b.R.triangularView<Eigen::Upper>().solve<Eigen::OnTheRight>(b.results());
  for (Eigen::Index k = 0; k < news.cols(); ++k) news.col(k) -= beyond(b.Q.col(k));
  append(news, A_);
  append(b.Q, B_);
  if (A_.cols() > most_columns) compress();
}

void IqnImvj::compress() {
  const ThinQr a(A_), b(B_);
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(a.R * b.R.transpose(),
                                              Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::VectorXd& sigma = svd.singularValues();
  const auto strong = static_cast<Eigen::Index>(
      std::ranges::count_if(sigma, [&sigma](double s) { return s > weakest * sigma[0]; }));
  const Eigen::Index kept = std::min(strong, most_columns / 2);
  A_ = a.Q * svd.matrixU().leftCols(kept) * sigma.head(kept).asDiagonal();
  B_ = b.Q * svd.matrixV().leftCols(kept);
}

void IqnImvj::reject() {
  A_.resize(0, 0);
  B_.resize(0, 0);
  begin_step();
}

void IqnImvj::forget(std::span<const Eigen::Index> rows) {
  QuasiNewton::forget(rows);
  if (A_.size() == 0) return;
  for (const Eigen::Index row : rows) {
    A_.row(row).setZero();
    B_.row(row).setZero();
  }
}

ColumnCount IqnImvj::columns() const {
  ColumnCount count = QuasiNewton::columns();
  count.kept += static_cast<std::size_t>(A_.cols());
  return count;
}

/// Rows of A and B, then their numbers.
std::vector<double> IqnImvj::state() const {
  std::vector<double> state{static_cast<double>(A_.rows())};
  for (const Eigen::MatrixXd* M : {&A_, &B_}) state.insert(state.end(), M->data(), M->data() + M->size());
  return state;
}

void IqnImvj::set_state(std::span<const double> state) {
  reject();
  const auto rows = static_cast<Eigen::Index>(state[0]);
  if (rows == 0) return;
  const std::span<const double> numbers = state.subspan(1);
  const Eigen::Index cols = static_cast<Eigen::Index>(numbers.size()) / rows / 2;
  A_ = Eigen::Map<const Eigen::MatrixXd>(numbers.data(), rows, cols);
  B_ = Eigen::Map<const Eigen::MatrixXd>(numbers.data() + rows * cols, rows, cols);
}

}  // namespace fpi::coupling
