// Splits the sides of the sheet that cross an outline, one after the other, and removes the
// triangles inside. A split never makes another side that crosses the outline, so the inside
// becomes a set of whole triangles.
#include "surgery/cutting/cut.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "base/error.h"
#include "model/sides.h"
#include "model/valve_arrays.h"
#include "surgery/cutting/split.h"

namespace mvs::core {
namespace {

// A node nearer to the outline than this share of a side becomes a node of the cut, which avoids
// slivers.
constexpr double snap_share = 0.2;
// An outline that enters and leaves through one side within this share of it is ignored there.
constexpr double thin_share = 0.25;

class Cutter {
 public:
  Cutter(Surgery &s, Flat &flat, const Outline &outline)
      : s_(&s),
        flat_(&flat),
        outline_(&outline),
        fixed_(marks_of(s.valve.annulus, s.valve.rest.size())) {
    for (uint32_t n = 0; n < flat.at.size(); ++n) {
      side_.push_back(flat.has(n) && outline.holds(flat.at[n]) ? -1 : 1);
    }
  }

  // Marks the triangles inside.
  std::vector<uint8_t> run() {
    snap();
    open_thin_places();
    split_crossed();
    std::vector<uint8_t> inside;
    for (uint32_t t = 0; t < s_->valve.triangles.size(); ++t) inside.push_back(is_inside(t));
    return inside;
  }

 private:
  std::vector<Edge> sides_between(int8_t first, int8_t second) const;
  double crossing(uint32_t in, uint32_t out) const;
  Vec2 on(uint32_t a, uint32_t b, double share) const {
    return (1 - share) * flat_->at[a] + share * flat_->at[b];
  }
  void split(uint32_t a, uint32_t b, double share, int8_t side);
  void snap();
  void open_thin_places();
  void split_crossed();
  uint8_t is_inside(uint32_t t) const;

