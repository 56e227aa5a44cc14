// Halves each edge of the rim until it suits the tissue opposite to it.
#include "measure/orifice/rim_parts.h"

#include <Eigen/Geometry>

#include "measure/orifice/samples.h"
#include "model/sides.h"

namespace mvs::core::orifice {
namespace {

// Ratio of the coarsest to the finest spacing.
constexpr double coarsest_of_finest = 4;
// Share of the contact thickness below which leaflets are in deep contact.
constexpr double deep_of_seal = 0.8;
// Two lengths of the same number of halvings agree to this share.
constexpr double rounding_of_length = 1e-6;

// Openings with an angle below 150 degrees have corners.
constexpr double corner_cosine = -0.866;
// Spacing at a corner over the finest one, which edges from there on grow from.
constexpr double corner_of_finest = 0.5;

// The rim at one of its nodes: directions along an edge there, and out of the sheet.
struct RimEnd {
  Vec3 along, out;
};

// Whether the opening has a corner where two edges of its rim meet.
bool is_corner(const RimEnd &a, const RimEnd &b) {
  return a.along.dot(b.out) > 0 && a.along.dot(b.along) > corner_cosine;
}

}  // namespace

Spacing::Spacing(const Sheet &sheet)
    : finest(sheet.grain),
      coarsest(coarsest_of_finest * sheet.grain),
      deep(deep_of_seal * sheet.seal),
      seal(sheet.seal) {}

bool Spacing::is_too_long(const Opposite &sheet, const Vec3 &a, const Vec3 &b, const Vec3 &normal,
                          const Vec3 &out) const {
  const double length = (b - a).norm();
  if (!(length > finest)) return false;
  if (length > coarsest) return true;
  const auto has_opposite = [&](const Vec3 &p, double within) {
    return sheet.is_within({p, normal, out}, within);
  };
  const Vec3 middle = 0.5 * (a + b);
  if (!has_opposite(middle, length / growth)) return false;
  return length > 2 * seal || !has_opposite(middle, deep) || !has_opposite(a, deep) ||
         !has_opposite(b, deep);
}

RimParts::RimParts(const Sheet &sheet, const Opposite &tissue, const Spacing &spacing)
    : spacing_(spacing) {
  const std::vector<Vec3> &x = sheet.mesh.x;
  std::vector<std::vector<RimEnd>> ends(x.size());
  for (const Side &side : sheet.rim) {
    const Tri &t = sheet.mesh.triangles[side.triangle];
    const Vec3 &a = x[side.edge[0]], &b = x[side.edge[1]];
    const Vec3 inside = x[t[0]] + x[t[1]] + x[t[2]] - a - b - a;  // to the third corner
    const Vec3 along = (b - a).normalized();
    const Vec3 out = along * along.dot(inside) - inside;
    divide(tissue, a, b, along.cross(inside).normalized(), out.normalized());
    ends[side.edge[0]].push_back({along, out});
    ends[side.edge[1]].push_back({-along, out});
  }
  for (size_t v = 0; v < x.size(); ++v) {
    if (ends[v].size() == 2 && is_corner(ends[v][0], ends[v][1]))
      add(x[v], x[v], corner_of_finest * spacing.finest);
  }
  tree_.emplace(parts_, x_);
}

void RimParts::divide(const Opposite &tissue, const Vec3 &a, const Vec3 &b, const Vec3 &normal,
                      const Vec3 &out) {
  if (spacing_.is_too_long(tissue, a, b, normal, out)) {
    const Vec3 middle = 0.5 * (a + b);
    divide(tissue, a, middle, normal, out);
    divide(tissue, middle, b, normal, out);
    return;
  }
  add(a, b, (b - a).norm());
}

void RimParts::add(const Vec3 &a, const Vec3 &b, double length) {
  const auto k = static_cast<uint32_t>(x_.size());
  x_.push_back(a);
  x_.push_back(b);
  parts_.push_back({k, k + 1, k + 1});
  length_.push_back(length);
}

bool RimParts::is_too_long(const Vec3 &middle, double length) const {
  double room = (length - spacing_.finest) / Spacing::growth;
  double limit2 = room * room;
  bool found = false;
  tree_->visit_near(middle, limit2, [&](uint32_t k) {
    room = (length * (1 - rounding_of_length) - length_[k]) / Spacing::growth;
    if (found || room <= 0 || tree_->closest_on(k, middle).distance2 >= room * room) return;
    found = true;
    limit2 = 0;
  });
  return found;
}

}  // namespace mvs::core::orifice
