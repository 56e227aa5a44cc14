// Elementary functions with the same bits on every machine. (The C library selects among its own
// versions by processor, and their last bits differ.)
//
// Each consists of IEEE additions, multiplications, divisions and square roots in a fixed order, so
// that any compiler without contraction (-ffp-contract=off) gives the same bits. The largest error
// found is 0.53 ulp for log, exp and pow, 0.72 ulp for expm1 and 0.80 ulp for the others
// (tests/base/math.cpp checks that none reaches 1 ulp). Everything that can reach a state, a
// measure or a decision of a solver calls these and not the C library; a test reads the symbols of
// the linked library (tests/abi).
#pragma once

#include <cmath>

namespace mvs::core::math {

// Natural logarithm: -infinity at 0, NaN below.
double log(double x);

// exp(x), and exp(x) - 1 without cancellation near 0.
double exp(double x);
double expm1(double x);

// x^y for x >= 0; NaN for a negative x, whatever y is.
double pow(double x, double y);

// Sine and cosine of an angle in rad of any size.
double sin(double x);
double cos(double x);

// Returns the angle of (x, y) in [-pi, pi], with the signs of zeros of IEEE 754.
double atan2(double y, double x);

// Returns sqrt(a^2 + b^2) for numbers whose squares neither overflow nor underflow.
inline double hypot(double a, double b) {
  return std::sqrt(a * a + b * b);
}

}  // namespace mvs::core::math
