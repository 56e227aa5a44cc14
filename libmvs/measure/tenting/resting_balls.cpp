// Sequential linear programming of a ball under gravity; openings by the corners of free edges.
#include "measure/tenting/resting_balls.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/lowest_point.h"
#include "measure/annulus/frame.h"
#include "measure/tenting/axis_point.h"
#include "measure/tenting/edge_corners.h"

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
// Directions in which other lows are sought around one.
constexpr size_t directions = 8;
// Shares of the radius: distances around a low at which others are sought, and the least distance
// of two lows.
constexpr double near = 0.6, far = 1.2, same = 0.02;
// m: lows that are so much higher than the lowest are looked around, too; neighbours in one crevice
// differ by up to 0.03 mm. At most so many.
constexpr double slightly_higher = 0.05e-3;
constexpr size_t most_around = 8;
// The largest ball that passes beside a free edge, as a share of the radius: up to which a ball
// that is put there is not looked at, and from which it counts as passing, with its whole depth
// at 1.
constexpr double narrow = 0.8, passing = 0.99;

// m: starts that are so much higher or lower than the lowest low may roll to a lower one, as a
// raster of 0.13 mm can be wrong by that in a steep crevice.
constexpr double near_lowest = 0.5e-3;

// A ball with all that is above it, a capsule without an upper end: so it is let down from above at
// each place, and does not get under tissue.
class RollingBall {
 public:
  RollingBall(const SheetFromAbove &sheet, double radius) : sheet_(sheet), radius_(radius) {
    double twice_area = 0;
    for (size_t k = 0; k < sheet.rim.size(); ++k) {
      twice_area += cross_in_plane(sheet.rim[k], sheet.rim[(k + 1) % sheet.rim.size()]);
    }
    const double inwards = twice_area > 0 ? 1 : -1;
    for (size_t k = 0; k < sheet.rim.size(); ++k) {
      Vec3 a = sheet.rim[k], b = sheet.rim[(k + 1) % sheet.rim.size()];
      a[2] = b[2] = 0;
      const double length = (b - a).norm();
      if (length == 0) continue;
      sides_.push_back({a, b, inwards / length * Vec3(a[1] - b[1], b[0] - a[0], 0)});
    }
  }

