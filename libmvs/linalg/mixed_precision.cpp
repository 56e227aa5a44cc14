// Conjugate gradients around a float factor, with a double one in reserve.
#include "linalg/mixed_precision.h"

#include "linalg/cholesky.h"
#include "linalg/pcg.h"
#include "linalg/spmv.h"

namespace mvs::core {
namespace {

// Residual over right-hand side, in the norm of the factor: less than the linearisation error of a
// Newton step.
constexpr double residual_tolerance = 1e-3;
// A factor in double precision costs as much as about ten iterations.
constexpr uint32_t most_iterations = 8;

class MixedPrecisionCholesky final : public DirectSolver {
 public:
  void analyse(const BlockMatrix &matrix) override;
  double products() const override { return float_->products(); }
  bool factorise(const BlockMatrix &matrix) override;
  bool factorise_cheaply(const BlockMatrix &matrix) override;
  void solve(std::vector<Vec3> &b) override;
  void precondition(std::vector<Vec3> &b) override { (uses_double_ ? double_ : float_)->solve(b); }
  bool sharpen() override { return !uses_double_ && factorise_in_double(); }
  uint32_t iterations() const override { return iterations_; }
  void use_workers(Workers *workers) override {
    DirectSolver::use_workers(workers);
    float_->use_workers(workers);
    double_->use_workers(workers);
  }

 private:
  bool factorise_in_double();

  std::unique_ptr<DirectSolver> float_ = make_float_factor(), double_ = make_block_factor();
  BlockMatrix matrix_;
  bool uses_double_ = false, double_is_analysed_ = false;
  uint32_t iterations_ = 0;
  Pcg pcg_;
  BlockSpmv product_;
  std::vector<Vec3> solution_;
};

void MixedPrecisionCholesky::analyse(const BlockMatrix &matrix) {
  float_->analyse(matrix);
  double_is_analysed_ = false;
}

bool MixedPrecisionCholesky::factorise_cheaply(const BlockMatrix &matrix) {
  matrix_ = matrix;
  uses_double_ = false;
  return float_->factorise(matrix_);
}

bool MixedPrecisionCholesky::factorise(const BlockMatrix &matrix) {
  return factorise_cheaply(matrix) || factorise_in_double();
}

bool MixedPrecisionCholesky::factorise_in_double() {
  if (!double_is_analysed_) double_->analyse(matrix_);
  double_is_analysed_ = true;
  return uses_double_ = double_->factorise(matrix_);
}

// A matrix without a factor in double precision is barely indefinite: the last iterate serves, as
// it is a descent direction.
void MixedPrecisionCholesky::solve(std::vector<Vec3> &b) {
  iterations_ = 0;
  if (!uses_double_) {
    const auto multiply = [&](const std::vector<Vec3> &v, std::vector<Vec3> &y) {
      product_.multiply(matrix_, v, y);
    };
    const auto precondition = [&](const std::vector<Vec3> &r, std::vector<Vec3> &z) {
      z = r;
      float_->solve(z);
    };
    const PcgGoal goal{residual_tolerance, most_iterations, residual_tolerance};
    const PcgResult result = pcg_.solve(multiply, precondition, b, solution_, goal);
    iterations_ = result.iterations;
    if (result.error <= residual_tolerance || !factorise_in_double()) {
      b.swap(solution_);
      return;
    }
  }
  double_->solve(b);
}

}  // namespace

std::unique_ptr<DirectSolver> make_mixed_precision_cholesky() {
  return std::make_unique<MixedPrecisionCholesky>();
}

}  // namespace mvs::core
