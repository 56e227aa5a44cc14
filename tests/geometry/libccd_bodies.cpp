// Bodies of convex tools against libccd (libccd.h), which gets them by support functions of their
// own: balls, capsules, boxes, cylinders, cones and hulls in any pose, each with a triangle or a
// segment. MVS_TEST_LONG=1: a million pairs; otherwise 5,000.
//
// Three claims are checked: the bodies that a tool has are those of its description; the least
// distance (geometry/convex_distance.h), which limits motions and refuses tools in tissue, is that
// at which libccd finds contact; the smooth distance (geometry/smooth_distance.h), which forces act
// by, differs from it by its stated share.
//
// Each least distance is proved from both sides without libccd: by two points and by two planes.
// So where both differ, libccd is wrong: its GJK ends before it has found a slight overlap of round
// bodies, by up to 10 um, and goes astray at ties, which are rare among random poses.
#include <doctest/doctest.h>

#ifndef MVS_HAS_LIBCCD
TEST_CASE("bodies_of_tools_have_the_distances_of_libccd") {
  MESSAGE("skipped: built with MVS_CCD=OFF, or without Debian's libccd-dev");
}
#else
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "energy/settings.h"
#include "geometry/convex_distance.h"
#include "geometry/smooth_distance.h"
#include "model/tool.h"
#include "session/tool_bodies.h"
#include "tests/geometry/libccd.h"
#include "tests/solve/bench.h"

using namespace mvs::core;
using namespace mvs::core::test;
using libccd::near_enough;

namespace {

const int pairs = libccd::is_long() ? 1000000 : 5000;

constexpr int kinds = 6;
constexpr std::array<const char *, kinds> kind_names = {"hull", "ball",     "capsule",
                                                        "box",  "cylinder", "cone"};

void put(const Vec3 &from, double to[3]) {
  for (int k = 0; k < 3; ++k) to[k] = from[k];
}

// A random body as a program describes it; `points` holds the vertices of a hull.
struct Described {
  Described(Random &random, int which) : kind(which) {
    body.kind = static_cast<mvs_body_kind>(which + 1);
    const Vec3 at = random.vector(3e-3);
    put(at, body.position);
    put(at + random.vector(6e-3) + Vec3(0, 0, 7e-3), body.end);
    for (double &size : body.size) size = random(0.2e-3, 5e-3);
    body.radius = random(0.1e-3, 1e-3);
    if (which == 0) {
      points = random.vectors(12, 3e-3);
      body.vertices = {points.data(), points.size(), 3, MVS_TYPE_F64, 0};
    }
    if (which == 3) {
      for (double &q : body.orientation) q = random(-1, 1);
    }
  }
  Vec3 position() const { return Vec3::Map(body.position); }
  Vec3 end() const { return Vec3::Map(body.end); }

  int kind;
  mvs_body_desc body = {};
  Positions points;
};

// The place of the hand.
struct Pose {
  Vec3 place;
  Eigen::Quaterniond turn;
  Vec3 operator()(const Vec3 &v) const { return place + turn * v; }
};

// The corners of its core as its description has them, not as the core makes them.
Positions corners_of(const Described &of) {
  const mvs_body_desc &body = of.body;
  if (of.kind == 0) return of.points;
  if (of.kind == 1) return {of.position()};
  if (of.kind != 3) return {of.position(), of.end()};
  const double *const q = body.orientation;
  const Eigen::Quaterniond turn = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized();
  Positions corners;
  for (int k = 0; k < 8; ++k) {
    const Vec3 side(k & 1 ? 0.5 : -0.5, k & 2 ? 0.5 : -0.5, k & 4 ? 0.5 : -0.5);
    corners.push_back(of.position() + turn * side.cwiseProduct(Vec3::Map(body.size)));
  }
  return corners;
}

// The same body for libccd, with true circles.
libccd::Body true_body(const Described &of, const Pose &pose) {
  Positions corners = corners_of(of);
  for (Vec3 &v : corners) v = pose(v);
  libccd::Body out = libccd::body_of(corners);
  out.radius = libccd::scale * of.body.radius;
  if (of.kind < 4) return out;
  const double circle = libccd::scale * of.body.size[0];
  out.disc = {circle, of.kind == 4 ? circle : 0};
  const Vec3 axis = (corners[1] - corners[0]).normalized();
  ccdVec3Set(&out.axis, axis.x(), axis.y(), axis.z());
  return out;
}

// The vertices of the same body as those of a tool.
struct Placed {
  Placed(const Described &of, const Pose &pose) {
    std::vector<std::string> warnings;
    Tool tool;
    tool.kind = ToolKind::convex;
    tool.node = none;
    tool.shape = read_bodies({of.body}, "desc", false, warnings);
    tool.length = tool.shape->arm();
    tool.position = pose.place;
    const Eigen::Quaterniond &q = pose.turn;
    tool.axis = rodrigues_of({q.w(), q.x(), q.y(), q.z()});
    for (uint32_t p = 0; p < frame_points; ++p) tool.proxy[p] = tool.target(p);
    place_body(*tool.shape, 0, tool.proxy, vertices);
    radius = tool.shape->bodies()[0].radius;
  }
  std::vector<Vec3> vertices;
  double radius;
};

// A body, its part of the tissue, and their distances by both.
struct Pair {
  Pair(Random &random, int which)
      : body(random, which),
        pose{random.vector(2e-3),
             Eigen::Quaterniond{random(-1, 1), random(-1, 1), random(-1, 1), random(-1, 1)}
                 .normalized()},
        placed(body, pose),
        part(random.vectors(random(0, 1) < 0.3 ? 2 : 3, 3e-3)) {
    const Vec3 away = random.vector(6e-3);
    for (Vec3 &p : part) p += away;
    least = convex_distance(placed.vertices, part, 1);
  }
  double ours() const { return least.distance - placed.radius; }
  double theirs() const { return libccd::distance(true_body(body, pose), libccd::body_of(part)); }