  Surgery *s_;
  Flat *flat_;
  const Outline *outline_;
  std::vector<int8_t> side_;  // per node: -1 inside, 0 on the outline, 1 outside
  std::vector<uint8_t> fixed_;
};

// Returns the sides of the piece that join nodes of two kinds, sorted.
std::vector<Edge> Cutter::sides_between(int8_t first, int8_t second) const {
  std::vector<Edge> sides;
  for (uint32_t t = 0; t < s_->valve.triangles.size(); ++t) {
    if (!flat_->has(s_->valve, t)) continue;
    const Tri &tri = s_->valve.triangles.get()[t];
    for (int k = 0; k < 3; ++k) {
      const uint32_t a = tri[k], b = tri[(k + 1) % 3];
      if (side_[a] == first && side_[b] == second) sides.push_back({a, b});
      if (side_[b] == first && side_[a] == second) sides.push_back({b, a});
    }
  }
  std::sort(sides.begin(), sides.end());
  sides.erase(std::unique(sides.begin(), sides.end()), sides.end());
  return sides;
}

// Returns the position of the outline between an inner and an outer node, as a share of the side.
// Bisection finds it regardless of rounding at corners of the outline.
double Cutter::crossing(uint32_t in, uint32_t out) const {
  double low = 0, high = 1;
  for (int k = 0; k < 40; ++k) {
    const double middle = 0.5 * (low + high);
    (outline_->holds(on(in, out, middle)) ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

void Cutter::split(uint32_t a, uint32_t b, double share, int8_t side) {
  const Vec2 at = on(a, b, share);
  split_side(*s_, a, b, share);
  flat_->at.push_back(at);
  side_.push_back(side);
  fixed_.push_back(0);
}

void Cutter::snap() {
  std::vector<uint32_t> near;
  for (const auto &[in, out] : sides_between(-1, 1)) {
    const double share = crossing(in, out);
    if (share < snap_share) near.push_back(in);
    if (share > 1 - snap_share && !fixed_[out]) near.push_back(out);
  }
  for (const uint32_t node : near) side_[node] = 0;
}

// If both ends of a side are outside but its middle is inside, an inner node is inserted.
void Cutter::open_thin_places() {
  constexpr int samples = 16;
  for (const auto &[a, b] : sides_between(1, 1)) {
    if (a > b) continue;
    int first = samples, last = 0;
    for (int k = 1; k < samples; ++k) {
      if (!outline_->holds(on(a, b, double(k) / samples))) continue;
      first = std::min(first, k);
      last = std::max(last, k);
    }
    if (last - first < thin_share * samples) continue;
    split(a, b, 0.5 * (first + last) / samples, -1);
  }
}

void Cutter::split_crossed() {
  for (const auto &[in, out] : sides_between(-1, 1)) {
    split(in, out, std::clamp(crossing(in, out), 0.5 * snap_share, 1 - 0.5 * snap_share), 0);
  }
}

uint8_t Cutter::is_inside(uint32_t t) const {
  if (!flat_->has(s_->valve, t)) return 0;
  const Tri &tri = s_->valve.triangles.get()[t];
  const auto [low, high] = std::minmax({side_[tri[0]], side_[tri[1]], side_[tri[2]]});
  if (low < 0) return 1;
  if (high > 0) return 0;
  return outline_->holds((flat_->at[tri[0]] + flat_->at[tri[1]] + flat_->at[tri[2]]) / 3);
}

// A connected set of triangles.
struct Piece {
  std::vector<uint32_t> triangles;
  double area = 0;
  bool held = false;  // attached to the annulus
};

// Returns the connected components of the triangles with mark `mark`.
std::vector<Piece> pieces_of(const Valve &valve, const std::vector<uint8_t> &marks, uint8_t mark) {
  const Topology topology = make_topology(valve);
  std::vector<uint8_t> seen(marks.size(), 0);
  std::vector<Piece> pieces;
  for (uint32_t start = 0; start < marks.size(); ++start) {
    if (marks[start] != mark || seen[start]) continue;
    Piece piece;
    piece.triangles =
        connected_triangles(topology, start, seen, [&](uint32_t t) { return marks[t] == mark; });
    for (const uint32_t t : piece.triangles) {
      const Tri &triangle = valve.triangles.get()[t];
      piece.area += triangle_area(valve.rest, triangle);
      for (const uint32_t n : triangle) piece.held |= topology.fixed[n] != 0;
    }
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

// Keeps one piece: small scraps beside it stay in the valve, small detached parts of the rest are
// removed with it. Larger ones are refused.
void tidy(const Surgery &s, std::vector<uint8_t> &inside) {
  constexpr double scrap = 0.05;  // share of the removed area
  std::vector<Piece> pieces = pieces_of(s.valve, inside, 1);
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const Piece &a, const Piece &b) { return a.area > b.area; });
  for (size_t p = 1; p < pieces.size(); ++p) {
    MVS_MUST(pieces[p].area < scrap * pieces[0].area, MVS_E_OP, "outline",
             "%s: the outline cuts out two pieces, of %.1f and %.1f mm2: cut one after the other",
             s.op_name, 1e6 * pieces[0].area, 1e6 * pieces[p].area);
    for (const uint32_t t : pieces[p].triangles) inside[t] = 0;
  }
  for (const Piece &piece : pieces_of(s.valve, inside, 0)) {
    if (piece.held) continue;
    MVS_MUST(piece.area < scrap * pieces[0].area, MVS_E_OP, "outline",
             "%s: the cut would leave an unattached island of %.1f mm2: make the piece "
             "narrower or take the island out as well",
             s.op_name, 1e6 * piece.area);
    for (const uint32_t t : piece.triangles) inside[t] = 1;
  }
}

// Returns the nodes between removed and remaining triangles, in order.
CutLine line_between(const Surgery &s, const std::vector<uint8_t> &inside) {
  const Topology topology = make_topology(s.valve);
  std::vector<std::vector<uint32_t>> next(s.valve.rest.size());
  for (size_t e = 0; e < topology.edges.size(); ++e) {
    const auto [t, u] = topology.edge_triangles[e];
    if (u == none || inside[t] == inside[u]) continue;
    next[topology.edges[e][0]].push_back(topology.edges[e][1]);
    next[topology.edges[e][1]].push_back(topology.edges[e][0]);
  }
  CutLine line;
  size_t ends = 0, most = 0, count = 0;
  for (uint32_t n = 0; n < next.size(); ++n) {
    count += !next[n].empty();
    most = std::max(most, next[n].size());
    if (next[n].size() == 1 && ends++ == 0) line = {n};
  }
  MVS_MUST(
      ends != 0, MVS_E_OP, "outline",
      "%s: the piece does not reach through the free edge and would leave a hole: make it wider "
      "there than a side of this mesh, or begin and end the outline beyond the free edge",
      s.op_name);
  for (uint32_t from = none; !line.empty();) {
    const std::vector<uint32_t> &at = next[line.back()];
    const uint32_t to = at[0] != from ? at[0] : at.size() > 1 ? at[1] : none;
    if (to == none || line.size() > count) break;
    from = line.back();
    line.push_back(to);
  }
  MVS_MUST(ends == 2 && most == 2 && line.size() == count, MVS_E_OP, "outline",
           "%s: the cut meets the free edge or an earlier seam more than twice: choose a simpler "
           "piece or another place",
           s.op_name);
  return line;
}

// Removes the chords that end on nodes without a remaining triangle.
void remove_loose_chords(Valve &valve, const std::vector<uint8_t> &gone) {
  std::vector<uint8_t> loose(valve.rest.size(), 0);
  for (uint32_t t = 0; t < gone.size(); ++t) {
    for (const uint32_t n : valve.triangles.get()[t]) loose[n] |= gone[t];
  }
  for (uint32_t t = 0; t < gone.size(); ++t) {
    if (gone[t]) continue;
    for (const uint32_t n : valve.triangles.get()[t]) loose[n] = 0;
  }
  std::erase_if(valve.chords.edit(),
                [&](const Chord &chord) { return loose[chord.a] || loose[chord.b]; });
}

bool crosses(const Vec2 &a, const Vec2 &b, const Vec2 &p) {
  return (a.y() > p.y()) != (b.y() > p.y()) &&
         p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
}

}  // namespace

bool Outline::holds(const Vec2 &p) const {
  bool inside = false;
  for (size_t k = 0; k < points_.size(); ++k) {
    inside ^= crosses(points_[k], points_[(k + 1) % points_.size()], p);
  }
  return inside;
}

double Outline::area() const {
  double sum = 0;
  for (size_t k = 0; k < points_.size(); ++k) {
    const Vec2 &a = points_[k], &b = points_[(k + 1) % points_.size()];
    sum += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  return std::abs(sum);
}

CutLine cut_out(Surgery &s, Flat &flat, const Outline &outline) {
  std::vector<uint8_t> inside = Cutter(s, flat, outline).run();
  MVS_MUST(
      std::find(inside.begin(), inside.end(), 1) != inside.end(), MVS_E_OP, "outline",
      "%s: no triangle lies inside: the outline misses the leaflet, or is narrower than a side of "
      "this mesh",
      s.op_name);
  tidy(s, inside);
  CutLine line = line_between(s, inside);
  remove_loose_chords(s.valve, inside);
  remove_triangles(s.valve, inside);
  return line;
}

}  // namespace mvs::core
