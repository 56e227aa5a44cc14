// Work of the pressure at the free edge. Pressure acts along the deformed normal; inside a held rim
// that is the gradient of -p V, but at a free edge it differs from a gradient by the force (p / 6)
// a x b on both ends of each edge (a, b), seen from the first node at rest
// (libmvs/energy/README.md). The potential in the statistics leaves that force out, so its work
// must be known to decide whether a step created energy.
#pragma once

#include <mvs/experimental.hpp>

#include <array>
#include <vector>

namespace stability {

class EdgeWork {
 public:
  explicit EdgeWork(const mvs::Snapshot &valve);

  // In J per Pa, from one shape to another (three numbers a node): with the constant force of the
  // first shape, as in a time step; or with the force updated along the straight path.
  double held(const double *from, const double *to) const;
  double followed(const double *from, const double *to) const;

 private:
  using Point = std::array<double, 3>;
  // (a x b) . (to - from), summed over the edges, at a share of the path.
  double slope(const double *from, const double *to, double share) const;

  std::vector<std::array<uint32_t, 2>> edges_;  // as the triangle beside them is wound
  Point origin_;
};

}  // namespace stability
