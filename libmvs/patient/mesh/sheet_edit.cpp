// The conditions of a change, and moves of vertices.
#include "patient/mesh/sheet_edit.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "patient/coordinates.h"

namespace mvs::core {
namespace {

// A triangle faces as the input does if their normals differ by less than 60 degrees; where the
// input is curved more sharply than triangles resolve, by no more than before.
constexpr double least_facing = 0.5;
// Edges join places where the normals of the input differ by less than 127 degrees, or by no more
// than before: in a narrow fold, vertices stay on its ridge, and no edge cuts from wall to wall.
constexpr double least_bend = -0.6;
// Splits may lower both cosines: they are few, and without them long edges remain at creases.
constexpr double split_slack = 0.25;
// A triangle turns by less than 60 degrees at once.
constexpr double least_turn = 0.5;
// cos 5 degrees: the normal of a thinner triangle is not used as a reference.
constexpr double needle_cosine = 0.9962;

// cos 35 degrees: moves for even spacing may lower angles to it.
constexpr double fine_cosine = 0.8192;
// The gain in cosine of a move for the least angle: 0.01 degrees.
constexpr double least_gain = 1e-4;

}  // namespace

double worst_cosine(const Vec3 &a, const Vec3 &b, const Vec3 &c) {
  const Vec3 ab = b - a, bc = c - b, ca = a - c;
  const double l2 = ab.squaredNorm(), m2 = bc.squaredNorm(), n2 = ca.squaredNorm();
  // the least angle is opposite the shortest side
  double dot = -ab.dot(bc), product = l2 * m2;
  if (l2 <= m2 && l2 <= n2) {
    dot = -ca.dot(bc);
    product = n2 * m2;
  } else if (m2 <= l2 && m2 <= n2) {
    dot = -ab.dot(ca);
    product = l2 * n2;
  }
  return product > 0 ? dot / std::sqrt(product) : 1;
}

SheetEditor::SheetEditor(const InputSheet &input, SheetMesh &mesh, double edge)
    : input_(input), mesh_(mesh), grid_(mesh.x, mesh.triangles, 1.5 * edge), edge_(edge) {}

SheetEditor::Look SheetEditor::look_at(const std::vector<Tri> &triangles) const {
  Look look;
  look.normal.reserve(triangles.size());
  for (const Tri &t : triangles) {
    look.normal.push_back(Vec3::Zero());
    if (t[0] == none) continue;
    const Vec3 &a = mesh_.x[t[0]], &b = mesh_.x[t[1]], &c = mesh_.x[t[2]];
    const Vec3 area = (b - a).cross(c - a);
    const double norm = area.norm(), cosine = worst_cosine(a, b, c);
    look.worst = std::max(look.worst, cosine);
    look.area += area;
    if (norm == 0) {
      look.worst = 1;
      continue;
    }
    const bool needle = cosine >= needle_cosine;
    if (!needle) look.normal.back() = area / norm;
    const Vec3 &na = mesh_.vertex[t[0]].normal, &nb = mesh_.vertex[t[1]].normal;
    const Vec3 &nc = mesh_.vertex[t[2]].normal;
    const double bend = std::min({na.dot(nb), nb.dot(nc), nc.dot(na)});
    const Vec3 input = na + nb + nc;
    const double length = input.norm();
    const double facing = length > 0 ? area.dot(input) / (norm * length) : 1;
    look.bend = std::min(look.bend, bend);
    look.facing = std::min(look.facing, facing);
    if (needle) continue;
    look.sure_bend = std::min(look.sure_bend, bend);
    look.sure_facing = std::min(look.sure_facing, facing);
  }
  return look;
}

bool SheetEditor::keeps_sides(const Look &before, const Look &after, Change change) const {
  if (change == Change::halve) return true;
  const double slack = change == Change::split ? split_slack : 0;
  if (after.sure_facing < std::min(least_facing, before.facing) - slack) return false;
  if (after.sure_bend < std::min(least_bend, before.bend) - slack) return false;
  const double area = before.area.norm();
  for (size_t k = 0; k < after.normal.size(); ++k) {
    const Vec3 &n = after.normal[k];
    // triangles of a star replace themselves, the halves of a split their whole, a flip's both
    Vec3 reference = before.area;
    double length = area;
    if (change != Change::flip) {
      reference = before.normal[change == Change::split ? k - k % 2 : k];
      length = 1;
    }
    if (n.squaredNorm() > 0 && reference.squaredNorm() > 0 &&
        n.dot(reference) < least_turn * length) {
      return false;
    }
  }
  return true;
}

bool SheetEditor::crosses(const SheetPatch &patch) const {
  const std::vector<Vec3> &x = mesh_.x;
  std::vector<Aabb> box(patch.after.size());
  Aabb whole;
  for (size_t k = 0; k < box.size(); ++k) {
    if (patch.after[k][0] == none) continue;
    box[k] = aabb_of(x, patch.after[k]);
    whole.add(box[k]);
  }
  for (size_t k = 0; k < box.size(); ++k) {
    for (size_t l = 0; l < k; ++l) {
      // removed ones have empty boxes
      if (box[k].overlaps(box[l]) && mesh_triangles_cross(x, patch.after[k], patch.after[l])) {
        return true;
      }
    }
  }
  return grid_.any_near(whole, [&](uint32_t other, const Aabb &other_box) {
    if (std::find(patch.id.begin(), patch.id.end(), other) != patch.id.end()) return false;
    for (size_t k = 0; k < box.size(); ++k) {
      if (box[k].overlaps(other_box) &&
          mesh_triangles_cross(x, patch.after[k], mesh_.triangles[other])) {
        return true;
      }
    }
    return false;
  });
}

void SheetEditor::commit(const SheetPatch &patch) {
  for (size_t k = 0; k < patch.id.size(); ++k) {
    const uint32_t id = patch.id[k];
    if (patch.before[k] == patch.after[k]) {  // a vertex moved
      grid_.remove(id);
      grid_.insert(id, aabb_of(mesh_.x, patch.after[k]));
      continue;
    }
    if (patch.before[k][0] != none) {
      grid_.remove(id);
      for (const uint32_t v : patch.before[k]) std::erase(mesh_.star[v], id);
    }
    if (id >= mesh_.triangles.size()) mesh_.triangles.resize(id + 1);
    mesh_.triangles[id] = patch.after[k];
    if (patch.after[k][0] == none) continue;
    grid_.insert(id, aabb_of(mesh_.x, patch.after[k]));
    for (const uint32_t v : patch.after[k]) mesh_.star[v].push_back(id);
  }
}

SheetPatch SheetEditor::star_of(uint32_t v) const {
  SheetPatch patch;
  patch.id = mesh_.star[v];
  for (const uint32_t t : patch.id) patch.before.push_back(mesh_.triangles[t]);
  patch.after = patch.before;
  return patch;
}

double SheetEditor::worst_around(uint32_t v) const {
  double worst = -1;
  for (const uint32_t t : mesh_.star[v]) {
    const auto &[a, b, c] = mesh_.triangles[t];
    worst = std::max(worst, worst_cosine(mesh_.x[a], mesh_.x[b], mesh_.x[c]));
  }
  return worst;
}

// The changed positions are in the mesh already; `before` is the look without them.
bool SheetEditor::replace(const SheetPatch &patch, double limit, Change change,
                          const Look &before) {
  const Look after = look_at(patch.after);
  if (after.worst > limit) return false;
  if (!keeps_sides(before, after, change) || crosses(patch)) return false;
  commit(patch);
  return true;
}

bool SheetEditor::move_to(uint32_t v, const Vec3 &x, const MeshVertex &to, EditFor reason) {
  const SheetPatch patch = star_of(v);
  const Look before = look_at(patch.before);
  const Vec3 old_x = mesh_.x[v];
  const MeshVertex old = mesh_.vertex[v];
  mesh_.x[v] = x;
  mesh_.vertex[v] = to;
  const double limit =
      reason == EditFor::angle ? before.worst - least_gain : std::max(before.worst, fine_cosine);
  if (replace(patch, limit, Change::star, before)) return true;
  mesh_.x[v] = old_x;
  mesh_.vertex[v] = old;
  return false;
}

bool SheetEditor::move_inside(uint32_t v, const Vec3 &target, EditFor reason) {
  MeshVertex to = mesh_.vertex[v];
  to.place = input_.walk.closest_from(to.place, target);
  to.normal = input_.walk.normal_at(to.place);
  return move_to(v, input_.walk.at(to.place), to, reason);
}

bool SheetEditor::move_along(uint32_t v, double arc, EditFor reason) {
  MeshVertex to = mesh_.vertex[v];
  const RimCurve &curve = input_.curve(to.rim);
  to.arc = wrapped(arc, curve.length());
  to.place = curve.place_at(to.arc);
  to.normal = input_.walk.normal_at(to.place);
  return move_to(v, curve.at(to.arc), to, reason);
}

}  // namespace mvs::core
