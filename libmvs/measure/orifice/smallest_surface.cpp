// Surface of least area with a rim that slides on the sheet: node by node majorise-minimise sweeps,
// in which the area never increases, first with the triangles of the cut, then with finer ones.
#include "measure/orifice/smallest_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "linalg/small_solve.h"
#include "measure/orifice/rail.h"
#include "model/sides.h"

namespace mvs::core::orifice {
namespace {

// Target edge length over the root of the area, at which a chord of a circle is 1 % below its arc;
// not below the spacing of the samples.
constexpr double edge_of_size = 0.15;
constexpr int max_sweeps = 100;
// Relative decrease of area in the last sweep, of the cut as it is and of the refined one. Without
// nodes inside, the rim comes near its place in a few cheap sweeps.
constexpr double enough_coarse = 1e-4, enough = 1e-5;
constexpr double overshoot = 1.7;  // of the move of a free node: 1.5 to 1.8 need the fewest sweeps
// Long parts of the rim move together, slowly: they take most of the sweeps. After so many sweeps
// the motion of the last two is continued, at first so many times as far; no sliding node by more
// than this many spacings of samples, since it could skip a fold.
constexpr int sweeps_between = 6, sweeps_of_motion = 2;
constexpr double continued_by = 4, most_continued = 1e3, longest_slide = 0.5;
// A segment between two points of the sheet whose midpoint is farther from the sheet than this
// share of its length does not run along the sheet. The value is 0.13 over a crease of 60 degrees,
// 0.5 across a passage.
constexpr double off_of_length = 0.15;
// Distance from the sheet over its grain beyond which a node is not on the sheet. The distance of
// nodes on it is a rounding error.
constexpr double off_sheet = 1e-3;

bool runs_along(const Rail &sheet, const Vec3 &a, const Vec3 &b) {
  return sheet.tree.is_within(0.5 * (a + b), off_of_length * (b - a).norm());
}

// How a node may move: anywhere, along the rim, or not at all.
enum class Motion : uint8_t { free, along_rim, none };
enum class OnRim : uint8_t { unknown, no, yes };

class Shrinking {
 public:
  Shrinking(const Rail &sheet, Mesh mesh, size_t on_samples);
  // Ends when a sweep lowers the area by less than this share.
  Mesh run(double least_decrease);

 private:
  void restrict_rim(size_t on_samples);
  void list_triangles();
  double sweep();
  double area_around(uint32_t v, const Vec3 &p) const;
  Vec3 move_of(uint32_t v);
  Vec3 slide(uint32_t v, const Vec3 &p);
  bool may_move(uint32_t v) const;
  double try_move(uint32_t v, const Vec3 &move);
  void continue_motion(const std::vector<Vec3> &from);

