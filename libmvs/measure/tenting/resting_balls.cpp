// Sequential linear programming of a ball under gravity; openings by the vertices beside them.
#include "measure/tenting/resting_balls.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/lowest_point.h"
#include "measure/annulus/frame.h"

namespace mvs::core {
namespace {

// Limits of a step along each axis, as shares of the radius; a step may be twice as long as the
// last.
constexpr double longest_step = 0.5, shortest_limit = 0.05;
// A ball takes about 7 steps from the deepest cells of a raster, and more along a sloping crevice.
constexpr int most_steps = 100;
// Descent of a step below which a ball rests, m: far below the resolution of differences over 1e-8
// m.
constexpr double at_rest = 1e-15;
// Share of the radius by which a free ball may overlap tissue: rounding where it touches.
constexpr double touching = 1e-9;
// Directions from a vertex in which a ball may pass it.
constexpr size_t directions = 32;
// Shares of the radius: distances around a low at which others are sought, and the least distance
// of two lows.
constexpr double near = 0.6, far = 1.2, same = 0.02;
// m: lows that are so much higher than the lowest are looked around, too; neighbours in one crevice
// differ by up to 0.03 mm. At most so many.
constexpr double slightly_higher = 0.05e-3;
constexpr size_t most_around = 8;
// The largest ball that passes beside a vertex, as a share of the radius: up to which it does not
// count, and from which it does. A ball of the whole radius does not touch a vertex of a concave
// edge: where it turns by 30 degrees, and the directions are 6 off, 0.93 is left.
constexpr double closed = 0.8, open = 0.92;

class RollingBall {
 public:
  RollingBall(const SheetFromAbove &sheet, double radius) : sheet_(sheet), radius_(radius) {
    double twice_area = 0;
    for (size_t k = 0; k < sheet.rim.size(); ++k) {
      twice_area += cross_in_plane(sheet.rim[k], sheet.rim[(k + 1) % sheet.rim.size()]);
    }
    inwards_ = twice_area > 0 ? 1 : -1;
    for (const Vec3 &p : sheet.x) {
      lowest_ = std::min(lowest_, p[2]);
      highest_ = std::max(highest_, p[2]);
    }
  }

  // Moves the centre up until the ball is free, by ever longer steps: walls may be a thousand times
  // as tall as the ball.
  void lift(Vec3 &centre) const {
    double step = 0.25 * radius_;
    while (centre[2] < highest_ + radius_ && !is_free(centre)) {
      centre[2] += step;
      step *= 1.5;
    }
  }
  bool is_free(const Vec3 &centre) const {
    return !sheet_.tree.is_within(centre, (1 - touching) * radius_);
  }
  enum class End { rest, known, fallen };
  // `lows`: where balls rest already; one that comes near such a place would rest there.
  End roll_down(Vec3 &centre, const std::vector<Vec3> &lows) {
    double limit = longest_step * radius_;
    for (int k = 0; k < most_steps; ++k) {
      find_bounds(centre, limit);
      if (bounds_.empty()) {
        // nothing is near: straight down to the height at which something may be
        centre[2] -= std::sqrt(sheet_.tree.closest(centre).distance2) - radius_;
      } else {
        const Vec3 step = lowest_point(bounds_, limit);
        if (!(step[2] < -at_rest)) return End::rest;
        centre += step;
        limit = radius_ *
                std::clamp(2 * step.cwiseAbs().maxCoeff() / radius_, shortest_limit, longest_step);
      }
      if (centre[2] < lowest_ - radius_) return End::fallen;
      const Vec3 low = centre - Vec3(0, 0, radius_);
      for (const Vec3 &known : lows) {
        if ((known - low).squaredNorm() < same * same * radius_ * radius_) return End::known;
      }
    }
    return End::rest;
  }
  // The radius of the largest ball, up to this one, that can be let down to a place from above; not
  // exact below `closed`.
  double clearance(const Vec3 &centre) const {
    Aabb column;
    column.add(centre - Vec3::Constant(radius_));
    column.add(Vec3(centre[0] + radius_, centre[1] + radius_, highest_));
    double least2 = radius_ * radius_;
    const double narrow2 = closed * closed * least2;
    sheet_.tree.for_overlapping(column, [&](uint32_t triangle) {
      if (least2 < narrow2) return;
      least2 = std::min({least2, sheet_.tree.closest_on(triangle, centre).distance2,
                         distance2_above(triangle, centre)});
    });
    return std::sqrt(least2);
  }

 private:
  // Lists the half-spaces of triangles and sides of the annulus near the ball, the nearest first.
  void find_bounds(const Vec3 &centre, double limit) {
    bounds_.clear();
    // a step has at most the length of half a diagonal of the cube
    const double reach = radius_ + limit * std::sqrt(3.0);
    Aabb box;
    box.add(centre - Vec3::Constant(reach));
    box.add(centre + Vec3::Constant(reach));
    sheet_.tree.for_overlapping(box, [&](uint32_t triangle) {
      if (sheet_.tree.box_of(triangle).distance2(centre) > reach * reach) return;
      const TrianglePoint closest = sheet_.tree.closest_on(triangle, centre);
      const double distance = std::sqrt(closest.distance2);
      if (distance > reach || distance == 0) return;
      const Vec3 away = (centre - sheet_.tree.point_at(triangle, closest.weight)) / distance;
      bounds_.push_back({away, std::min(0.0, radius_ - distance)});
    });
    add_sides(centre, limit);
    std::stable_sort(bounds_.begin(), bounds_.end(),
                     [](const HalfSpace &a, const HalfSpace &b) { return a.offset > b.offset; });
  }

