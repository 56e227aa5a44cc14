// Surface of least area with a rim that slides on the sheet: node by node majorise-minimise sweeps,
// in which the area never increases.
#include "measure/orifice/smallest_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "linalg/small_solve.h"
#include "measure/tissue/surface.h"
#include "model/sides.h"

namespace mvs::core::orifice {
namespace {

// Target edge length over the root of the area, at which a chord of a circle is 1 % below its arc;
// not below the spacing of the samples.
constexpr double edge_of_size = 0.15;
constexpr int max_sweeps = 100;
constexpr double overshoot = 1.7;  // of the move of a free node: 1.5 to 1.8 need the fewest sweeps
constexpr double enough = 1e-5;    // relative decrease of area in the last sweep
// A rim edge whose midpoint is farther from the sheet than this share of its length does not run
// along the sheet. The value is 0.13 over a crease of 60 degrees, 0.5 across a sealed passage.
constexpr double off_of_length = 0.15;
// Radius around a node in which the triangles nearest to it are collected, in spacings of samples.
constexpr double around_of_grain = 0.25;

enum class Hold : uint8_t { free, slides, stays };
enum class OnRim : uint8_t { unknown, no, yes };

class Shrinking {
 public:
  Shrinking(const Sheet &sheet, const TriangleBvh &tree, Mesh mesh, size_t on_samples);
  Mesh run();

 private:
  // Triangles near a place of a node: no others matter for points near it.
  struct Around {
    Vec3 centre = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
    std::vector<uint32_t> triangles;
  };

  void hold_rim(size_t on_samples);
  void list_triangles();
  double sweep();
  double area_around(uint32_t v, const Vec3 &p) const;
  static void collect(const TriangleBvh &tree, double distance, Around &around);
  TriangleBvh::Hit nearest(uint32_t v, const Vec3 &p);
  Vec3 move_of(uint32_t v);
  Vec3 slide(uint32_t v, const Vec3 &p);
  bool is_on_rim(uint32_t v, const Vec3 &p);
  bool may_move(uint32_t v) const;
  double try_move(uint32_t v, const Vec3 &move);

