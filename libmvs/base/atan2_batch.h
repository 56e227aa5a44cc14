// atan2 of arrays.
#pragma once

#include <cstddef>

namespace mvs::core {

// Sets angle[k] = atan2(y[k], x[k]), in (-pi, pi], with a relative error of at most 4e-16; 0 where
// both are 0. Every element takes the same operations on every processor: its bits depend neither
// on n nor on the library of the system.
void atan2_batch(const double *y, const double *x, double *angle, size_t n);

}  // namespace mvs::core
