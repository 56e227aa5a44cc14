// Offset lines of the two edges at a vertex, in the plane of the annulus.
#include "measure/tenting/edge_corners.h"

#include <algorithm>
#include <cmath>

#include "measure/annulus/frame.h"

namespace mvs::core {

Corner corner_of(const Vec3 &before, const Vec3 &at, const Vec3 &after, double side,
                 double radius) {
  const auto flat = [](const Vec3 &p) { return Vec3(p[0], p[1], 0); };
  const Vec3 in = flat(at - before), out = flat(after - at);
  const double from = in.norm(), to = out.norm();
  Corner corner;
  if (!(from > 0 && to > 0)) return corner;
  const auto across = [&](const Vec3 &along, double length) {
    return Vec3(side / length * Vec3(-along[1], along[0], 0));
  };
  const Vec3 first = across(in, from), second = across(out, to), sum = first + second;
  const double twice = sum.norm();  // twice the cosine of half the turn
  if (!(twice > 0)) return corner;
  if (side * cross_in_plane(in, out) > 0) {
    // the ball touches both edges, at the same distance from the vertex, if they are so long
    const double cosine = 0.5 * twice,
                 reach = radius * std::sqrt(1 - std::min(1.0, cosine * cosine)) / cosine;
    if (reach > std::min(from, to)) return corner;
    const double height = std::max(at[2] + reach / from * (before[2] - at[2]),
                                   at[2] + reach / to * (after[2] - at[2]));
    corner.centre[corner.count++] = flat(at) + radius / cosine / twice * sum + Vec3(0, 0, height);
    return corner;
  }
  for (const Vec3 &direction : {Vec3(sum / twice), first, second}) {
    corner.centre[corner.count++] = at + radius * direction;
  }
  return corner;
}

}  // namespace mvs::core
