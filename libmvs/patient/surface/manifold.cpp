// Pairs of sides, walks across them.
#include "patient/surface/manifold.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "model/sides.h"

namespace mvs::core {
namespace {

// The unit direction from an edge into a triangle.
Vec3 inward(const std::vector<Vec3> &x, const Tri &t, const Edge &edge) {
  const Vec3 along = x[edge[1]] - x[edge[0]], to = x[opposite_corner(t, edge)] - x[edge[0]];
  const double length2 = along.squaredNorm();
  const Vec3 off = length2 > 0 ? Vec3(to - to.dot(along) / length2 * along) : to;
  const double size = off.norm();
  return size > 0 ? Vec3(off / size) : Vec3::Zero();
}

// Whether at most one in a hundred of the edges between two triangles is passed in the same
// direction by both: then the winding says which triangles belong together where more meet.
bool is_wound_alike(const std::vector<Tri> &triangles, const std::vector<Side> &sides) {
  size_t alike = 0, unlike = 0;
  for_each_edge(sides, [&](size_t first, size_t last) {
    if (last - first != 2) return;
    const bool same = side_from(triangles, sides[first]) == side_from(triangles, sides[first + 1]);
    ++(same ? unlike : alike);
  });
  return unlike <= alike / 100;
}

// Joins the sides first to last of one edge, the straightest pair first; on a tie the first. Pairs
// that pass the edge in the same direction come last if `wound_alike`.
void join_straightest(const std::vector<Vec3> &x, const std::vector<Tri> &triangles,
                      std::span<const Side> sides, bool wound_alike,
                      std::vector<uint32_t> &across) {
  std::vector<Vec3> into;
  for (const Side &side : sides) into.push_back(inward(x, triangles[side.triangle], side.edge));
  std::vector<uint8_t> joined(sides.size(), 0);
  for (size_t pair = 0; pair < sides.size() / 2; ++pair) {
    std::array<size_t, 2> best{};
    double straightest = INFINITY;
    for (size_t i = 0; i < into.size(); ++i) {
      for (size_t j = i + 1; j < into.size(); ++j) {
        if (joined[i] != 0 || joined[j] != 0) continue;
        const bool same = side_from(triangles, sides[i]) == side_from(triangles, sides[j]);
        const double bend = into[i].dot(into[j]) + (wound_alike && same ? 4 : 0);  // -1: straight
        if (bend >= straightest) continue;
        straightest = bend;
        best = {i, j};
      }
    }
    const Side &a = sides[best[0]], &b = sides[best[1]];
    across[3 * a.triangle + a.k] = 3 * b.triangle + b.k;
    across[3 * b.triangle + b.k] = 3 * a.triangle + a.k;
    joined[best[0]] = joined[best[1]] = 1;
  }
}

// Walks from a triangle across sides, each step where enter(side) returns true.
template <typename Enter>
void walk_piece(const std::vector<uint32_t> &across, uint32_t start, Enter enter) {
  std::vector<uint32_t> open = {start};
  while (!open.empty()) {
    const uint32_t t = open.back();
    open.pop_back();
    for (uint32_t side = 3 * t; side < 3 * t + 3; ++side) {
      if (across[side] != none && enter(side)) open.push_back(across[side] / 3);
    }
  }
}

}  // namespace

SurfaceJoin join_sides(const std::vector<Vec3> &x, const std::vector<Tri> &triangles) {
  SurfaceJoin join;
  join.across.assign(3 * triangles.size(), none);
  const std::vector<Side> sides = sorted_sides(triangles);
  const bool wound_alike = is_wound_alike(triangles, sides);
  for_each_edge(sides, [&](size_t first, size_t last) {
    if (last - first > 2 && join.opened++ == 0) {
      join.opened_at = 0.5 * (x[sides[first].edge[0]] + x[sides[first].edge[1]]);
    }
    join_straightest(x, triangles, {sides.data() + first, last - first}, wound_alike, join.across);
  });
  return join;
}

std::vector<uint32_t> pieces_of(const std::vector<uint32_t> &across) {
  std::vector<uint32_t> piece(across.size() / 3, none);
  uint32_t count = 0;
  for (uint32_t t = 0; t < piece.size(); ++t) {
    if (piece[t] != none) continue;
    piece[t] = count;
    walk_piece(across, t, [&](uint32_t side) {
      uint32_t &next = piece[across[side] / 3];
      if (next != none) return false;
      next = count;
      return true;
    });
    ++count;
  }
  return piece;
}

uint32_t wind_alike(LeafletSheet &sheet, const std::vector<uint32_t> &across) {
  const std::vector<uint32_t> piece = pieces_of(across);
  std::vector<Tri> &triangles = sheet.triangles;
  // 0: not reached, 1: as given, 2: to be turned; relative to the first triangle of the piece
  std::vector<uint8_t> way(piece.size(), 0);
  std::vector<double> balance;  // area as given less area to be turned, by piece
  bool two_sided = true;
  for (uint32_t t = 0; t < piece.size(); ++t) {
    if (way[t] == 0) {
      way[t] = 1;
      walk_piece(across, t, [&](uint32_t side) {
        const uint32_t other = across[side];
        const bool alike = side_start(triangles, side) == side_end(triangles, other);
        const uint8_t want = alike ? way[side / 3] : static_cast<uint8_t>(3 - way[side / 3]);
        uint8_t &have = way[other / 3];
        two_sided = two_sided && (have == 0 || have == want);
        if (have != 0) return false;
        have = want;
        return true;
      });
    }
    if (piece[t] == balance.size()) balance.push_back(0);
    const double area = triangle_area(sheet.x, triangles[t]);
    balance[piece[t]] += way[t] == 1 ? area : -area;
  }
  if (!two_sided) return none;
  uint32_t turned = 0;
  for (size_t t = 0; t < piece.size(); ++t) {
    if ((way[t] == 1) == (balance[piece[t]] >= 0)) continue;
    std::swap(triangles[t][1], triangles[t][2]);
    ++turned;
  }
  return turned;
}

}  // namespace mvs::core
