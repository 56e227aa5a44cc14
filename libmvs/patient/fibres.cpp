// The fibre through a vertex goes straight on in the triangle that the gradient points into;
// transport is repeated over all vertices until nothing moves.
#include "patient/fibres.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "model/sides.h"
#include "patient/coordinates.h"

namespace mvs::core {
namespace {

// Where the fibre through a vertex leaves the triangles around it: the point a + share (b - a).
struct FibreStep {
  uint32_t a = none, b = none;
  double share = 0;
  double length = 0;  // m
};

// The gradient of a linear function on a triangle.
Vec3 gradient(const LeafletSheet &sheet, const std::vector<double> &u, const Tri &t) {
  const Vec3 e1 = sheet.x[t[1]] - sheet.x[t[0]], e2 = sheet.x[t[2]] - sheet.x[t[0]];
  const Vec3 normal = e1.cross(e2);
  const double area2 = normal.squaredNorm();
  if (area2 == 0) return Vec3::Zero();
  return ((u[t[1]] - u[t[0]]) * e2.cross(normal) + (u[t[2]] - u[t[0]]) * normal.cross(e1)) / area2;
}

// The step from a vertex along `sign` times the gradient: through the opposite side of one of its
// triangles, else along the edge that leads farthest per length.
FibreStep fibre_step(const LeafletSheet &sheet, const std::vector<double> &u,
                     std::span<const uint32_t> star, uint32_t vertex, double sign) {
  // relative: of two equal ways, as on a symmetric sheet, the first is taken, whatever the rounding
  constexpr double tie = 1e-6;
  // of the whole way from rim to rim, which is 1: a smaller rise is an error of the solution
  constexpr double least_gain = 1e-9;
  FibreStep best;
  double steepest = 0;
  const auto offer = [&](uint32_t a, uint32_t b, double share) {
    const Vec3 q = sheet.x[a] + share * (sheet.x[b] - sheet.x[a]);
    const double gain = sign * (u[a] + share * (u[b] - u[a]) - u[vertex]);
    const double length = (q - sheet.x[vertex]).norm();
    if (length <= 0 || gain <= least_gain || gain / length <= (1 + tie) * steepest) return;
    steepest = gain / length;
    best = {a, b, share, length};
  };
  for (const uint32_t t : star) {
    const Tri &tri = sheet.triangles[t];
    const size_t k = static_cast<size_t>(std::find(tri.begin(), tri.end(), vertex) - tri.begin());
    const uint32_t a = tri[(k + 1) % 3], b = tri[(k + 2) % 3];
    offer(a, b, 0);
    offer(b, a, 0);
    const Vec3 way = sign * gradient(sheet, u, tri);
    const Vec3 ea = sheet.x[a] - sheet.x[vertex], eb = sheet.x[b] - sheet.x[vertex];
    const Vec3 normal = ea.cross(eb);
    const double at_a = ea.cross(way).dot(normal), at_b = way.cross(eb).dot(normal);
    // the ray passes between both corners
    if (at_a > 0 && at_b > 0) offer(a, b, at_a / (at_a + at_b));
  }
  return best;
}

// Steps for vertices without one, to their nearest neighbour that has one or is held, from ring to
// ring. A triangle with two sides on a rim has such a corner: all around it is the value of the
// rim.
void complete_steps(const LeafletSheet &sheet, const Rows &stars, const std::vector<uint8_t> &held,
                    std::vector<FibreStep> &step) {
  for (bool any = true; any;) {
    any = false;
    const std::vector<FibreStep> before = step;
    for (uint32_t i = 0; i < step.size(); ++i) {
      if (held[i] != 0 || before[i].a != none) continue;
      for (const uint32_t j : neighbours_in(sheet.triangles, stars[i], i)) {
        if (held[j] == 0 && before[j].a == none) continue;
        const double length = (sheet.x[j] - sheet.x[i]).norm();
        if (step[i].a == none || length < step[i].length) step[i] = {j, j, 0, length};
      }
      any = any || step[i].a != none;
    }
  }
}

}  // namespace

// A vertex may depend on one that comes later in the order, so passes are repeated until nothing
// moves.
FibreTransport carry_along_fibres(const LeafletSheet &sheet, const std::vector<double> &u,
                                  const Rows &stars, double sign, const std::vector<uint8_t> &held,
                                  const std::vector<double> &foot, double loop) {
  const size_t n = u.size();
  std::vector<uint32_t> order(n);
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](uint32_t i, uint32_t j) { return sign * u[i] > sign * u[j]; });
  std::vector<FibreStep> step(n);
  for (uint32_t i = 0; i < n; ++i) {
    if (!held[i]) step[i] = fibre_step(sheet, u, stars[i], i, sign);
  }
  complete_steps(sheet, stars, held, step);
  FibreTransport t{std::vector<double>(n, 0), foot};
  constexpr int most_passes = 100;
  constexpr double still = 1e-9;  // m
  double moved = 1;
  for (int pass = 0; pass < most_passes && moved > still; ++pass) {
    moved = 0;
    for (const uint32_t i : order) {
      const FibreStep &s = step[i];
      if (s.a == none) continue;
      const double length = s.length + t.length[s.a] + s.share * (t.length[s.b] - t.length[s.a]);
      const double way = s.share * around(t.foot[s.a], t.foot[s.b], loop);
      moved = std::max(moved, std::abs(length - t.length[i]));
      t.length[i] = length;
      t.foot[i] = wrapped(t.foot[s.a] + way, loop);
    }
  }
  return t;
}

}  // namespace mvs::core
