// Matches nodes of two levels by rest position, locates fine nodes on the coarse sheet, and
// transfers states.
#include "anatomy/level_map.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "anatomy/sheet_walk.h"
#include "base/error.h"
#include "geometry/distance.h"

namespace mvs::core {
namespace {

// Sort key of a node: its rest position, sheet nodes first. Several branch points may have one
// position; they are matched in order.
struct Placed {
  bool off_sheet;
  double x, y, z;
  uint32_t node;

  auto key() const { return std::tie(off_sheet, x, y, z); }
};

std::vector<Placed> by_place(const Valve &valve) {
  std::vector<Placed> placed;
  for (uint32_t n = 0; n < valve.rest.size(); ++n) {
    const Vec3 &p = valve.rest[n];
    placed.push_back({true, p[0], p[1], p[2], n});
  }
  for (const Tri &triangle : valve.triangles) {
    for (const uint32_t node : triangle) placed[node].off_sheet = false;
  }
  std::sort(placed.begin(), placed.end(), [](const Placed &l, const Placed &r) {
    return l.key() != r.key() ? l.key() < r.key() : l.node < r.node;
  });
  return placed;
}

// Returns the orthogonal projection of a point onto the plane of a triangle, and its height.
LevelPlace place_in(const Model &coarse, uint32_t triangle, const Vec3 &p) {
  const Tri &nodes = coarse.valve.triangles[triangle];
  const Vec3 &a = coarse.valve.rest[nodes[0]];
  const Vec3 ab = coarse.valve.rest[nodes[1]] - a, ac = coarse.valve.rest[nodes[2]] - a;
  const Vec3 ap = p - a, normal = ab.cross(ac);
  const double area2 = normal.squaredNorm();
  const double second = ap.cross(ac).dot(normal) / area2;
  const double third = ab.cross(ap).dot(normal) / area2;
  return {nodes, {1 - second - third, second, third}, ap.dot(normal) / std::sqrt(area2)};
}

// Returns for every fine sheet node the common node with the fewest fine edges in between
// (breadth-first search).
std::vector<uint32_t> nearest_coarse(const LevelMap &map, const Model &fine) {
  std::vector<uint32_t> nearest(fine.node_count(), none), queue;
  for (uint32_t c = 0; c < map.fine_of_coarse.size(); ++c) {
    nearest[map.fine_of_coarse[c]] = c;
    queue.push_back(map.fine_of_coarse[c]);
  }
  for (size_t q = 0; q < queue.size(); ++q) {
    for (const uint32_t t : fine.topology.node_triangles[queue[q]]) {
      for (const uint32_t node : fine.valve.triangles[t]) {
        if (nearest[node] != none) continue;
        nearest[node] = nearest[queue[q]];
        queue.push_back(node);
      }
    }
  }
  return nearest;
}

// The unit normal of a triangle and its rate of change for given corner velocities.
struct Normal {
  Vec3 direction, rate;
};
Normal normal_of(const Tri &t, const std::vector<Vec3> &x, const std::vector<Vec3> &v) {
  const Vec3 ab = x[t[1]] - x[t[0]], ac = x[t[2]] - x[t[0]], cross = ab.cross(ac);
  const double length = cross.norm();
  if (!(length > 0)) return {Vec3::Zero(), Vec3::Zero()};
  const Vec3 unit = cross / length;
  const Vec3 change = (v[t[1]] - v[t[0]]).cross(ac) + ab.cross(v[t[2]] - v[t[0]]);
  return {unit, (change - change.dot(unit) * unit) / length};
}

Vec3 mean(const LevelPlace &place, const std::vector<Vec3> &rows) {
  Vec3 sum = Vec3::Zero();
  for (int k = 0; k < 3; ++k) sum += place.weight[k] * rows[place.nodes[k]];
  return sum;
}

// Returns whether a place has prescribed corners and all of them are at their prescribed positions.
bool is_held_there(const LevelPlace &place, const Model &coarse, const State &state) {
  constexpr double there = 1e-9;  // m: far above rounding, far below any visible motion
  int held = 0;
  for (const uint32_t node : place.nodes) {
    if (!coarse.topology.fixed[node]) continue;
    ++held;
    const Vec3 target = coarse.target(node, state.load.boundary_fraction);
    if ((state.x[node] - target).norm() > there) return false;
  }
  return held > 0;
}

// The values of a state that do not depend on the mesh.
State without_nodes(const State &state) {
  State made = state;
  made.x.clear();
  made.v.clear();
  made.tools.clear();
  made.drop_cache();
  made.rest_tolerance = 0;
  return made;
}

void must_be_levels(bool they_are) {
  MVS_MUST(they_are, MVS_E_ARGUMENT, "nodes",
           "the two valves are not levels of one valve: every node of the coarser one has to be a "
           "node of the finer one, at the same rest place; make one from the other with refine or "
           "coarsen");
}

bool all_found(const std::vector<uint32_t> &nodes) {
  return std::find(nodes.begin(), nodes.end(), none) == nodes.end();
}

}  // namespace

std::vector<uint32_t> nodes_in(const Valve &coarse, const Valve &fine) {
  const std::vector<Placed> wanted = by_place(coarse), there = by_place(fine);
  std::vector<uint32_t> found(coarse.rest.size(), none);
  for (size_t c = 0, f = 0; c < wanted.size() && f < there.size();) {
    if (wanted[c].key() == there[f].key()) {
      found[wanted[c++].node] = there[f++].node;
    } else {
      wanted[c].key() < there[f].key() ? ++c : ++f;
    }
  }
  return found;
}

LevelMap make_level_map(const Model &coarse, const Model &fine) {
  return make_level_map(coarse, fine, nodes_in(coarse.valve, fine.valve));
}

LevelMap make_level_map(const Model &coarse, const Model &fine,
                        std::vector<uint32_t> fine_of_coarse) {
  must_be_levels(all_found(fine_of_coarse));
  LevelMap map{std::move(fine_of_coarse), {}};
  const std::vector<uint32_t> nearest = nearest_coarse(map, fine);
  must_be_levels(all_found(nearest));
  const SheetWalk walk(coarse);
  for (uint32_t n = 0; n < fine.node_count(); ++n) {
    const uint32_t c = nearest[n];
    const Vec3 &p = fine.valve.rest[n];
    const bool same = map.fine_of_coarse[c] == n;
    map.place.push_back(same ? LevelPlace{{c, c, c}, {1, 0, 0}, 0}
                             : place_in(coarse, walk.nearest(c, p), p));
  }
  return map;
}

double distance_from(const Model &coarse, const LevelPlace &place, const Vec3 &p) {
  const std::vector<Vec3> &x = coarse.valve.rest;
  const auto &[a, b, c] = place.nodes;
  if (a == b) return (p - x[a]).norm();
  return std::sqrt(closest_on_triangle(p, x[a], x[b], x[c]).distance2);
}

State to_fine(const LevelMap &map, const Model &coarse, const Model &fine, const State &state) {
  State made = without_nodes(state);
  for (uint32_t n = 0; n < map.place.size(); ++n) {
    const LevelPlace &place = map.place[n];
    Vec3 x = mean(place, state.x), v = mean(place, state.v);
    if (place.height != 0) {
      const Normal normal = normal_of(place.nodes, state.x, state.v);
      x += place.height * normal.direction;
      v += place.height * normal.rate;
    }
    const bool kept = place.nodes[0] == place.nodes[1];
    if (!kept && fine.topology.fixed[n] && is_held_there(place, coarse, state)) {
      x = fine.target(n, state.load.boundary_fraction);
    }
    made.x.push_back(x);
    made.v.push_back(v);
  }
  return made;
}

State to_coarse(const LevelMap &map, const State &state) {
  State made = without_nodes(state);
  for (const uint32_t node : map.fine_of_coarse) {
    made.x.push_back(state.x.get()[node]);
    made.v.push_back(state.v.get()[node]);
  }
  return made;
}

State transferred(const Model &from, const State &state, const Model &to) {
  std::vector<uint32_t> in_to = nodes_in(from.valve, to.valve);
  if (all_found(in_to)) return to_fine(make_level_map(from, to, std::move(in_to)), from, to, state);
  std::vector<uint32_t> in_from = nodes_in(to.valve, from.valve);
  must_be_levels(all_found(in_from));
  return to_coarse({std::move(in_from), {}}, state);
}

}  // namespace mvs::core
