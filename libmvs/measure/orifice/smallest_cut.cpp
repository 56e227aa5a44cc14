// Free space between samples as an alpha shape (Edelsbrunner and Muecke 1994): a triangle of the
// Delaunay tetrahedra is open if a ball of the contact thickness passes. Max flow with triangle
// areas as capacities gives the minimum cut.
#include "measure/orifice/smallest_cut.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "geometry/delaunay3d.h"
#include "geometry/max_flow.h"
#include "measure/orifice/wall.h"
#include "model/sides.h"

namespace mvs::core::orifice {
namespace {

// The points of a triangle with edges up to 1 lie within 1 / sqrt(3) = 0.58 of its corners; the
// excess allows for the bend of the sheet.
constexpr double reach_of_spacing = 0.65;
constexpr double flow_unit = 1e-14;  // m2: 1e9 units are 10 mm2
// Cell numbers in the flow network: one for all atrial cells, one for all ventricular cells. Cells
// that are not reached have no number.
constexpr uint32_t atrium = 0, ventricle = 1, first_between = 2, in_wall = none - 1;

struct Ball {
  Vec3 centre;
  double radius;
};

Ball ball_through(const Vec3 &a, const Vec3 &b, const Vec3 &c) {
  const Vec3 u = b - a, v = c - a, n = u.cross(v);
  const Vec3 to_centre =
      (u.squaredNorm() * v.cross(n) + v.squaredNorm() * n.cross(u)) / (2 * n.squaredNorm());
  return {a + to_centre, to_centre.norm()};
}

Ball ball_through(const Vec3 &a, const Vec3 &b, const Vec3 &c, const Vec3 &d) {
  const Vec3 u = b - a, v = c - a, w = d - a;
  const Vec3 to_centre =
      (u.squaredNorm() * v.cross(w) + v.squaredNorm() * w.cross(u) + w.squaredNorm() * u.cross(v)) /
      (2 * u.dot(v.cross(w)));
  return {a + to_centre, to_centre.norm()};
}

class Space {
 public:
  Space(const Sheet &sheet, const TriangleBvh &tree, const Samples &samples);

  // Searches from the atrium through open triangles; returns whether it reaches the ventricle.
  bool leaks();
  std::vector<Tri> cut();

 private:
  struct CellFace {
    uint32_t cell, face;
  };
  struct Opening {
    CellFace from;  // where the search came from
    uint32_t beyond;
  };

  Tri face(uint32_t cell, uint32_t k) const;
  bool is_of_wall(const Tri &t) const;
  bool is_open(uint32_t cell, uint32_t k) const;
  void search_on();
  void pass(uint32_t cell, uint32_t k);
  Ball tightest(uint32_t cell, uint32_t k) const;

