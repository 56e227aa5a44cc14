// atan2 of many numbers at once.
#pragma once

#include <cstddef>

namespace mvs::core {

// angle[k] = atan2(y[k], x[k]), in (-pi, pi], within 4e-16 of its size; 0 where both are 0. Each is
// worked out by itself, from the same operations on every processor: the bits depend neither on how
// many there are nor on the library of the system.
void atan2_batch(const double *y, const double *x, double *angle, size_t n);

}  // namespace mvs::core
