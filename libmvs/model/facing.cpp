// The side of the atrium, and turning triangles towards it.
#include "model/facing.h"

#include <Eigen/Geometry>

#include "model/check.h"

namespace mvs {
namespace {

// A sheet that hangs less than this share of the annulus' size from its plane does not tell where
// the ventricle is.
constexpr double flat = 1e-3;

Vec3 mean_of_heads(const Valve &valve) {
  Vec3 sum = Vec3::Zero();
  for (const Head &head : valve.heads) sum += valve.rest[head.node];
  return sum / static_cast<double>(valve.heads.size());
}

Vec3 mean_of_sheet(const Valve &valve) {
  Vec3 sum = Vec3::Zero();
  for (const Tri &triangle : valve.triangles) {
    for (const uint32_t node : triangle) sum += valve.rest[node];
  }
  return sum / (3.0 * static_cast<double>(valve.triangles.size()));
}

bool in_range(const Valve &valve) {
  const size_t n = valve.rest.size();
  for (const Tri &triangle : valve.triangles) {
    for (const uint32_t node : triangle) {
      if (node >= n) return false;
    }
  }
  for (const uint32_t node : valve.annulus) {
    if (node >= n) return false;
  }
  for (const Head &head : valve.heads) {
    if (head.node >= n) return false;
  }
  return true;
}

struct Neighbour {
  uint32_t triangle = none;
  bool same_way = false;  // both run along their edge in the same direction: one has to turn
};
using Neighbours = std::vector<std::array<Neighbour, 3>>;

Neighbours neighbours_of(const std::vector<Tri> &triangles, const std::vector<Side> &sides) {
  Neighbours neighbours(triangles.size());
  for_each_edge(sides, [&](size_t first, size_t last) {
    if (last - first != 2) return;
    const Side &l = sides[first], &r = sides[first + 1];
    const bool same_way = side_from(triangles, l) == side_from(triangles, r);
    neighbours[l.triangle][l.k] = {r.triangle, same_way};
    neighbours[r.triangle][r.k] = {l.triangle, same_way};
  });
  return neighbours;
}

// Turns the triangles connected with `first` so that they agree with it; marks them in `member`.
void make_agree(std::vector<Tri> &triangles, const Neighbours &neighbours, uint32_t first,
                std::vector<uint8_t> &member) {
  std::vector<uint8_t> turned(triangles.size(), 0);
  std::vector<uint32_t> queue = {first};
  member[first] = 1;
  for (size_t q = 0; q < queue.size(); ++q) {
    const uint32_t t = queue[q];
    for (const Neighbour &neighbour : neighbours[t]) {
      if (neighbour.triangle == none || member[neighbour.triangle]) continue;
      member[neighbour.triangle] = 1;
      turned[neighbour.triangle] = turned[t] != neighbour.same_way;
      queue.push_back(neighbour.triangle);
    }
  }
  for (const uint32_t t : queue) {
    if (turned[t]) std::swap(triangles[t][1], triangles[t][2]);
  }
}

}  // namespace

AtrialSide atrial_side(const Valve &valve) {
  AtrialSide side;
  if (valve.annulus.empty() || valve.triangles.empty()) return side;
  for (const uint32_t node : valve.annulus) side.centre += valve.rest[node];
  side.centre /= static_cast<double>(valve.annulus.size());
  Vec3 area = Vec3::Zero();
  for (size_t k = 0; k < valve.annulus.size(); ++k) {
    const Vec3 p = valve.rest[valve.annulus[k]] - side.centre;
    const Vec3 q = valve.rest[valve.annulus[(k + 1) % valve.annulus.size()]] - side.centre;
    area += 0.5 * p.cross(q);
  }
  const Vec3 ventricle = valve.heads.empty() ? mean_of_sheet(valve) : mean_of_heads(valve);
  const double depth = area.normalized().dot(side.centre - ventricle);
  if (std::abs(depth) > flat * std::sqrt(area.norm())) {
    side.axis = (depth > 0 ? 1 : -1) * area.normalized();
  }
  return side;
}

Vec3 faced_area(const Valve &valve, const std::vector<Side> &sides,
                const std::vector<uint8_t> &counts) {
  std::vector<uint8_t> in_annulus(valve.rest.size(), 0);
  for (const uint32_t node : valve.annulus) in_annulus[node] = 1;
  const Vec3 centre = atrial_side(valve).centre;
  Vec3 area = Vec3::Zero();
  for_each_edge(sides, [&](size_t first, size_t last) {
    const Side &side = sides[first];
    if (last - first != 1 || !counts[side.triangle]) return;
    if (!in_annulus[side.edge[0]] || !in_annulus[side.edge[1]]) return;
    const Vec3 p = valve.rest[side_from(valve.triangles, side)] - centre;
    const Vec3 q = valve.rest[side_to(valve.triangles, side)] - centre;
    area += 0.5 * p.cross(q);
  });
  return area;
}

void orient(Valve &valve) {
  if (!in_range(valve)) return;  // find_faults says what is wrong with it
  const std::vector<Side> sides = sorted_sides(valve.triangles);
  const Neighbours neighbours = neighbours_of(valve.triangles, sides);
  const AtrialSide atrium = atrial_side(valve);
  std::vector<uint8_t> done(valve.triangles.size(), 0);
  for (uint32_t t = 0; t < valve.triangles.size(); ++t) {
    if (done[t]) continue;
    std::vector<uint8_t> member(valve.triangles.size(), 0);
    make_agree(valve.triangles, neighbours, t, member);
    const Vec3 area = faced_area(valve, sorted_sides(valve.triangles), member);
    const bool turn = area.dot(atrium.axis) < 0;
    for (uint32_t m = 0; m < member.size(); ++m) {
      if (member[m] && turn) std::swap(valve.triangles[m][1], valve.triangles[m][2]);
      done[m] |= member[m];
    }
  }
}

}  // namespace mvs
