// Fixtures: random matrices of blocks, and the same as dense ones.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "linalg/block_matrix.h"
#include "tests/solve/bench.h"

namespace mvs::core::test {

inline std::vector<Edge> random_pairs(Random &random, uint32_t n, size_t count) {
  std::vector<Edge> pairs;
  while (pairs.size() < count) {
    const auto i = static_cast<uint32_t>(random(0, n)), j = static_cast<uint32_t>(random(0, n));
    if (i != j) pairs.push_back({i, j});
  }
  return pairs;
}

// Random blocks; the diagonal dominates its row, so that the matrix is positive definite.
inline BlockMatrix random_matrix(Random &random, uint32_t n, size_t pairs) {
  BlockMatrix m;
  m.set_pattern(n, random_pairs(random, n, pairs));
  std::vector<double> weight(n, 1.0);
  for (uint32_t c = 0; c < n; ++c) {
    for (uint32_t k = m.start[c] + 1; k < m.start[c + 1]; ++k) {
      for (int i = 0; i < 9; ++i) m.value[k](i) = random(-1, 1);
      weight[c] += 3;
      weight[m.row[k]] += 3;
    }
  }
  for (uint32_t c = 0; c < n; ++c) {
    Mat3 &d = m.value[m.start[c]];
    for (int i = 0; i < 9; ++i) d(i) = random(-0.2, 0.2);
    d = (d + d.transpose()).eval() + weight[c] * Mat3::Identity();
  }
  return m;
}

inline Eigen::MatrixXd dense(const BlockMatrix &m) {
  const Eigen::Index n = 3 * m.size();
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(n, n);
  for (uint32_t c = 0; c < m.size(); ++c) {
    for (uint32_t k = m.start[c]; k < m.start[c + 1]; ++k) {
      full.block<3, 3>(3 * m.row[k], 3 * c) = m.value[k];
      full.block<3, 3>(3 * c, 3 * m.row[k]) = m.value[k].transpose();
    }
  }
  return full;
}

}  // namespace mvs::core::test