  const Sheet &sheet_;
  const Samples &samples_;
  const TriangleBvh &tree_;
  const Wall wall_;
  Delaunay mesh_;
  std::vector<Vec3> vertex_;  // on the lattice, in m, so that every cell has positive volume
  std::vector<Ball> ball_;    // through the corners of each cell
  std::vector<uint32_t> number_;
  std::vector<Opening> openings_;
  uint32_t numbers_ = first_between;
  bool arrived_ = false;
  size_t visited_ = 0;
  std::vector<uint32_t> queue_;    // cells; the first `visited_` of them are done
  std::vector<CellFace> of_wall_;  // of these cells, those between three points of the wall
};

// The bounding box is three times as large as the sheet, so that no cell joins its top and bottom
// through the valve: the sphere of such a cell would contain a part of the wall. Cells outside the
// wall do join both.
Space::Space(const Sheet &sheet, const TriangleBvh &tree, const Samples &samples)
    : sheet_(sheet), samples_(samples), tree_(tree), wall_(sheet) {
  const double half = 3 * sheet.radius, unit = 2 * half / lattice_size;
  std::vector<LatticePoint> lattice;
  for (const Vec3 &p : samples.point) {
    LatticePoint q;
    for (int k = 0; k < 3; ++k) {
      const long place = std::lround((p[k] + half) / unit);
      q[k] = static_cast<int32_t>(std::clamp<long>(place, 1, lattice_size - 1));
    }
    lattice.push_back(q);
    vertex_.push_back(unit * Vec3(q[0], q[1], q[2]) - Vec3::Constant(half));
  }
  for (int k = 0; k < 8; ++k) {
    vertex_.push_back(half * Vec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1));
  }
  mesh_ = delaunay(lattice);
  for (const Tetrahedron &cell : mesh_.tetrahedra) {
    const std::array<uint32_t, 4> &c = cell.corner;
    ball_.push_back(ball_through(vertex_[c[0]], vertex_[c[1]], vertex_[c[2]], vertex_[c[3]]));
    bool top = false, bottom = false;
    for (const uint32_t v : c) {
      if (v >= samples.point.size()) ((v - samples.point.size()) & 4 ? top : bottom) = true;
    }
    number_.push_back(top ? (bottom ? in_wall : atrium) : (bottom ? ventricle : none));
  }
}

// Returns the corners of a face, counter-clockwise seen from outside the cell.
Tri Space::face(uint32_t cell, uint32_t k) const {
  const std::array<uint32_t, 4> &c = mesh_.tetrahedra[cell].corner;
  constexpr std::array<Tri, 4> order = {{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
  return {c[order[k][0]], c[order[k][1]], c[order[k][2]]};
}

// Returns the smallest empty ball on the segment between the centres of a cell and its neighbour:
// the radius has its minimum at the plane of the common face.
Ball Space::tightest(uint32_t cell, uint32_t k) const {
  const Tri t = face(cell, k);
  const Vec3 &a = vertex_[t[0]];
  const Vec3 out = (vertex_[t[1]] - a).cross(vertex_[t[2]] - a);
  const Ball &here = ball_[cell], &there = ball_[mesh_.tetrahedra[cell].neighbour[k]];
  if ((here.centre - a).dot(out) > 0) return here;
  if ((there.centre - a).dot(out) < 0) return there;
  return ball_through(a, vertex_[t[1]], vertex_[t[2]]);
}

bool Space::is_of_wall(const Tri &t) const {
  return std::all_of(t.begin(), t.end(), [&](uint32_t v) { return v >= samples_.on_sheet; });
}

// Returns whether a ball of the contact thickness passes. Samples alone do not decide for a ball
// smaller than their spacing, and overestimate the distance to the sheet by up to `slack`; in this
// range the distance to the triangles decides. Far out, samples of the wall are too coarse for
// that: three of them are a part of it if the way from cell to cell, between the centres of their
// balls, meets the wall itself, and otherwise stand over a hollow of it.
bool Space::is_open(uint32_t cell, uint32_t k) const {
  const Tri t = face(cell, k);
  double spacing = 0;
  for (const uint32_t v : t) {
    if (v >= samples_.point.size()) return false;
    spacing = std::max(spacing, samples_.spacing[v]);
  }
  const Ball ball = tightest(cell, k);
  const double needed = 0.5 * sheet_.seal, slack = reach_of_spacing * spacing;
  if (!(ball.radius > std::max(needed, slack))) return false;
  const Vec3 &here = ball_[cell].centre, &there = ball_[mesh_.tetrahedra[cell].neighbour[k]].centre;
  if (is_of_wall(t) && wall_.is_crossed(here, there)) return false;
  if (ball.radius * ball.radius > needed * needed + slack * slack) return true;
  return !tree_.is_within(ball.centre, needed);
}

// Goes through a face if it is open and the search has not come through it.
void Space::pass(uint32_t cell, uint32_t k) {
  const uint32_t beyond = mesh_.tetrahedra[cell].neighbour[k];
  const bool arrives = number_[beyond] == ventricle;
  // of two cells with numbers, the lower one handles their face
  if (!arrives && number_[beyond] <= number_[cell]) return;
  if (!is_open(cell, k)) return;
  openings_.push_back({{cell, k}, beyond});
  arrived_ |= arrives;
  if (number_[beyond] != none) return;
  number_[beyond] = numbers_++;
  queue_.push_back(beyond);
}

// Breadth-first, but not through faces between points of the wall, which it lists.
void Space::search_on() {
  for (; visited_ < queue_.size(); ++visited_) {
    const uint32_t cell = queue_[visited_];
    for (uint32_t k = 0; k < 4; ++k) {
      const uint32_t beyond = mesh_.tetrahedra[cell].neighbour[k];
      if (beyond == none || number_[beyond] == in_wall) continue;
      if (is_of_wall(face(cell, k))) {
        of_wall_.push_back({cell, k});
      } else {
        pass(cell, k);
      }
    }
  }
}

// The atrial cells end at a roof over the samples, at the height of the highest points of the
// annulus, and the ventricular ones at a floor. Where a saddle-shaped annulus is lower, or higher,
// triangles between points of the wall are parts of these: were they closed, the cut would end at
// them, in the blood. They come last, so that an opening deep in the valve, which does not need
// them, has the same triangles in the same order as without them.
bool Space::leaks() {
  for (uint32_t c = 0; c < number_.size(); ++c) {
    if (number_[c] == atrium) queue_.push_back(c);
  }
  search_on();
  for (size_t i = 0; i < of_wall_.size(); ++i) {
    const CellFace next = of_wall_[i];  // the list may grow
    pass(next.cell, next.face);
    search_on();
  }
  return arrived_;
}

std::vector<Tri> Space::cut() {
  MaxFlow flow(numbers_);
  for (const Opening &o : openings_) {
    const double units = triangle_area(samples_.point, face(o.from.cell, o.from.face)) / flow_unit;
    flow.add_edge(number_[o.from.cell], number_[o.beyond], std::llround(units));
  }
  flow.run(atrium, ventricle);
  std::vector<Tri> triangles;
  for (const Opening &o : openings_) {
    const bool here = flow.is_on_source_side(number_[o.from.cell]);
    if (here == flow.is_on_source_side(number_[o.beyond])) continue;
    Tri t = face(o.from.cell, o.from.face);
    if (here) std::swap(t[1], t[2]);  // the normal points into the atrium
    triangles.push_back(t);
  }
  return triangles;
}

}  // namespace

std::vector<Tri> smallest_cut(const Sheet &sheet, const TriangleBvh &tree, const Samples &samples) {
  Space space(sheet, tree, samples);
  return space.leaks() ? space.cut() : std::vector<Tri>{};
}

}  // namespace mvs::core::orifice
