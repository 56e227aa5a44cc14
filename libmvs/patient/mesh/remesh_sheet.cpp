// Rounds of edits, then improvement of the worst triangles.
#include "patient/mesh/remesh_sheet.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "base/error.h"
#include "model/sides.h"
#include "patient/coordinates.h"
#include "patient/mesh/remesh_report.h"
#include "patient/mesh/sheet_edit.h"

namespace mvs::core {
namespace {

// Relative edge lengths: below `collapse_below` a collapse, above `split_above` a split brings an
// edge nearer to the wanted one.
constexpr double collapse_below = 4.0 / 5, split_above = 4.0 / 3;
// The mean of edges within these limits is below the wanted length by up to this factor, and the
// limits are raised by it.
constexpr double most_scale = 1.15;
constexpr double most_triangles = 1e6;  // 400 times those of a valve that is simulated
constexpr int most_passes = 12;         // of splits, collapses or flips in one round: safety limit
constexpr int last_rounds = 8;          // of flips and moves alone
constexpr int improvements = 6;         // of the worst triangles
constexpr double poor_cosine = 0.8572;  // cos 31 degrees: triangles below are improved
// Corners of rims that a vertex goes to: those that stand out by this height over a straight line
// to this distance on both sides, in wanted edges. A turn by 40 degrees does.
constexpr double corner_reach = 0.5, corner_height = 0.17;
// Edge, in wanted ones, that collapses for the angles, and of tiny edges, may make.
constexpr double longest_made = 1.6;
// Edges below this share of the wanted one are collapsed at last, even if that makes long ones.
constexpr double tiny = 0.25;
constexpr double least_way = 2e-3;  // of an edge: shorter moves are left out

// Along a rim the arc counts, so that no notch is skipped.
double length_of(const InputSheet &input, const SheetMesh &mesh, const Edge &e) {
  const auto [a, b] = e;
  const MeshVertex &v = mesh.vertex[a];
  const double straight = mesh.length(a, b);
  if (v.rim == Rim::inside || (v.before != b && v.after != b)) return straight;
  const double loop = input.curve(v.rim).length();
  return std::max(straight, std::abs(around(v.arc, mesh.vertex[b].arc, loop)));
}

double mean_length(const SheetMesh &mesh) {
  const std::vector<Edge> edges = mesh.edges();
  double sum = 0;
  for (const auto &[a, b] : edges) sum += mesh.length(a, b);
  return sum / static_cast<double>(edges.size());
}

struct SizedEdge {
  double length;
  Edge edge;
};

// Edges with accept(length), the longest or the shortest first, equal ones as they come.
template <typename Accept>
std::vector<SizedEdge> edges_by_length(const InputSheet &input, const SheetMesh &mesh,
                                       Accept accept, bool longest_first) {
  std::vector<SizedEdge> found;
  for (const Edge &e : mesh.edges()) {
    const double length = length_of(input, mesh, e);
    if (accept(length)) found.push_back({length, e});
  }
  std::stable_sort(found.begin(), found.end(), [&](const SizedEdge &p, const SizedEdge &q) {
    return longest_first ? p.length > q.length : p.length < q.length;
  });
  return found;
}

bool split_long(const InputSheet &input, SheetMesh &mesh, SheetEditor &editor, double edge) {
  bool any = false;
  const auto is_long = [&](double l) { return l > split_above * edge; };
  for (const SizedEdge &c : edges_by_length(input, mesh, is_long, true)) {
    any = editor.split(c.edge) || any;
  }
  return any;
}

// Collapses edges below a length, unless that makes edges longer than `longest`.
bool collapse_short(const InputSheet &input, SheetMesh &mesh, SheetEditor &editor, double below,
                    double longest) {
  bool any = false;
  const auto is_short = [&](double l) { return l < below; };
  for (const SizedEdge &c : edges_by_length(input, mesh, is_short, false)) {
    const auto [a, b] = c.edge;
    if (!mesh.are_joined(a, b) || length_of(input, mesh, c.edge) >= below) continue;
    any = editor.collapse(a, b, longest, EditFor::spacing) ||
          editor.collapse(b, a, longest, EditFor::spacing) || any;
  }
  return any;
}

bool flip_all(SheetMesh &mesh, SheetEditor &editor, EditFor reason) {
  bool any = false;
  for (const Edge &e : mesh.edges()) any = editor.flip(e, reason) || any;
  return any;
}

// The centroid of the star, area-weighted so that large triangles attract the vertex, in the plane
// through the vertex normal to the input.
Vec3 centre_of_star(const SheetMesh &mesh, uint32_t v) {
  Vec3 sum = Vec3::Zero();
  double weight = 0;
  for (const uint32_t t : mesh.star[v]) {
    const auto &[a, b, c] = mesh.triangles[t];
    const Vec3 &p = mesh.x[a], &q = mesh.x[b], &r = mesh.x[c];
    const double area = (q - p).cross(r - p).norm();
    sum += area / 3 * (p + q + r);
    weight += area;
  }
  if (weight == 0) return mesh.x[v];
  const Vec3 way = sum / weight - mesh.x[v];
  const Vec3 &n = mesh.vertex[v].normal;
  return mesh.x[v] + way - way.dot(n) * n;
}

// The arc lengths at which vertices on rims should be: the corners of the input's rim for the
// vertices nearest to them, the middles between their neighbours for others.
std::vector<double> wanted_arcs(const InputSheet &input, const SheetMesh &mesh, double edge) {
  std::vector<double> wanted(mesh.x.size(), 0);
  for (size_t v = 0; v < mesh.x.size(); ++v) {
    const MeshVertex &at = mesh.vertex[v];
    if (at.rim == Rim::inside || mesh.star[v].empty()) continue;
    const double loop = input.curve(at.rim).length();
    wanted[v] = at.arc + 0.5 * (around(at.arc, mesh.vertex[at.before].arc, loop) +
                                around(at.arc, mesh.vertex[at.after].arc, loop));
  }
  for (const Rim rim : {Rim::annulus, Rim::free_edge}) {
    const RimCurve &curve = input.curve(rim);
    for (const double corner : curve.corners(corner_reach * edge, corner_height * edge)) {
      uint32_t nearest = none;
      double least = curve.length();
      for (uint32_t v = 0; v < mesh.x.size(); ++v) {
        if (mesh.vertex[v].rim != rim || mesh.star[v].empty()) continue;
        const double off = std::abs(around(mesh.vertex[v].arc, corner, curve.length()));
        if (off >= least) continue;
        least = off;
        nearest = v;
      }
      wanted[nearest] = corner;
    }
  }
  return wanted;
}

void relax_vertices(const InputSheet &input, SheetMesh &mesh, SheetEditor &editor, double edge) {
  const auto halving = [](auto move) {  // the whole way, else a half or a quarter
    for (const double share : {1.0, 0.5, 0.25}) {
      if (move(share)) return;
    }
  };
  const std::vector<double> wanted = wanted_arcs(input, mesh, edge);
  for (uint32_t v = 0; v < mesh.x.size(); ++v) {
    if (mesh.star[v].empty()) continue;
    const MeshVertex &at = mesh.vertex[v];
    if (at.rim == Rim::inside) {
      const Vec3 from = mesh.x[v], way = centre_of_star(mesh, v) - from;
      if (way.norm() < least_way * edge) continue;
      halving([&](double share) {
        return editor.move_inside(v, from + share * way, EditFor::spacing);
      });
    } else {
      const double arc = at.arc;
      const double way = around(arc, wanted[v], input.curve(at.rim).length());
      if (std::abs(way) < least_way * edge) continue;
      halving(
          [&](double share) { return editor.move_along(v, arc + share * way, EditFor::spacing); });
    }
  }
}

// Moves a vertex towards and away from its neighbours, or along its rim, while the least angle
// around it grows: pattern search with steps in wanted edges.
void search_place(SheetMesh &mesh, SheetEditor &editor, double edge, uint32_t v) {
  const auto gains = [&](double length) {
    if (mesh.vertex[v].rim != Rim::inside) {
      const double arc = mesh.vertex[v].arc;
      return editor.move_along(v, arc + length, EditFor::angle) ||
             editor.move_along(v, arc - length, EditFor::angle);
    }
    for (const uint32_t t : mesh.star[v]) {
      for (const uint32_t w : mesh.triangles[t]) {
        const Vec3 from = mesh.x[v], way = mesh.x[w] - from;
        const double norm = way.norm();
        if (norm == 0) continue;
        for (const double sign : {-1.0, 1.0}) {
          const Vec3 to = from + sign * length / norm * way;
          if (editor.move_inside(v, to, EditFor::angle)) return true;
        }
      }
    }
    return false;
  };
  constexpr double first_step = 0.2, last_step = 0.02;
  constexpr int most_moves = 20;
  double step = first_step;
  for (int k = 0; k < most_moves && step >= last_step; ++k) {
    if (editor.worst_around(v) < poor_cosine) return;
    if (!gains(step * edge)) step *= 0.5;
  }
}

// One pass over the poor triangles: a flip or a collapse that raises the least angle around, or a
// corner of a rim cut off, else a better place of each corner. Returns whether there was a poor
// triangle.
bool improve_poor(SheetMesh &mesh, SheetEditor &editor, double edge) {
  bool any = false;
  const size_t count = mesh.triangles.size();
  for (uint32_t t = 0; t < count; ++t) {
    const Tri tri = mesh.triangles[t];
    if (tri[0] == none) continue;
    if (worst_cosine(mesh.x[tri[0]], mesh.x[tri[1]], mesh.x[tri[2]]) <= poor_cosine) continue;
    any = true;
    bool changed = false;
    for (size_t k = 0; k < 3 && !changed; ++k) {
      changed = editor.flip({tri[k], tri[(k + 1) % 3]}, EditFor::angle);
    }
    for (size_t k = 0; k < 3 && !changed; ++k) {
      const uint32_t a = tri[k], b = tri[(k + 1) % 3];
      if (mesh.length(a, b) > collapse_below * edge) continue;
      changed = editor.collapse(a, b, longest_made * edge, EditFor::angle) ||
                editor.collapse(b, a, longest_made * edge, EditFor::angle);
    }
    for (size_t k = 0; k < 3 && !changed; ++k) {
      changed = editor.cut_corner(tri[k], longest_made * edge);
    }
    for (size_t k = 0; k < 3 && !changed; ++k) search_place(mesh, editor, edge, tri[k]);
  }
  return any;
}

}  // namespace

RemeshedSheet remesh_sheet(const LeafletSheet &sheet, const SheetRims &rims,
                           const RemeshGoal &goal) {
  MVS_MUST(goal.edge > 0, MVS_E_OP, "edge", "the wanted edge is %g m: it must be positive",
           goal.edge);
  MVS_MUST(sheet.label.size() == sheet.triangles.size() &&
               (sheet.thickness.empty() || sheet.thickness.size() == sheet.x.size()),
           MVS_E_OP, "surface",
           "%zu labels for %zu triangles, %zu thicknesses for %zu vertices: give one each",
           sheet.label.size(), sheet.triangles.size(), sheet.thickness.size(), sheet.x.size());
  const double area = surface_area(sheet.x, sheet.triangles);
  const double count = area / (0.433 * goal.edge * goal.edge);  // of equilateral triangles
  MVS_MUST(
      count < most_triangles, MVS_E_OP, "edge",
      "a wanted edge of %g mm makes about %.0f triangles of %g mm2 of tissue, at most %.0f are "
      "made: is the surface in m?",
      goal.edge * 1e3, count, area * 1e6, most_triangles);
  const InputSheet input(sheet, rims, goal.edge);
  SheetMesh mesh = mesh_of(input, rims);
  SheetEditor editor(input, mesh, goal.edge);
  const auto repeat = [](auto pass) {
    for (int k = 0; k < most_passes && pass(); ++k) {
    }
  };
  double edge = goal.edge;  // at which edges are split and collapsed
  for (int round = 0; round < goal.rounds; ++round) {
    repeat([&] { return split_long(input, mesh, editor, edge); });
    repeat([&] {
      return collapse_short(input, mesh, editor, collapse_below * edge, split_above * edge);
    });
    repeat([&] { return flip_all(mesh, editor, EditFor::spacing); });
    relax_vertices(input, mesh, editor, goal.edge);
    edge = std::clamp(edge * goal.edge / mean_length(mesh), goal.edge, most_scale * goal.edge);
  }
  for (int round = 0; round < last_rounds; ++round) {
    repeat([&] { return flip_all(mesh, editor, EditFor::angle); });
    relax_vertices(input, mesh, editor, goal.edge);
  }
  for (int k = 0; k < improvements; ++k) {
    const bool was_tiny =
        collapse_short(input, mesh, editor, tiny * goal.edge, longest_made * goal.edge);
    if (!improve_poor(mesh, editor, goal.edge) && !was_tiny) break;
  }
  SheetAndRims made = sheet_of(input, mesh);
  RemeshedSheet result{std::move(made.sheet), std::move(made.rims), {}};
  result.report = report_on(input, mesh, result.sheet);
  return result;
}

}  // namespace mvs::core