  double radius() const { return radius_; }
  // Moves the centre up until the capsule is free, by ever longer steps: walls may be a thousand
  // times as tall as the ball.
  void lift(Vec3 &centre) const {
    double step = 0.25 * radius_;
    while (centre[2] < sheet_.box.high[2] + radius_ &&
           clearance(centre) < (1 - touching) * radius_) {
      centre[2] += step;
      step *= 1.5;
    }
  }
  enum class End { rest, known, fallen };
  // `lows`: where balls rest already; one that comes near such a place would rest there.
  End roll_down(Vec3 &centre, const std::vector<Vec3> &lows) {
    double limit = longest_step * radius_;
    for (int k = 0; k < most_steps; ++k) {
      find_bounds(centre, limit);
      const Vec3 step = lowest_point(bounds_, limit);
      if (!(step[2] < -at_rest)) return End::rest;
      centre += step;
      const bool falls = step[2] < -(1 - touching) * limit;
      if (falls && !has_tissue_below(centre)) return End::fallen;
      limit = radius_ *
              std::clamp(2 * step.cwiseAbs().maxCoeff() / radius_, shortest_limit, longest_step);
      const Vec3 low = centre - Vec3(0, 0, radius_);
      for (const Vec3 &known : lows) {
        if ((known - low).squaredNorm() < same * same * radius_ * radius_) return End::known;
      }
    }
    return End::fallen;
  }
  // Whether a place lies inside the annulus, seen from above: the number of its sides that a line
  // in one direction crosses.
  bool is_in_annulus(const Vec3 &p) const {
    bool inside = false;
    for (size_t k = 0; k < sheet_.rim.size(); ++k) {
      const Vec3 &a = sheet_.rim[k], &b = sheet_.rim[(k + 1) % sheet_.rim.size()];
      if ((a[1] > p[1]) == (b[1] > p[1])) continue;
      if (p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])) inside = !inside;
    }
    return inside;
  }
  // The radius of the largest capsule, up to that of the ball, that is free there; not exact below
  // `narrow`.
  double clearance(const Vec3 &centre) const {
    double least2 = radius_ * radius_;
    const double narrow2 = narrow * narrow * least2;
    sheet_.tree.for_overlapping(column_of(centre, radius_), [&](uint32_t triangle) {
      if (least2 >= narrow2)
        least2 = std::min(least2, closest_to_axis(corners(triangle), centre).distance2);
    });
    return std::sqrt(least2);
  }

 private:
  // Whether tissue below may stop a ball that falls: no further than its radius beside its way.
  bool has_tissue_below(const Vec3 &centre) const {
    Aabb way;
    way.add(centre - Vec3(radius_, radius_, 0));
    way.add(Vec3(centre[0] + radius_, centre[1] + radius_, sheet_.box.low[2]));
    bool stops = false;
    sheet_.tree.for_overlapping(way, [&](uint32_t triangle) {
      std::array<Vec3, 3> flat = corners(triangle);
      for (Vec3 &p : flat) p[2] = centre[2];
      stops = stops ||
              closest_on_triangle(centre, flat[0], flat[1], flat[2]).distance2 < radius_ * radius_;
    });
    return stops;
  }

  // Lists the half-spaces of triangles and sides of the annulus near the capsule, the nearest
  // first.
  void find_bounds(const Vec3 &centre, double limit) {
    bounds_.clear();
    // a step has at most the length of half a diagonal of the cube
    const double reach = radius_ + limit * std::sqrt(3.0);
    sheet_.tree.for_overlapping(column_of(centre, reach), [&](uint32_t triangle) {
      const AxisPoint closest = closest_to_axis(corners(triangle), centre);
      if (!(closest.distance2 <= reach * reach) || closest.distance2 == 0) return;
      // a unit vector: the distance has another rounding
      bounds_.push_back(
          {closest.away.normalized(), std::min(0.0, radius_ - std::sqrt(closest.distance2))});
    });
    add_sides(centre, limit);
    std::stable_sort(bounds_.begin(), bounds_.end(),
                     [](const HalfSpace &a, const HalfSpace &b) { return a.offset > b.offset; });
  }

  void add_sides(const Vec3 &centre, double limit) {
    const Vec3 flat(centre[0], centre[1], 0);
    const double reach2 = 2 * limit * limit;
    for (const Side &side : sides_) {
      const double room = side.inside.dot(flat - side.from);
      if (room * room > reach2) continue;
      if (closest_on_segment(flat, side.from, side.to).distance2 > reach2) continue;
      // a ball at a side may be beyond it by rounding; far beyond are sides of a concave annulus
      if (room > -touching * radius_) bounds_.push_back({side.inside, std::min(0.0, -room)});
    }
  }

  std::array<Vec3, 3> corners(uint32_t triangle) const {
    return {sheet_.tree.point_at(triangle, {1, 0, 0}), sheet_.tree.point_at(triangle, {0, 1, 0}),
            sheet_.tree.point_at(triangle, {0, 0, 1})};
  }
  // The box around the capsule.
  Aabb column_of(const Vec3 &centre, double reach) const {
    Aabb column;
    column.add(centre - Vec3::Constant(reach));
    column.add(Vec3(centre[0] + reach, centre[1] + reach, std::max(sheet_.box.high[2], centre[2])));
    return column;
  }

  const SheetFromAbove &sheet_;
  double radius_;
  // A side of the annulus, seen from above; `inside` is a unit vector at right angles to it.
  struct Side {
    Vec3 from, to, inside;
  };
  std::vector<Side> sides_;
  std::vector<HalfSpace> bounds_;
};

// Unit vectors at equal angles.
std::array<Vec3, directions> compass() {
  const double half = std::sqrt(0.5);
  return {Vec3(1, 0, 0),  Vec3(half, half, 0),   Vec3(0, 1, 0),  Vec3(-half, half, 0),
          Vec3(-1, 0, 0), Vec3(-half, -half, 0), Vec3(0, -1, 0), Vec3(half, -half, 0)};
}

bool is_lower(const Vec3 &a, const Vec3 &b) {
  return a[2] < b[2];
}

