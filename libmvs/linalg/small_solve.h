// Solution of small dense symmetric systems by LDL^T without pivoting (Golub and Van Loan, Matrix
// Computations, 2013, section 4.1), in scalar loops with the same bits on every processor.
#pragma once

#include <Eigen/Core>

namespace mvs::core {

// Returns x with a x = b, for a positive semidefinite matrix; components without stiffness are 0.
template <int n>
Eigen::Matrix<double, n, 1> solve_positive(Eigen::Matrix<double, n, n> a,
                                           Eigen::Matrix<double, n, 1> b) {
  for (int j = 0; j < n; ++j) {
    for (int k = 0; k < j; ++k) a(j, j) -= a(j, k) * a(j, k) * a(k, k);
    for (int i = j + 1; i < n; ++i) {
      for (int k = 0; k < j; ++k) a(i, j) -= a(i, k) * a(j, k) * a(k, k);
      a(i, j) = a(j, j) > 0 ? a(i, j) / a(j, j) : 0;
    }
  }
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < i; ++k) b[i] -= a(i, k) * b[k];
  }
  for (int i = n; i-- > 0;) {
    b[i] = a(i, i) > 0 ? b[i] / a(i, i) : 0;
    for (int k = i + 1; k < n; ++k) b[i] -= a(k, i) * b[k];
  }
  return b;
}

}  // namespace mvs::core