  const Sheet &sheet_;
  std::vector<Tri> rim_edges_;
  TriangleBvh rim_tree_;
  const TriangleBvh &tree_;   // of the sheet
  std::vector<Vec3> normal_;  // of the sheet, per node
  Mesh mesh_;
  std::vector<Hold> hold_;
  std::vector<std::array<uint32_t, 2>> rim_;  // per node: the next ones along the rim, or none
  std::vector<uint32_t> nearest_;             // per node: the last triangle of the sheet found
  std::vector<Around> around_, around_rim_;   // per node: of the sheet, and of its rim
  std::vector<OnRim> on_rim_;                 // per node: whether it lies on a rim of the sheet
  // Per node: the number of the move that brought it here, and of the moves before it failed to
  // move.
  std::vector<uint64_t> moved_, failed_;
  uint64_t moves_ = 0;
  std::vector<uint32_t> first_;  // per node: opposite_[first_[v] .. first_[v + 1])
  std::vector<Edge> opposite_;
};

Shrinking::Shrinking(const Sheet &sheet, const TriangleBvh &tree, Mesh mesh, size_t on_samples)
    : sheet_(sheet),
      rim_edges_(as_triangles(sheet.rim)),
      rim_tree_(rim_edges_, sheet.mesh.x),
      tree_(tree),
      normal_(mvs::core::surface_of(sheet.mesh.triangles, sheet.mesh.x).node_normal),
      mesh_(std::move(mesh)) {
  nearest_.assign(mesh_.x.size(), none);
  around_.resize(mesh_.x.size());
  around_rim_.resize(mesh_.x.size());
  on_rim_.assign(mesh_.x.size(), OnRim::unknown);
  moved_.assign(mesh_.x.size(), 1);
  failed_.assign(mesh_.x.size(), 0);
  moves_ = 1;
  hold_rim(on_samples);
  list_triangles();
}

// Rim nodes slide where the rim runs along the sheet; they stay where it crosses from one sheet to
// the other at the end of an opening, which would otherwise shrink to nothing.
void Shrinking::hold_rim(size_t on_samples) {
  hold_.assign(mesh_.x.size(), Hold::free);
  std::fill(hold_.begin(), hold_.begin() + static_cast<std::ptrdiff_t>(on_samples), Hold::slides);
  rim_.assign(mesh_.x.size(), {none, none});
  const std::vector<Side> sides = sorted_sides(mesh_.triangles);
  for_each_edge(sides, [&](size_t first, size_t last) {
    if (last == first + 2) return;
    const Edge &e = sides[first].edge;
    const Vec3 middle = 0.5 * (mesh_.x[e[0]] + mesh_.x[e[1]]);
    const double off = off_of_length * (mesh_.x[e[0]] - mesh_.x[e[1]]).norm();
    const bool along = last == first + 1 && tree_.is_within(middle, off);
    for (int k = 0; k < 2; ++k) {
      Hold &hold = hold_[e[k]];
      hold = along && hold != Hold::stays ? Hold::slides : Hold::stays;
      std::array<uint32_t, 2> &next = rim_[e[k]];
      if (next[1] != none) hold = Hold::stays;  // two openings meet here
      next[next[0] == none ? 0 : 1] = e[1 - k];
    }
  });
}

void Shrinking::list_triangles() {
  first_.assign(mesh_.x.size() + 1, 0);
  for (const Tri &t : mesh_.triangles) {
    for (const uint32_t v : t) ++first_[v + 1];
  }
  for (size_t v = 0; v < mesh_.x.size(); ++v) first_[v + 1] += first_[v];
  opposite_.resize(3 * mesh_.triangles.size());
  std::vector<uint32_t> place(first_.begin(), first_.end() - 1);
  for (const Tri &t : mesh_.triangles) {
    for (int k = 0; k < 3; ++k) opposite_[place[t[k]]++] = {t[(k + 1) % 3], t[(k + 2) % 3]};
  }
}

double Shrinking::area_around(uint32_t v, const Vec3 &p) const {
  double twice = 0;
  for (uint32_t i = first_[v]; i < first_[v + 1]; ++i) {
    const Vec3 &a = mesh_.x[opposite_[i][0]], &b = mesh_.x[opposite_[i][1]];
    twice += (a - p).cross(b - p).norm();
  }
  return 0.5 * twice;
}

// Lists the triangles of a tree whose boxes are within a distance of the centre.
void Shrinking::collect(const TriangleBvh &tree, double distance, Around &around) {
  const double limit = (1 + 1e-9) * distance, limit2 = limit * limit;
  around.triangles.clear();
  tree.visit_near(around.centre, limit2, [&](uint32_t t) {
    if (tree.box_of(t).distance2(around.centre) <= limit2) around.triangles.push_back(t);
  });
}

// The point of the sheet nearest to a place of a node. It has moved little since the last time, so
// that the triangles around serve many times.
TriangleBvh::Hit Shrinking::nearest(uint32_t v, const Vec3 &p) {
  Around &around = around_[v];
  const double radius = around_of_grain * sheet_.grain;
  if (nearest_[v] == none) nearest_[v] = tree_.closest(p).triangle;
  if (!((p - around.centre).squaredNorm() <= radius * radius)) {
    // at a distance d from the centre, the sheet is within d + radius of points around it, whose
    // closest triangles are within d + 2 radius of the centre
    const double d = std::sqrt(tree_.closest_on(nearest_[v], p).distance2);
    around.centre = p;
    collect(tree_, d + 2 * radius, around);
  }
  ClosestSoFar best(tree_, p);
  best.look_at(nearest_[v]);
  for (const uint32_t t : around.triangles) best.look_at(t);
  const TriangleBvh::Hit hit = best.hit();
  nearest_[v] = hit.triangle;
  return hit;
}

// Returns the move that minimises a quadratic upper bound of the area around a node. The area of
// each triangle is its opposite edge times the distance h from it, and h <= h2 / (2 h0) + h0 / 2
// for the present h0: the minimum of the sum of these bounds has no larger area than the present
// position.
Vec3 Shrinking::move_of(uint32_t v) {
  const Vec3 &x = mesh_.x[v];
  Mat3 stiffness = Mat3::Zero();
  Vec3 force = Vec3::Zero();
  for (uint32_t i = first_[v]; i < first_[v + 1]; ++i) {
    const Vec3 &a = mesh_.x[opposite_[i][0]], along = mesh_.x[opposite_[i][1]] - a;
    const double length = along.norm();
    if (length == 0) continue;
    const Vec3 unit = along / length;
    const Vec3 away = x - a - unit.dot(x - a) * unit;
    const double weight = length / std::max(away.norm(), 1e-3 * length);
    stiffness += weight * (Mat3::Identity() - unit * unit.transpose());
    force -= weight * away;
  }
  if (hold_[v] == Hold::free) {
    stiffness += 1e-6 * stiffness.trace() * Mat3::Identity();
    return solve_positive(stiffness, force);
  }
  const TriangleBvh::Hit hit = nearest(v, x);
  const TrianglePoint where = tree_.closest_on(hit.triangle, x);
  Vec3 normal = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    normal += where.weight[k] * normal_[sheet_.mesh.triangles[hit.triangle][k]];
  }
  // perpendicular to the rim, in the sheet: motion along the rim would only crowd its nodes
  const bool on_rim = rim_[v][1] != none;
  const Vec3 tangent =
      on_rim ? Vec3(mesh_.x[rim_[v][1]] - mesh_.x[rim_[v][0]]) : force.cross(normal);
  const Vec3 across = normal.cross(tangent);
  const double resistance = across.dot(stiffness * across);
  return resistance > 0 ? Vec3(across.dot(force) / resistance * across) : Vec3(Vec3::Zero());
}

// Returns the nearest point of the sheet. A node on the rim of the sheet may move inwards, but not
// along the rim, which would round off corners or shorten a slit from its end.
Vec3 Shrinking::slide(uint32_t v, const Vec3 &p) {
  const Vec3 &x = mesh_.x[v];
  const Vec3 there = nearest(v, p).point;
  if (on_rim_[v] == OnRim::unknown) on_rim_[v] = is_on_rim(v, x) ? OnRim::yes : OnRim::no;
  return on_rim_[v] == OnRim::yes && is_on_rim(v, there) ? x : there;
}

bool Shrinking::is_on_rim(uint32_t v, const Vec3 &p) {
  Around &around = around_rim_[v];
  const double radius = around_of_grain * sheet_.grain, on = 1e-3 * sheet_.grain;
  if (!((p - around.centre).squaredNorm() <= radius * radius)) {
    around.centre = p;
    collect(rim_tree_, radius + on, around);
  }
  return std::any_of(around.triangles.begin(), around.triangles.end(),
                     [&](uint32_t t) { return rim_tree_.closest_on(t, p).distance2 < on * on; });
}

// Applies the move, or a part of it, if that lowers the area; returns the decrease.
double Shrinking::try_move(uint32_t v, const Vec3 &move) {
  const double before = area_around(v, mesh_.x[v]);
  // a free node overshoots first (successive over-relaxation); one that slides could skip a fold
  for (const double part : {overshoot, 1.0, 0.5, 0.25, 0.125}) {
    if (part > 1 && hold_[v] != Hold::free) continue;
    Vec3 p = mesh_.x[v] + part * move;
    if (hold_[v] == Hold::slides) p = slide(v, p);
    const double after = area_around(v, p);
    if (after >= before) continue;
    mesh_.x[v] = p;
    on_rim_[v] = OnRim::unknown;
    moved_[v] = ++moves_;
    return before - after;
  }
  failed_[v] = moves_;
  return 0;
}

// A node that could not move cannot do so until a neighbour has moved: nothing else has changed.
bool Shrinking::may_move(uint32_t v) const {
  if (failed_[v] < moved_[v]) return true;
  for (uint32_t i = first_[v]; i < first_[v + 1]; ++i) {
    for (const uint32_t other : opposite_[i]) {
      if (moved_[other] > failed_[v]) return true;
    }
  }
  return false;
}

double Shrinking::sweep() {
  double gain = 0;
  for (uint32_t v = 0; v < mesh_.x.size(); ++v) {
    if (hold_[v] != Hold::stays && may_move(v)) gain += try_move(v, move_of(v));
  }
  return gain;
}

Mesh Shrinking::run() {
  for (int k = 0; k < max_sweeps; ++k) {
    if (sweep() < enough * area_of(mesh_)) break;
  }
  return std::move(mesh_);
}

}  // namespace

Mesh smallest_surface(const Sheet &sheet, const TriangleBvh &tree, const Samples &samples,
                      const std::vector<Tri> &cut) {
  Mesh mesh = compact_mesh(samples.point, cut);
  if (cut.empty()) return mesh;
  const size_t on_samples = mesh.x.size();
  const double longest = std::max(sheet.grain, edge_of_size * std::sqrt(area_of(mesh)));
  bisect(mesh, [&](const BisectEdge &edge) {
    return !edge.on_rim && (edge.b - edge.a).norm() > longest;
  });
  return Shrinking(sheet, tree, std::move(mesh), on_samples).run();
}

}  // namespace mvs::core::orifice
