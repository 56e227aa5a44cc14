// Bounds on the motion of nodes.
#include "collision/node_motion.h"

#include "geometry/distance.h"

namespace mvs::core {
namespace {

// Returns the share of a common motion at which the nodes are nearest to x, by least squares.
double nearest_share(const NodeMotion &motion, const std::vector<Vec3> &x) {
  double along = 0, square = 0;
  for (size_t i = 0; i < x.size(); ++i) {
    along += motion.half[i].dot(x[i] - motion.from[i]);
    square += motion.half[i].squaredNorm();
  }
  return square > 0 ? std::clamp(0.5 * along / square, 0.0, 1.0) : 0.0;
}

}  // namespace

void NodeMotion::set(const std::vector<Vec3> &from_in, const std::vector<Vec3> &to_in,
                     double slack_in, StepMotion mode_in) {
  from = from_in;
  to = to_in;
  slack = slack_in;
  mode = mode_in;
  middle.resize(from.size());
  half.resize(from.size());
  for (size_t i = 0; i < from.size(); ++i) {
    middle[i] = 0.5 * (from[i] + to[i]);
    half[i] = 0.5 * (to[i] - from[i]);
  }
}

bool NodeMotion::contains(const std::vector<Vec3> &x) const {
  if (from.size() != x.size()) return false;
  const double share = is_independent() ? 0 : nearest_share(*this, x);
  for (size_t i = 0; i < x.size(); ++i) {
    const double off2 = is_independent() ? closest_on_segment(x[i], from[i], to[i]).distance2
                                         : (x[i] - from[i] - 2 * share * half[i]).squaredNorm();
    if (off2 > slack * slack) return false;
  }
  return true;
}

}  // namespace mvs::core