  void add_sides(const Vec3 &centre, double limit) {
    for (size_t k = 0; k < sheet_.rim.size(); ++k) {
      Vec3 a = sheet_.rim[k], b = sheet_.rim[(k + 1) % sheet_.rim.size()];
      a[2] = b[2] = centre[2];
      const double length = (b - a).norm();
      if (length == 0) continue;
      if (closest_on_segment(centre, a, b).distance2 > 2 * limit * limit) continue;
      const Vec3 inside = inwards_ / length * Vec3(a[1] - b[1], b[0] - a[0], 0);
      const double room = inside.dot(centre - a);
      if (room >= 0) bounds_.push_back({inside, -room});
    }
  }

  // The squared horizontal distance of the part of a triangle above the centre.
  double distance2_above(uint32_t triangle, const Vec3 &centre) const {
    // the triangle, cut at the height of the centre, seen from above
    std::array<Vec3, 4> part;
    size_t count = 0;
    const auto add = [&](Vec3 p) {
      p[2] = 0;
      part[count++] = p;
    };
    for (size_t k = 0; k < 3; ++k) {
      const Vec3 a = corner(triangle, k), b = corner(triangle, (k + 1) % 3);
      const double from = a[2] - centre[2], to = b[2] - centre[2];
      if (from > 0) add(a);
      if ((from > 0) != (to > 0)) add(a + from / (from - to) * (b - a));
    }
    const Vec3 at(centre[0], centre[1], 0);
    double least2 = HUGE_VAL;
    for (size_t k = 2; k < count; ++k) {
      least2 = std::min(least2, closest_on_triangle(at, part[0], part[k - 1], part[k]).distance2);
    }
    return least2;
  }
  Vec3 corner(uint32_t triangle, size_t k) const {
    std::array<double, 3> weight = {0, 0, 0};
    weight[k] = 1;
    return sheet_.tree.point_at(triangle, weight);
  }

  const SheetFromAbove &sheet_;
  double radius_, inwards_ = 1, lowest_ = HUGE_VAL, highest_ = -HUGE_VAL;
  std::vector<HalfSpace> bounds_;
};

// Unit vectors at equal angles, from the square root of 1/2 by halving: no libm but sqrt.
std::array<Vec3, directions> compass() {
  std::array<Vec3, directions> found;
  found[0] = Vec3(1, 0, 0);
  found[directions / 4] = Vec3(0, 1, 0);
  for (size_t step = directions / 8; step > 0; step /= 2) {
    for (size_t k = step; k < directions / 4; k += 2 * step) {
      found[k] = (found[k - step] + found[k + step]).normalized();
    }
  }
  for (size_t k = directions / 4; k < directions; ++k) {
    const Vec3 &before = found[k - directions / 4];
    found[k] = Vec3(-before[1], before[0], 0);
  }
  return found;
}

bool is_lower(const Vec3 &a, const Vec3 &b) {
  return a[2] < b[2];
}

// Adds the low of a ball that is put on the leaflets at a place, if it is a new one.
void roll(RollingBall &ball, Vec3 centre, double radius, std::vector<Vec3> &lows) {
  ball.lift(centre);
  if (ball.roll_down(centre, lows) == RollingBall::End::rest) {
    lows.emplace_back(centre - Vec3(0, 0, radius));
  }
}

// Rolls the ball also from places around the lowest lows, and around lows found there: a start
// beside a saddle may roll to either side of it.
void look_around(RollingBall &ball, double radius, std::vector<Vec3> &lows) {
  static const std::array<Vec3, directions> all = compass();
  size_t looked = 0;
  for (size_t k = 0; k < lows.size() && looked < most_around; ++k) {
    const Vec3 low = lows[k];
    if (low[2] > std::min_element(lows.begin(), lows.end(), is_lower)->z() + slightly_higher) {
      continue;
    }
    ++looked;
    for (size_t d = 0; d < directions; d += directions / 8) {
      // every second one far, the others near
      const double away = (d % (directions / 4) == 0 ? far : near) * radius;
      roll(ball, low + Vec3(0, 0, radius) + away * all[d], radius, lows);
    }
  }
}

// Adds the vertices of free edges beside which a ball passes through an opening, as deep as if it
// touched them when it leaves the tissue.
void add_passed_vertices(const RollingBall &ball, const SheetFromAbove &sheet, double radius,
                         std::vector<Vec3> &lows) {
  static const std::array<Vec3, directions> all = compass();
  double deepest = 0;
  for (const Vec3 &low : lows) deepest = std::min(deepest, low[2]);
  for (const std::vector<uint32_t> &edge : sheet.free_edges) {
    for (const uint32_t node : edge) {
      const double low = sheet.x[node][2] - radius;
      if (low >= deepest) continue;
      double widest = 0;
      for (const Vec3 &direction : all) {
        const Vec3 centre = sheet.x[node] + radius * direction;
        if (!sheet.is_open(centre)) continue;
        widest = std::max(widest, ball.clearance(centre) / radius);
      }
      const double share = std::clamp((widest - closed) / (open - closed), 0.0, 1.0);
      if (share * low >= deepest) continue;
      deepest = share * low;
      lows.emplace_back(sheet.x[node][0], sheet.x[node][1], deepest);
    }
  }
}

}  // namespace

std::vector<Vec3> lows_of_ball(const SheetFromAbove &sheet, const std::vector<Vec3> &starts,
                               double radius) {
  RollingBall ball(sheet, radius);
  std::vector<Vec3> lows;
  for (const Vec3 &centre : starts) roll(ball, centre, radius, lows);
  std::stable_sort(lows.begin(), lows.end(), is_lower);
  look_around(ball, radius, lows);
  add_passed_vertices(ball, sheet, radius, lows);
  std::stable_sort(lows.begin(), lows.end(), is_lower);
  return lows;
}

}  // namespace mvs::core