// Adds the low of a ball that is put on the leaflets at a place, if it is a new one.
void roll(RollingBall &ball, Vec3 centre, std::vector<Vec3> &lows) {
  if (!ball.is_in_annulus(centre)) return;
  ball.lift(centre);
  if (ball.roll_down(centre, lows) == RollingBall::End::rest) {
    lows.emplace_back(centre - Vec3(0, 0, ball.radius()));
  }
}

// Rolls the ball also from places around the lowest lows, and around lows found there: a start
// beside a saddle may roll to either side of it.
void look_around(RollingBall &ball, std::vector<Vec3> &lows) {
  static const std::array<Vec3, directions> all = compass();
  size_t looked = 0;
  for (size_t k = 0; k < lows.size() && looked < most_around; ++k) {
    const Vec3 low = lows[k];
    if (low[2] > std::min_element(lows.begin(), lows.end(), is_lower)->z() + slightly_higher) {
      continue;
    }
    ++looked;
    for (size_t d = 0; d < directions; ++d) {
      // every second one far, the others near
      const double away = (d % 2 == 0 ? far : near) * ball.radius();
      roll(ball, low + Vec3(0, 0, ball.radius()) + away * all[d], lows);
    }
  }
}

// The centres of balls that touch free edges at their vertices, the lowest first.
std::vector<Vec3> centres_beside_edges(const SheetFromAbove &sheet, double radius) {
  std::vector<Vec3> centres;
  for (const std::vector<uint32_t> &edge : sheet.free_edges) {
    for (size_t k = 0; k < edge.size(); ++k) {
      const Vec3 &before = sheet.x[edge[(k + edge.size() - 1) % edge.size()]];
      const Vec3 &at = sheet.x[edge[k]], &after = sheet.x[edge[(k + 1) % edge.size()]];
      for (const double side : {1.0, -1.0}) {
        const Corner corner = corner_of(before, at, after, side, radius);
        centres.insert(centres.end(), corner.centre.begin(), corner.centre.begin() + corner.count);
      }
    }
  }
  std::stable_sort(centres.begin(), centres.end(), is_lower);
  return centres;
}

// Adds places beside free edges where a ball passes through an opening, as low as it is when it
// leaves them; and places where it rests below, or in an opening that is a little too narrow.
void add_openings(RollingBall &ball, const SheetFromAbove &sheet, std::vector<Vec3> &lows) {
  const double radius = ball.radius();
  double deepest = lows.empty() ? 0 : std::min(0.0, lows.front()[2]);
  std::vector<Vec3> passed;
  for (const Vec3 &centre : centres_beside_edges(sheet, radius)) {
    if (!(centre[2] < radius) || !sheet.is_open(centre)) continue;
    const double widest = ball.clearance(centre) / radius;
    if (widest < narrow) continue;
    const double share = std::clamp((widest - passing) / (1 - touching - passing), 0.0, 1.0);
    const double low = centre[2] - radius;
    if (share > 0) passed.emplace_back(centre[0], centre[1], share * low);
    if (low < deepest) {
      const size_t before = lows.size();
      roll(ball, centre + Vec3(0, 0, share < 1 ? radius : 0), lows);
      if (lows.size() > before) deepest = std::min(deepest, lows.back()[2]);
    }
    deepest = std::min(deepest, share * low);
  }
  lows.insert(lows.end(), passed.begin(), passed.end());
}

}  // namespace

std::vector<Vec3> lows_of_ball(const SheetFromAbove &sheet, BallStarts starts, double radius) {
  RollingBall ball(sheet, radius);
  std::vector<Vec3> lows;
  const auto sort = [](std::vector<Vec3> &places) {
    std::stable_sort(places.begin(), places.end(), is_lower);
  };
  sort(starts.lowest);
  for (const Vec3 &centre : starts.lowest) roll(ball, centre, lows);
  sort(lows);
  add_openings(ball, sheet, lows);
  sort(lows);
  // the others may be too high by the error of a raster; those far below fall beside an opening
  sort(starts.others);
  for (const Vec3 &centre : starts.others) {
    if (lows.empty()) break;
    const double above = centre[2] - radius - lows.front()[2];
    if (std::abs(above) < near_lowest) roll(ball, centre, lows);
  }
  sort(lows);
  look_around(ball, lows);
  sort(lows);
  return lows;
}

}  // namespace mvs::core
