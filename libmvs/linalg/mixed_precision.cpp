#include "linalg/mixed_precision.h"

#include "linalg/cholesky.h"
#include "linalg/pcg.h"
#include "linalg/spmv.h"

namespace mvs::core {
namespace {

// Of the right-hand side, in the norm of the factor: what Newton's method leaves out of a step is
// more, until it has come to rest.
constexpr double tolerance = 1e-7;
// A factor in double precision costs as much as some ten.
constexpr uint32_t most_iterations = 8;

class MixedPrecisionCholesky final : public DirectSolver {
 public:
  void analyse(const BlockMatrix &matrix) override;
  bool factorise(const BlockMatrix &matrix) override;
  void solve(std::vector<Vec3> &b) override;
  uint32_t iterations() const override { return iterations_; }

 private:
  bool factorise_exactly();

  std::unique_ptr<DirectSolver> narrow_ = make_narrow_factor(), exact_ = make_block_factor();
  BlockMatrix matrix_;
  bool is_exact_ = false, is_analysed_ = false;  // the exact one
  uint32_t iterations_ = 0;
  Pcg pcg_;
  BlockSpmv product_;
  std::vector<Vec3> solution_;
};

void MixedPrecisionCholesky::analyse(const BlockMatrix &matrix) {
  narrow_->analyse(matrix);
  is_analysed_ = false;
}

bool MixedPrecisionCholesky::factorise(const BlockMatrix &matrix) {
  matrix_ = matrix;
  is_exact_ = false;
  return narrow_->factorise(matrix_) || factorise_exactly();
}

bool MixedPrecisionCholesky::factorise_exactly() {
  if (!is_analysed_) exact_->analyse(matrix_);
  is_analysed_ = true;
  return is_exact_ = exact_->factorise(matrix_);
}

// What has no exact factor is indefinite by a hair: an iterate does there, as it leads downhill.
void MixedPrecisionCholesky::solve(std::vector<Vec3> &b) {
  iterations_ = 0;
  if (!is_exact_) {
    const auto multiply = [&](const std::vector<Vec3> &v, std::vector<Vec3> &y) {
      product_.multiply(matrix_, v, y);
    };
    const auto precondition = [&](const std::vector<Vec3> &r, std::vector<Vec3> &z) {
      z = r;
      narrow_->solve(z);
    };
    const PcgGoal goal{tolerance, most_iterations, tolerance};
    const PcgResult result = pcg_.solve(multiply, precondition, b, solution_, goal);
    iterations_ = result.iterations;
    if (result.error <= tolerance || !factorise_exactly()) {
      b.swap(solution_);
      return;
    }
  }
  exact_->solve(b);
}

}  // namespace

std::unique_ptr<DirectSolver> make_mixed_precision_cholesky() {
  return std::make_unique<MixedPrecisionCholesky>();
}

}  // namespace mvs::core
