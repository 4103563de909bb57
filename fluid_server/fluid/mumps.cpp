#include "fluid/mumps.hpp"

#include <dmumps_c.h>

#include <algorithm>

#include "core/error.hpp"

namespace fpi::fluid {
namespace {

enum class Job : int { start = -1, end = -2, analyse = 1, factor = 2, solve = 3 };

/// The numbers of the manual, which count from 1.
namespace control {
constexpr int error_output = 1, diagnostic_output = 2, global_output = 3, verbosity = 4, transversal = 6,
              ordering = 7, form = 9, refinement = 10, memory_relaxation = 14;
}
namespace status {
constexpr int structurally_singular = -6, integer_space = -8, real_space = -9, singular = -10,
              no_memory_for_integers = -7, no_memory = -13, too_many_integers = -19;
}

/// The pattern as MUMPS wants it: rows and columns from 1.
struct Pattern {
  Index n;
  std::vector<MUMPS_INT> rows, columns;

  explicit Pattern(const BlockMatrix& matrix) : n(matrix.n()) {
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
    icntl(control::ordering) = 4;     // PORD: the fewest operations on these matrices
    icntl(control::refinement) = 0;   // left to the outer iteration
    icntl(control::memory_relaxation) = 30;
    m_.cntl[0] = 1e-3;  // pivot threshold
    m_.n = pattern_->n;
    m_.nnz = static_cast<MUMPS_INT8>(pattern_->rows.size());
    // MUMPS only reads the pattern and the values; its C interface knows no const.
    m_.irn = const_cast<MUMPS_INT*>(pattern_->rows.data());
    m_.jcn = const_cast<MUMPS_INT*>(pattern_->columns.data());
    run(Job::analyse);
    check("analysis");
  }
  ~Instance() { run(Job::end); }
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  /// False for a singular matrix. Pivoting can need more room than the analysis foresaw.
  bool factor(const double* values) {
    m_.a = const_cast<double*>(values);
    const MUMPS_INT relaxation = icntl(control::memory_relaxation);
    run(Job::factor);
    while ((code() == status::real_space || code() == status::integer_space) &&
           icntl(control::memory_relaxation) < 5000) {
      icntl(control::memory_relaxation) *= 2;
      run(Job::factor);
    }
    icntl(control::memory_relaxation) = relaxation;
    m_.a = nullptr;
    if (code() == status::singular || code() == status::structurally_singular) return false;
    check("factorisation");
    return true;
  }

  Vector solve(const Vector& b, bool transposed) {
    Vector x = b;
    icntl(control::form) = transposed ? 2 : 1;
    m_.rhs = x.data();
    run(Job::solve);
    m_.rhs = nullptr;
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
  explicit Instances(const BlockMatrix& matrix) : pattern_(std::make_shared<Pattern>(matrix)) {
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
    is_singular_ = !instance_->factor(matrix.values());
    // Fitted as UMFPACK's.
    factor_cost_ = 6e-11 * instance_->operations() + 4e-8 * instance_->entries();
    solve_cost_ = 3e-9 * instance_->entries();
  }
  ~MumpsFactor() override { instances_->give_back(std::move(instance_)); }

 private:
  Vector back_solve(const Vector& b, Form form) const override {
    return instance_->solve(b, form == Form::transposed);
  }

  std::shared_ptr<Instances> instances_;
  std::unique_ptr<Instance> instance_;
};

class MumpsAnalysis final : public Analysis {
 public:
  explicit MumpsAnalysis(const BlockMatrix& matrix)
      : Analysis(matrix), instances_(std::make_shared<Instances>(matrix)) {}

 private:
  std::shared_ptr<const Factor> make_factor(const BlockMatrix& matrix) const override {
    return std::make_shared<MumpsFactor>(instances_, matrix);
  }

  std::shared_ptr<Instances> instances_;
};

}  // namespace

std::shared_ptr<const Analysis> analyse_with_mumps(const BlockMatrix& matrix) {
  return std::make_shared<MumpsAnalysis>(matrix);
}

}  // namespace fpi::fluid
