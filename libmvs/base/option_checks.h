// Checks of the caller's options, and output to arrays of the caller.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <string>

#include "base/error.h"
#include "base/types.h"

namespace mvs::core {

// Throws MVS_E_ARGUMENT if a required pointer is null.
inline void must_point(const void *pointer, const char *what) {
  MVS_MUST(pointer != nullptr, MVS_E_ARGUMENT, what, "%s is a null pointer", what);
}

// Throws MVS_E_ARGUMENT unless an index is below the number of `what` that `owner` has.
inline void must_be_index(uint32_t index, size_t count, const char *owner, const char *what) {
  MVS_MUST(index < count, MVS_E_ARGUMENT, "index", "index is %u, but the %s has %zu %s", index,
           owner, count, what);
}

// Converts a nullable text.
inline std::string text_or_empty(const char *text) {
  return text ? text : "";
}

// Throws unless a reserved field is zero, so that later versions can define it.
inline void must_be_zero(double value, const char *what) {
  MVS_MUST(value == 0, MVS_E_ARGUMENT, what,
           "%s is %g: this version has no meaning for it, leave 0", what, value);
}

inline double value_or(double value, double fallback) {
  return value == 0 ? fallback : value;
}

inline void write(const Vec3 &from, double to[3]) {
  std::copy(from.data(), from.data() + 3, to);
}

// In the order w x y z.
inline void write(const Eigen::Quaterniond &from, double to[4]) {
  to[0] = from.w();
  std::copy(from.vec().data(), from.vec().data() + 3, to + 1);
}

// Throws unless an option is a number in its range or zero, its default.
inline void must_be_in(double value, double low, double high, const char *what) {
  MVS_MUST(value == 0 || (value >= low && value <= high), MVS_E_ARGUMENT, what,
           "%s is %g: it has to be 0 (the default) or %g to %g", what, value, low, high);
}

// The same; returns the option, or its default if it is zero.
inline double or_default(double value, double fallback, double low, double high, const char *what) {
  must_be_in(value, low, high, what);
  return value_or(value, fallback);
}

}  // namespace mvs::core
