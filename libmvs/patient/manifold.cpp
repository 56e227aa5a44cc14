// Pairs of sides, walks across them, flips.
#include "patient/manifold.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "model/compressed_rows.h"
#include "model/sides.h"
#include "patient/weld.h"

namespace mvs::core {
namespace {

uint32_t corner_at(const std::vector<Tri> &triangles, uint32_t side) {
  return triangles[side / 3][side % 3];
}

uint32_t corner_after(const std::vector<Tri> &triangles, uint32_t side) {
  return triangles[side / 3][(side % 3 + 1) % 3];
}

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

// A triangle's height over its longest side.
struct FlatTriangle {
  uint32_t side = none;  // the longest
  double flatness = 1;   // height over it
};

FlatTriangle flatness_of(const std::vector<Vec3> &x, const std::vector<Tri> &triangles,
                         uint32_t t) {
  FlatTriangle flat;
  double longest = 0;
  for (uint32_t side = 3 * t; side < 3 * t + 3; ++side) {
    const double length = (x[corner_after(triangles, side)] - x[corner_at(triangles, side)]).norm();
    if (length > longest) {
      longest = length;
      flat.side = side;
    }
  }
  if (longest > 0) flat.flatness = 2 * triangle_area(x, triangles[t]) / (longest * longest);
  return flat;
}

bool has_edge(const std::vector<Tri> &triangles, uint32_t a, uint32_t b) {
  for (const Tri &t : triangles) {
    const bool has_a = t[0] == a || t[1] == a || t[2] == a;
    const bool has_b = t[0] == b || t[1] == b || t[2] == b;
    if (has_a && has_b) return true;
  }
  return false;
}

// Whether a vertex is on the boundary.
bool at_boundary(const std::vector<Tri> &triangles, const std::vector<uint32_t> &across,
                 uint32_t vertex) {
  for (uint32_t side = 0; side < across.size(); ++side) {
    if (across[side] != none) continue;
    if (corner_at(triangles, side) == vertex || corner_after(triangles, side) == vertex)
      return true;
  }
  return false;
}

// Flips the longest side of a flat triangle, or marks it as dropped if that side is on the boundary
// and the corner opposite is not; returns whether that was possible.
bool remove_one(std::vector<Tri> &triangles, const std::vector<uint32_t> &across, uint32_t side,
                std::vector<uint8_t> &kept) {
  const uint32_t t = side / 3;
  const uint32_t a = corner_at(triangles, side), b = corner_after(triangles, side);
  const uint32_t c = opposite_corner(triangles[t], {a, b});
  if (across[side] == none) {
    if (at_boundary(triangles, across, c)) return false;
    kept[t] = 0;
    return true;
  }
  const uint32_t u = across[side] / 3;
  const uint32_t d = opposite_corner(triangles[u], {a, b});
  if (d == c || has_edge(triangles, c, d)) return false;
  triangles[t] = {a, d, c};
  triangles[u] = {d, b, c};
  return true;
}

// Marks a triangle and those across its sides.
void mark_around(const std::vector<uint32_t> &across, uint32_t t, std::vector<uint8_t> &marks) {
  marks[t] = 1;
  for (uint32_t side = 3 * t; side < 3 * t + 3; ++side) {
    if (across[side] != none) marks[across[side] / 3] = 1;
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

size_t separate_fans(LeafletSheet &sheet, const std::vector<uint32_t> &across) {
  // corners 3 t + k that are one vertex: those at the ends of joined sides
  const std::vector<Tri> before = sheet.triangles;
  const Rows stars = rows_of(sheet.x.size(), before);
  std::vector<uint8_t> seen(across.size(), 0);
  const auto corner_in = [&](uint32_t t, uint32_t vertex) {
    const Tri &tri = before[t];
    return 3 * t + (tri[0] == vertex ? 0u : (tri[1] == vertex ? 1u : 2u));
  };
  size_t copies = 0;
  const uint32_t count = static_cast<uint32_t>(sheet.x.size());
  std::vector<uint32_t> open;
  for (uint32_t vertex = 0; vertex < count; ++vertex) {
    bool first = true;
    for (const uint32_t t : stars[vertex]) {
      if (seen[corner_in(t, vertex)] != 0) continue;
      const uint32_t name = first ? vertex : static_cast<uint32_t>(sheet.x.size());
      if (!first) {
        sheet.x.push_back(Vec3(sheet.x[vertex]));
        if (!sheet.thickness.empty()) sheet.thickness.push_back(double(sheet.thickness[vertex]));
        ++copies;
      }
      first = false;
      seen[corner_in(t, vertex)] = 1;
      open.assign(1, t);
      while (!open.empty()) {
        const uint32_t here = open.back();
        open.pop_back();
        const uint32_t corner = corner_in(here, vertex), k = corner % 3;
        sheet.triangles[here][k] = name;
        for (const uint32_t side : {3 * here + k, 3 * here + (k + 2) % 3}) {
          if (across[side] == none) continue;
          const uint32_t next = across[side] / 3;
          if (seen[corner_in(next, vertex)] != 0) continue;
          seen[corner_in(next, vertex)] = 1;
          open.push_back(next);
        }
      }
    }
  }
  return copies;
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
        const bool alike = corner_at(triangles, side) == corner_after(triangles, other);
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

size_t remove_flat(LeafletSheet &sheet) {
  constexpr double flattest = 1e-3;
  // a flip can leave a neighbour flat, in rows of points on one line one after another
  constexpr int most_rounds = 20;
  size_t removed = 0;
  for (int round = 0; round < most_rounds; ++round) {
    const std::vector<uint32_t> across = join_sides(sheet.x, sheet.triangles).across;
    std::vector<uint8_t> kept(sheet.triangles.size(), 1);
    std::vector<uint8_t> changed(sheet.triangles.size(), 0);  // or beside one that was
    size_t now = 0;
    for (uint32_t t = 0; t < sheet.triangles.size(); ++t) {
      const FlatTriangle flat = flatness_of(sheet.x, sheet.triangles, t);
      if (changed[t] != 0 || flat.flatness >= flattest) continue;
      const uint32_t other = across[flat.side];
      if (other != none && changed[other / 3] != 0) continue;
      if (!remove_one(sheet.triangles, across, flat.side, kept)) continue;
      mark_around(across, t, changed);
      if (other != none) mark_around(across, other / 3, changed);
      ++now;
    }
    if (now == 0) break;
    removed += now;
    keep_triangles(sheet, kept);
  }
  return removed;
}

}  // namespace mvs::core
