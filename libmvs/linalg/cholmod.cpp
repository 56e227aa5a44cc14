// Simplicial LDL^T of SuiteSparse CHOLMOD (Chen, Davis, Hager, Rajamanickam, 2008).
#ifdef MVS_HAVE_CHOLMOD
#include "linalg/cholmod.h"

#include <cholmod.h>

#include <cmath>
#include <new>

#include "base/error.h"

namespace mvs::core {
namespace {

class CholmodFactor final : public DirectSolver {
 public:
  CholmodFactor() {
    cholmod_start(&common_);
    common_.print = 0;
    common_.error_handler = nullptr;
    common_.supernodal = CHOLMOD_SIMPLICIAL;
    common_.final_ll = 0;
    common_.nmethods = 1;  // the rows come in a fill-reducing order
    common_.method[0].ordering = CHOLMOD_NATURAL;
    common_.postorder = 1;
  }
  CholmodFactor(const CholmodFactor &) = delete;
  CholmodFactor &operator=(const CholmodFactor &) = delete;
  ~CholmodFactor() override {
    cholmod_free_factor(&factor_, &common_);
    cholmod_free_sparse(&lower_, &common_);
    cholmod_free_dense(&x_, &common_);
    cholmod_free_dense(&y_, &common_);
    cholmod_free_dense(&e_, &common_);
    cholmod_finish(&common_);
  }

  void analyse(const BlockMatrix &matrix) override {
    cholmod_free_factor(&factor_, &common_);
    cholmod_free_sparse(&lower_, &common_);
    const size_t n = 3 * matrix.size();
    const size_t nonzeros = 9 * matrix.row.size() - n;
    lower_ = cholmod_allocate_sparse(n, n, nonzeros, 1, 1, -1, CHOLMOD_REAL, &common_);
    if (lower_ == nullptr) throw std::bad_alloc();
    fill(matrix);
    factor_ = cholmod_analyze(lower_, &common_);
    check(factor_ != nullptr);
  }

  bool factorise(const BlockMatrix &matrix) override {
    fill(matrix);
    const int ok = cholmod_factorize(lower_, factor_, &common_);
    if (common_.status == CHOLMOD_NOT_POSDEF) return false;
    check(ok != 0);
    return factor_->minor == factor_->n && positive();
  }

  void solve(std::vector<Vec3> &b) override {
    cholmod_dense rhs{};
    rhs.nrow = rhs.d = rhs.nzmax = 3 * b.size();
    rhs.ncol = 1;
    rhs.x = b.data();
    rhs.xtype = CHOLMOD_REAL;
    rhs.dtype = CHOLMOD_DOUBLE;
    const int ok =
        cholmod_solve2(CHOLMOD_A, factor_, &rhs, nullptr, &x_, nullptr, &y_, &e_, &common_);
    check(ok != 0);
    const auto *x = static_cast<const Vec3 *>(x_->x);
    std::copy(x, x + b.size(), b.begin());
  }

 private:
  void fill(const BlockMatrix &matrix) {
    expand_lower(matrix, static_cast<int *>(lower_->p), static_cast<int *>(lower_->i),
                 static_cast<double *>(lower_->x));
  }

  void check(bool ok) const {
    if (common_.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
    MVS_MUST(ok, MVS_E_INTERNAL, "backend", "CHOLMOD failed with status %d", common_.status);
  }

  // LDL^T accepts negative pivots; D is the first entry of each column of L.
  bool positive() const {
    const auto *start = static_cast<const int *>(factor_->p);
    const auto *value = static_cast<const double *>(factor_->x);
    for (size_t j = 0; j < factor_->n; ++j) {
      const double d = value[start[j]];
      if (!(d > 0) || !std::isfinite(d)) return false;
    }
    return true;
  }

  cholmod_common common_{};
  cholmod_factor *factor_ = nullptr;
  cholmod_sparse *lower_ = nullptr;
  cholmod_dense *x_ = nullptr, *y_ = nullptr, *e_ = nullptr;
};

}  // namespace

std::unique_ptr<DirectSolver> make_cholmod_solver() {
  return std::make_unique<CholmodFactor>();
}

}  // namespace mvs::core
#endif
