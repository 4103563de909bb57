#include "fluid/linear/mumps.hpp"

#include <dmumps_c.h>

#include <Eigen/LU>
#include <algorithm>

#include "core/error.hpp"

namespace fpi::fluid {
namespace {

enum class Job : int { start = -1, end = -2, analyse = 1, factor = 2, solve = 3 };
/// Of a solution around a Schur complement.
enum class SchurPhase : int { condense = 1, expand = 2 };

/// The numbers of the manual, which count from 1.
namespace control {
constexpr int error_output = 1, diagnostic_output = 2, global_output = 3, verbosity = 4, transversal = 6,
              ordering = 7, form = 9, refinement = 10, memory_relaxation = 14, schur_complement = 19,
              schur_phase = 26;
}
namespace status {
constexpr int structurally_singular = -6, integer_space = -8, real_space = -9, singular = -10,
              no_memory_for_integers = -7, no_memory = -13, too_many_integers = -19;
}

/// The pattern as MUMPS wants it, all numbers from 1.
struct Pattern {
  Index n;
  std::vector<MUMPS_INT> rows, columns, last;
  std::vector<MUMPS_INT> turn;  ///< of each unknown to be eliminated

  Pattern(const BlockMatrix& matrix, std::span<const Cluster> clusters, std::span<const Index> kept_for_last)
      : n(matrix.n()), turn(n) {
    for (const Index unknown : kept_for_last) last.push_back(unknown + 1);
    MUMPS_INT next = 1;
    for (const Index unknown : nested_dissection(matrix, clusters, kept_for_last)) turn[unknown] = next++;
    for (const Index unknown : kept_for_last) turn[unknown] = next++;
    rows.reserve(matrix.non_zeros());
    columns.reserve(matrix.non_zeros());
    for (Index c = 0; c < n; ++c)
      for (Index k = matrix.column_start()[c]; k < matrix.column_start()[c + 1]; ++k) {
        rows.push_back(matrix.row()[k] + 1);
        columns.push_back(c + 1);
      }
  }
};

/// One MUMPS instance: an analysis and the last factor made with it.
class Instance {
 public:
  explicit Instance(std::shared_ptr<const Pattern> pattern) : pattern_(std::move(pattern)) {
    m_.par = 1;
    m_.sym = 0;
    m_.comm_fortran = -987654;  // the manual's value for a communicator of all, here of one
    run(Job::start);
    check("start");
    for (const int output : {control::error_output, control::diagnostic_output, control::global_output})
      icntl(output) = -1;
    icntl(control::verbosity) = 0;
    icntl(control::transversal) = 0;  // rows are not exchanged: the pattern is symmetric
    icntl(control::ordering) = 1;     // given
    m_.perm_in = const_cast<MUMPS_INT*>(pattern_->turn.data());
    icntl(control::refinement) = 0;  // left to the outer iteration
    icntl(control::memory_relaxation) = 30;
    m_.cntl[0] = 1e-3;  // pivot threshold
    m_.n = pattern_->n;
    m_.nnz = static_cast<MUMPS_INT8>(pattern_->rows.size());
    // MUMPS only reads the pattern and the values; its C interface knows no const.
    m_.irn = const_cast<MUMPS_INT*>(pattern_->rows.data());
    m_.jcn = const_cast<MUMPS_INT*>(pattern_->columns.data());
    if (n_last() > 0) {
      icntl(control::schur_complement) = 1;  // whole, by rows
      m_.size_schur = m_.lredrhs = n_last();
      m_.listvar_schur = const_cast<MUMPS_INT*>(pattern_->last.data());
    }
    run(Job::analyse);
    check("analysis");
  }
  ~Instance() { run(Job::end); }
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  Index n_last() const { return static_cast<Index>(pattern_->last.size()); }

  /// False for a singular matrix. Pivoting can need more room than the analysis foresaw. `schur_complement`
  /// is transposed: MUMPS writes rows.
  bool factor(const double* values, Eigen::MatrixXd& schur_complement) {
    m_.a = const_cast<double*>(values);
    schur_complement.resize(n_last(), n_last());
    m_.schur = schur_complement.data();
    const MUMPS_INT relaxation = icntl(control::memory_relaxation);
    run(Job::factor);
    while ((code() == status::real_space || code() == status::integer_space) &&
           icntl(control::memory_relaxation) < 5000) {
      icntl(control::memory_relaxation) *= 2;
      run(Job::factor);
    }
    icntl(control::memory_relaxation) = relaxation;
    m_.a = m_.schur = nullptr;
    if (code() == status::singular || code() == status::structurally_singular) return false;
    check("factorisation");
    return true;
  }