  const Rail &sheet_;
  RailSearch search_;
  Mesh mesh_;
  std::vector<Motion> motion_;
  std::vector<std::array<uint32_t, 2>> rim_;  // per node: the next ones along the rim, or none
  std::vector<OnRim> on_rim_;                 // per node: whether it lies on a rim of the sheet
  // Per node: the number of the move that brought it here, and of the moves before it failed to
  // move.
  std::vector<uint64_t> moved_, failed_;
  uint64_t moves_ = 0;
  std::vector<uint32_t> first_;  // per node: opposite_[first_[v] .. first_[v + 1])
  std::vector<Edge> opposite_;
};

Shrinking::Shrinking(const Rail &sheet, Mesh mesh, size_t on_samples)
    : sheet_(sheet), search_(sheet, mesh.x.size()), mesh_(std::move(mesh)) {
  on_rim_.assign(mesh_.x.size(), OnRim::unknown);
  moved_.assign(mesh_.x.size(), 1);
  failed_.assign(mesh_.x.size(), 0);
  moves_ = 1;
  restrict_rim(on_samples);
  list_triangles();
}

// Rim nodes slide where the rim runs along the sheet; they stay where it crosses from one sheet to
// the other at the end of an opening, which would otherwise shrink to nothing.
void Shrinking::restrict_rim(size_t on_samples) {
  motion_.assign(mesh_.x.size(), Motion::free);
  std::fill(motion_.begin(), motion_.begin() + static_cast<std::ptrdiff_t>(on_samples),
            Motion::along_rim);
  rim_.assign(mesh_.x.size(), {none, none});
  const std::vector<Side> sides = sorted_sides(mesh_.triangles);
  for_each_edge(sides, [&](size_t first, size_t last) {
    if (last == first + 2) return;
    const Edge &e = sides[first].edge;
    const bool along = last == first + 1 && runs_along(sheet_, mesh_.x[e[0]], mesh_.x[e[1]]);
    for (int k = 0; k < 2; ++k) {
      Motion &motion = motion_[e[k]];
      motion = along && motion != Motion::none ? Motion::along_rim : Motion::none;
      std::array<uint32_t, 2> &next = rim_[e[k]];
      if (next[1] != none) motion = Motion::none;  // two openings meet here
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
  if (motion_[v] == Motion::free) {
    stiffness += 1e-6 * stiffness.trace() * Mat3::Identity();
    return solve_positive(stiffness, force);
  }
  const Vec3 normal = sheet_.normal_at(search_.nearest(v, x).triangle, x);
  // perpendicular to the rim, in the sheet: motion along the rim would only crowd its nodes
  const bool on_rim = rim_[v][1] != none;
  const Vec3 tangent =
      on_rim ? Vec3(mesh_.x[rim_[v][1]] - mesh_.x[rim_[v][0]]) : force.cross(normal);
  const Vec3 across = normal.cross(tangent);
  const double resistance = across.dot(stiffness * across);
  return resistance > 0 ? Vec3(across.dot(force) / resistance * across) : Vec3(Vec3::Zero());
}

// Returns the nearest point of the sheet. A node on the rim of the sheet may move inwards, but not
// along the rim, which would round off corners or shorten a slit from its end. No node moves to
// other tissue across the opening: the surface would have a gap where it was. One that begins on
// the wall comes to the sheet.
Vec3 Shrinking::slide(uint32_t v, const Vec3 &p) {
  const Vec3 &x = mesh_.x[v];
  const Vec3 there = search_.nearest(v, p).point;
  if (on_rim_[v] == OnRim::unknown) on_rim_[v] = search_.is_on_rim(v, x) ? OnRim::yes : OnRim::no;
  if (on_rim_[v] == OnRim::yes && search_.is_on_rim(v, there)) return x;
  const auto comes = [&] { return !sheet_.tree.is_within(x, off_sheet * sheet_.grain); };
  return runs_along(sheet_, x, there) || comes() ? there : x;
}

// Applies the move, or a part of it, if that lowers the area; returns the decrease.
double Shrinking::try_move(uint32_t v, const Vec3 &move) {
  const double before = area_around(v, mesh_.x[v]);
  // a free node overshoots first (successive over-relaxation); one that slides could skip a fold
  for (const double part : {overshoot, 1.0, 0.5, 0.25, 0.125}) {
    if (part > 1 && motion_[v] != Motion::free) continue;
    Vec3 p = mesh_.x[v] + part * move;
    if (motion_[v] == Motion::along_rim) p = slide(v, p);
    if (p == mesh_.x[v]) continue;
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
    if (motion_[v] != Motion::none && may_move(v)) gain += try_move(v, move_of(v));
  }
  return gain;
}

// Moves all nodes on along their motion since `from`, twice as far each time, as long as the area
// falls.
void Shrinking::continue_motion(const std::vector<Vec3> &from) {
  const std::vector<Vec3> here = mesh_.x;
  double farthest = 0;
  for (uint32_t v = 0; v < here.size(); ++v) {
    if (motion_[v] == Motion::along_rim) farthest = std::max(farthest, (here[v] - from[v]).norm());
  }
  std::vector<Vec3> best = here;
  double least = area_of(mesh_), times = continued_by;
  while (times * farthest < longest_slide * sheet_.grain && times < most_continued) {
    for (uint32_t v = 0; v < here.size(); ++v) {
      const Vec3 motion = here[v] - from[v];
      mesh_.x[v] = here[v];
      if (motion.isZero(0)) continue;
      const Vec3 p = here[v] + times * motion;
      mesh_.x[v] = motion_[v] == Motion::along_rim ? slide(v, p) : p;
    }
    const double area = area_of(mesh_);
    if (area >= least) break;
    least = area;
    best = mesh_.x;
    times *= 2;
  }
  mesh_.x = std::move(best);
  for (uint32_t v = 0; v < here.size(); ++v) {
    if (mesh_.x[v] == here[v]) continue;
    on_rim_[v] = OnRim::unknown;
    moved_[v] = ++moves_;
  }
}

Mesh Shrinking::run(double least_decrease) {
  std::vector<Vec3> from;
  for (int k = 1; k <= max_sweeps; ++k) {
    if (sweep() < least_decrease * area_of(mesh_)) break;
    if (k % sweeps_between == sweeps_between - sweeps_of_motion) from = mesh_.x;
    if (k % sweeps_between == 0) continue_motion(from);
  }
  return std::move(mesh_);
}

}  // namespace

Mesh smallest_surface(const Sheet &sheet, const TriangleBvh &tree, const Samples &samples,
                      const std::vector<Tri> &cut) {
  Mesh mesh = compact_mesh(samples.point, cut);
  if (cut.empty()) return mesh;
  const size_t on_samples = mesh.x.size();
  const Rail rail(sheet, tree);
  mesh = Shrinking(rail, std::move(mesh), on_samples).run(enough_coarse);
  const double longest = std::max(sheet.grain, edge_of_size * std::sqrt(area_of(mesh)));
  bisect(mesh, [&](const BisectEdge &edge) {
    return !edge.on_rim && (edge.b - edge.a).norm() > longest;
  });
  return Shrinking(rail, std::move(mesh), on_samples).run(enough);
}

}  // namespace mvs::core::orifice