  Described body;
  Pose pose;
  Placed placed;
  Positions part;
  ConvexDistance least;
};

// By how much the polygon of a cylinder or cone lies inside of its circle: 1 - cos(7.5 degrees) of
// the radius.
double inside_of_circle(const Described &of) {
  return of.kind < 4 ? 0 : 0.00856 * of.body.size[0];
}

struct Count {
  int all = 0, met = 0, differ = 0, astray = 0;
  double most = 0;  // m, by which libccd is too large, where it is not astray
};

}  // namespace

TEST_CASE("bodies_of_tools_have_the_distances_at_which_libccd_finds_contact") {
  Random random(24);
  std::array<Count, kinds> counts;
  for (int k = 0; k < pairs; ++k) {
    CAPTURE(k);
    const Pair pair(random, k % kinds);
    Count &count = counts[k % kinds];
    ++count.all;
    if (pair.least.count == 0 || pair.ours() <= 0) {
      // a round body may touch where its polygon does not, and never the reverse
      ++count.met;
      const bool meets = libccd::meet(true_body(pair.body, pair.pose), libccd::body_of(pair.part));
      if (!meets) ++count.astray;
      continue;
    }
    // two planes prove that the body is not nearer, two points that it is not farther
    const Vec3 normal = pair.least.apart / pair.least.distance;
    CHECK(plane_gap(pair.placed.vertices, pair.part, normal) >= pair.least.distance - 1e-12);
    const double more = pair.theirs() - pair.ours();
    CHECK(more >= -near_enough - inside_of_circle(pair.body));
    if (more > near_enough) ++count.differ;
    if (more > 1e-5)
      ++count.astray;
    else
      count.most = std::max(count.most, more);
  }
  for (int kind = 0; kind < kinds; ++kind) {
    const Count &c = counts[kind];
    MESSAGE(std::string(kind_names[kind]), ": ", c.all, " pairs, ", c.met, " meet, ", c.differ,
            " distances differ, libccd's by up to ", 1e6 * c.most, " um too large; astray in ",
            c.astray);
    // so that both cases are tested: 4 of 834 balls in the short run, a fifth of cylinders
    CHECK(c.met > c.all / 400);
    CHECK(c.met < c.all / 2);
    // as the segments and triangles of libccd_witness.cpp
    CHECK(c.astray <= std::max(3, c.all / 10000));
  }
}

// It is the least ratio of distance and m, and m is between 1 - share / 2 and 1 + share / 2.
TEST_CASE("the_distance_that_tools_feel_is_that_of_libccd_to_its_share") {
  constexpr double share = settings::instrument::smoothing;
  Random random(25);
  int felt = 0;
  for (int k = 0; k < pairs / 5; ++k) {
    CAPTURE(k);
    const Pair pair(random, k % kinds);
    if (pair.least.count == 0 || pair.ours() <= 0) continue;
    const SmoothDistance found =
        smooth_distance(pair.placed.vertices, pair.part, pair.placed.radius, share, 1);
    const double smooth = (found.distance - pair.placed.radius) / found.factor;
    const double theirs = pair.theirs();
    if (theirs > pair.ours() + 1e-5) continue;  // astray, as above
    const double inside = inside_of_circle(pair.body);
    // 1e-5 m: what libccd may be too large by
    CHECK(smooth >= (theirs - 1e-5) / (1 + 0.5 * share));
    CHECK(smooth <= (theirs + inside + near_enough) / (1 - 0.5 * share));
    ++felt;
  }
  CHECK(felt > pairs / 10);
}
#endif