  /// `solve_last` gives the unknowns kept for last from what is left for them of the right-hand side.
  template <class SolveLast>
  Vector solve(const Vector& b, bool transposed, SolveLast solve_last) {
    Vector x = b, last(n_last());
    icntl(control::form) = transposed ? 2 : 1;
    m_.rhs = x.data();
    m_.redrhs = last.data();
    if (n_last() == 0) {
      run(Job::solve);
    } else {
      run(SchurPhase::condense);
      last = solve_last(last);
      m_.redrhs = last.data();
      run(SchurPhase::expand);
    }
    m_.rhs = m_.redrhs = nullptr;
    check("solution");
    return x;
  }

  double operations() const { return m_.rinfog[2]; }
  /// Entries of both factors; MUMPS gives millions, negative, where the count does not fit.
  double entries() const { return m_.infog[28] < 0 ? -1e6 * m_.infog[28] : m_.infog[28]; }

 private:
  MUMPS_INT& icntl(int number) { return m_.icntl[number - 1]; }
  int code() const { return m_.infog[0]; }
  void run(Job job) {
    m_.job = static_cast<MUMPS_INT>(job);
    dmumps_c(&m_);
  }
  void run(SchurPhase phase) {
    if (code() < 0) return;
    icntl(control::schur_phase) = static_cast<MUMPS_INT>(phase);
    run(Job::solve);
  }
  void check(const char* phase) const {
    const bool no_memory = code() == status::no_memory || code() == status::no_memory_for_integers ||
                           code() == status::too_many_integers || code() == status::real_space ||
                           code() == status::integer_space;
    require(!no_memory,
            "the {} of {} unknowns needs more memory than there is: take a coarser mesh or a larger machine",
            phase, pattern_->n);
    require(code() >= 0, "the {} of {} unknowns failed: MUMPS status {} ({}); please report it", phase,
            pattern_->n, code(), m_.infog[1]);
  }

  std::shared_ptr<const Pattern> pattern_;
  DMUMPS_STRUC_C m_{};
};

/// MUMPS keeps one factor an instance. Factors borrow theirs and give it back, so that a new factor seldom
/// analyses again; every instance analyses alike, so which of them serves makes no difference.
class Instances {
 public:
  Instances(const BlockMatrix& matrix, std::span<const Cluster> clusters, std::span<const Index> last)
      : pattern_(std::make_shared<Pattern>(matrix, clusters, last)) {
    give_back(std::make_unique<Instance>(pattern_));
  }
  std::unique_ptr<Instance> borrow() {
    if (free_.empty()) return std::make_unique<Instance>(pattern_);
    auto instance = std::move(free_.back());
    free_.pop_back();
    return instance;
  }
  void give_back(std::unique_ptr<Instance> instance) { free_.push_back(std::move(instance)); }

 private:
  std::shared_ptr<const Pattern> pattern_;
  std::vector<std::unique_ptr<Instance>> free_;
};

class MumpsFactor final : public Factor {
 public:
  MumpsFactor(std::shared_ptr<Instances> instances, const BlockMatrix& matrix)
      : Factor(matrix.n()), instances_(std::move(instances)), instance_(instances_->borrow()) {
    is_singular_ = !instance_->factor(matrix.values(), schur_complement_);
    schur_complement_.transposeInPlace();
    if (schur_complement_.size() > 0 && !is_singular_) last_.compute(schur_complement_);
    // Fitted as UMFPACK's.
    factor_cost_ = 6e-11 * instance_->operations() + 4e-8 * instance_->entries();
    solve_cost_ = 3e-9 * instance_->entries();
  }
  ~MumpsFactor() override { instances_->give_back(std::move(instance_)); }

 private:
  Vector back_solve(const Vector& b, Form form) const override {
    const bool transposed = form == Form::transposed;
    return instance_->solve(b, transposed, [&](const Vector& left) -> Vector {
      return transposed ? Vector(last_.transpose().solve(left)) : Vector(last_.solve(left));
    });
  }

  std::shared_ptr<Instances> instances_;
  std::unique_ptr<Instance> instance_;
  Eigen::PartialPivLU<Eigen::MatrixXd> last_;  // of the Schur complement
};

class MumpsAnalysis final : public Analysis {
 public:
  MumpsAnalysis(const BlockMatrix& matrix, std::span<const Cluster> clusters, std::span<const Index> last)
      : Analysis(matrix), instances_(std::make_shared<Instances>(matrix, clusters, last)) {}

 private:
  std::shared_ptr<const Factor> make_factor(const BlockMatrix& matrix) const override {
    return std::make_shared<MumpsFactor>(instances_, matrix);
  }

  std::shared_ptr<Instances> instances_;
};

}  // namespace

std::shared_ptr<const Analysis> analyse_with_mumps(const BlockMatrix& matrix,
                                                   std::span<const Cluster> clusters,
                                                   std::span<const Index> last) {
  return std::make_shared<MumpsAnalysis>(matrix, clusters, last);
}

}  // namespace fpi::fluid
