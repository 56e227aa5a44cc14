// Choice of a backend, the elimination order, and the Eigen backend.
#include "linalg/direct_solver.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>
#include <algorithm>

#include "base/error.h"
#include "linalg/cholesky.h"
#include "linalg/cholmod.h"

namespace mvs::core {
namespace {

using Sparse = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

class EigenFactor final : public DirectSolver {
 public:
  void analyse(const BlockMatrix &matrix) override {
    expand(matrix, lower_);
    ldlt_.analyzePattern(lower_);
  }

  bool factorise(const BlockMatrix &matrix) override {
    expand(matrix, lower_);
    ldlt_.factorize(lower_);
    return ldlt_.info() == Eigen::Success && ldlt_.vectorD().allFinite() &&
           ldlt_.vectorD().minCoeff() > 0;
  }

  void solve(std::vector<Vec3> &b) override {
    Eigen::Map<Eigen::VectorXd> flat(b.data()->data(), static_cast<Eigen::Index>(3 * b.size()));
    flat = ldlt_.solve(flat).eval();
  }

 private:
  static void expand(const BlockMatrix &matrix, Sparse &lower) {
    const auto n = 3 * static_cast<Eigen::Index>(matrix.size());
    lower.resize(n, n);
    lower.resizeNonZeros(static_cast<Eigen::Index>(9 * matrix.row.size() - 3 * matrix.size()));
    expand_lower(matrix, lower.outerIndexPtr(), lower.innerIndexPtr(), lower.valuePtr());
  }

  Sparse lower_;
  Eigen::SimplicialLDLT<Sparse, Eigen::Lower, Eigen::NaturalOrdering<int>> ldlt_;
};

}  // namespace

void expand_lower(const BlockMatrix &matrix, int *start, int *row, double *value) {
  int at = 0;
  for (uint32_t c = 0; c < matrix.size(); ++c) {
    for (int k = 0; k < 3; ++k) {
      start[3 * c + k] = at;
      for (uint32_t slot = matrix.start[c]; slot < matrix.start[c + 1]; ++slot) {
        const Mat3 &block = matrix.value[slot];
        const int first = slot == matrix.start[c] ? k : 0;  // of a diagonal block: below it
        for (int r = first; r < 3; ++r, ++at) {
          row[at] = static_cast<int>(3 * matrix.row[slot]) + r;
          value[at] = block(r, k);
        }
      }
    }
  }
  start[3 * matrix.size()] = at;
}

std::unique_ptr<DirectSolver> make_direct_solver(Backend backend) {
  if (backend == Backend::fastest || backend == Backend::block) return make_block_factor();
  if (backend == Backend::eigen) return std::make_unique<EigenFactor>();
  MVS_MUST(backend == Backend::cholmod, MVS_E_ARGUMENT, "backend",
           "there is no factorisation number %u; use MVS_BACKEND_DEFAULT",
           static_cast<uint32_t>(backend));
#ifdef MVS_HAVE_CHOLMOD
  return make_cholmod_solver();
#else
  fail(MVS_E_UNSUPPORTED, "backend",
       "this build of libmvs has no CHOLMOD; use MVS_BACKEND_DEFAULT or build with "
       "-DMVS_CHOLMOD=ON");
#endif
}

const char *factor_names() {
#ifdef MVS_HAVE_CHOLMOD
  return "block cholmod eigen";
#else
  return "block eigen";
#endif
}

// The whole symmetric pattern goes to Eigen's minimum degree itself, since Eigen::AMDOrdering adds
// the transpose of a matrix to it at first.
std::vector<uint32_t> fill_reducing_order(uint32_t n, const std::vector<Edge> &pairs) {
  std::vector<int> next(n + 1, 0), rows(2 * pairs.size() + n);
  for (const Edge &p : pairs) {
    for (const uint32_t node : p) ++next[node + 1];
  }
  for (uint32_t c = 0; c < n; ++c) next[c + 1] += next[c] + 1;
  const std::vector<int> start = next;
  for (uint32_t c = 0; c < n; ++c) rows[next[c]++] = static_cast<int>(c);
  for (const Edge &p : pairs) {
    rows[next[p[0]]++] = static_cast<int>(p[1]);
    rows[next[p[1]]++] = static_cast<int>(p[0]);
  }
  Sparse graph(static_cast<int>(n), static_cast<int>(n));
  graph.resizeNonZeros(static_cast<Eigen::Index>(rows.size()));
  std::fill_n(graph.valuePtr(), rows.size(), 1.0);
  int *at = graph.innerIndexPtr();
  for (uint32_t c = 0; c < n; ++c) {
    graph.outerIndexPtr()[c] = static_cast<int>(at - graph.innerIndexPtr());
    std::sort(rows.begin() + start[c], rows.begin() + start[c + 1]);
    at = std::unique_copy(rows.begin() + start[c], rows.begin() + start[c + 1], at);
  }
  graph.outerIndexPtr()[n] = static_cast<int>(at - graph.innerIndexPtr());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
  Eigen::internal::minimum_degree_ordering(graph, permutation);
  std::vector<uint32_t> order(n);
  for (uint32_t k = 0; k < n; ++k) order[k] = static_cast<uint32_t>(permutation.indices()[k]);
  return order;
}

}  // namespace mvs::core
