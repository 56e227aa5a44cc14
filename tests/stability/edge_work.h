// The work of the pressure at the free edge. Pressure pushes along the deformed normal; inside a
// held rim that is the gradient of -p V, but at a free edge it differs from one by the force
// (p / 6) a x b on both ends of each edge (a, b), seen from the first node at rest
// (libmvs/energy/README.md). The potential that statistics tell leaves that force out, so its work
// has to be known before one can say that a step made energy.
#pragma once

#include <mvs/experimental.hpp>

#include <array>
#include <vector>

namespace stability {

class EdgeWork {
 public:
  explicit EdgeWork(const mvs::Snapshot &valve);

  // In J per Pa, from one shape to another (three numbers a node): with the force that the first
  // one has, as a step in time does; or with the force followed along the straight way.
  double held(const double *from, const double *to) const;
  double followed(const double *from, const double *to) const;

 private:
  using Point = std::array<double, 3>;
  // (a x b) . (to - from), summed over the edges, at a share of the way.
  double slope(const double *from, const double *to, double share) const;

  std::vector<std::array<uint32_t, 2>> edges_;  // as the triangle beside them is wound
  Point origin_;
};

}  // namespace stability
