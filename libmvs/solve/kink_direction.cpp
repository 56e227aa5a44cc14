// The mean of two forces with the shortest step.
#include "solve/kink_direction.h"

#include <algorithm>

namespace mvs::core {
namespace {

double product(const std::vector<Vec3> &a, const std::vector<Vec3> &b) {
  double sum = 0;
  for (size_t r = 0; r < a.size(); ++r) sum += a[r].dot(b[r]);
  return sum;
}

void mix(double share, const std::vector<Vec3> &other, std::vector<Vec3> &to) {
  for (size_t r = 0; r < to.size(); ++r) to[r] += share * (other[r] - to[r]);
}

}  // namespace

void KinkDirection::reserve(size_t rows) {
  force_.reserve(rows);
  rows_.reserve(rows);
}

void KinkDirection::begin(const std::vector<Vec3> &force, const std::vector<Vec3> &rows) {
  force_ = force;
  rows_ = rows;
}

// With f = f1 + s (f2 - f1) and its step, f . step is a parabola in s; its lowest point in [0, 1].
void KinkDirection::add(const std::vector<Vec3> &force, const std::vector<Vec3> &rows) {
  const double first = product(force_, rows_), both = product(force_, rows);
  const double bend = first - 2 * both + product(force, rows);
  const double share = bend > 0 ? std::clamp((first - both) / bend, 0.0, 1.0) : 0;
  mix(share, force, force_);
  mix(share, rows, rows_);
}

}  // namespace mvs::core
