// Locates sites on the sheet and inserts nodes there.
#include "surgery/leaflet/site.h"

#include <Eigen/Dense>
#include <algorithm>

#include "base/error.h"
#include "surgery/cutting/split.h"
#include "surgery/leaflet/sheet_map.h"

namespace mvs::core {
namespace {

// Barycentric distances below which an existing corner is used, and below which a side is split, so
// that no triangle gets a very small angle.
constexpr double corner_share = 0.25, side_share = 0.15;

SheetPoint at_triangle(const Surgery &s, const mvs_site &site) {
  const size_t count = s.valve.triangles.size();
  MVS_MUST(site.index < count, MVS_E_ID, format("triangle %u", site.index),
           "%s: the site is in triangle %u, but the valve has %zu", s.op_name, site.index, count);
  return {site.index, {site.u[0], site.u[1], site.u[2]}};
}

SheetPoint at_vertex(const Surgery &s, uint32_t node) {
  const size_t count = s.valve.rest.size();
  MVS_MUST(node < count, MVS_E_ID, format("node %u", node),
           "%s: the site is node %u, but the valve has %zu", s.op_name, node, count);
  for (uint32_t t = 0; t < s.valve.triangles.size(); ++t) {
    for (uint32_t k = 0; k < 3; ++k) {
      if (s.valve.triangles.get()[t][k] != node) continue;
      SheetPoint point{t, {0, 0, 0}};
      point.weight[k] = 1;
      return point;
    }
  }
  fail(MVS_E_OP, format("node %u", node), "%s: node %u is no vertex of a leaflet", s.op_name, node);
}

// Computes the barycentric coordinates of a point; returns false for a degenerate triangle.
bool weights_at(const std::array<Eigen::Vector2d, 3> &corner, const Eigen::Vector2d &at,
                std::array<double, 3> &weight) {
  Eigen::Matrix2d sides;
  sides << corner[1] - corner[0], corner[2] - corner[0];
  if (std::abs(sides.determinant()) < 1e-14) return false;
  const Eigen::Vector2d w = sides.inverse() * (at - corner[0]);
  weight = {1 - w[0] - w[1], w[0], w[1]};
  return true;
}

// Returns the point of the scallop with these coordinates, or the nearest one.
SheetPoint at_coordinates(const Model &model, uint32_t scallop, double along, double height) {
  const SheetMap map(model);
  SheetPoint best;
  double inside = -1e300;
  for (uint32_t t = 0; t < model.valve.triangles.size(); ++t) {
    if (model.valve.triangle_scallop[t] != scallop) continue;
    std::array<Eigen::Vector2d, 3> corner;
    for (int k = 0; k < 3; ++k) {
      const uint32_t node = model.valve.triangles[t][k];
      corner[k] = {map.along(scallop, node), map.height(node)};
    }
    std::array<double, 3> weight;
    if (!weights_at(corner, {along, height}, weight)) continue;
    const double least = *std::min_element(weight.begin(), weight.end());
    if (least <= inside) continue;
    inside = least;
    best = {t, weight};
  }
  double sum = 0;
  for (double &w : best.weight) sum += w = std::clamp(w, 0.0, 1.0);
  for (double &w : best.weight) w /= sum;
  return best;
}

bool is_annulus(const Surgery &s, uint32_t node) {
  const std::vector<uint32_t> &annulus = s.valve.annulus;
  return std::find(annulus.begin(), annulus.end(), node) != annulus.end();
}

std::array<double, 3> away_from_sides(std::array<double, 3> weight) {
  double sum = 0;
  for (double &w : weight) sum += w = std::max(w, side_share);
  for (double &w : weight) w /= sum;
  return weight;
}

uint32_t make_node(Surgery &s, const SheetPoint &point) {
  const Tri tri = s.valve.triangles.get()[point.triangle];
  const std::array<double, 3> &w = point.weight;
  for (uint32_t k = 0; k < 3; ++k) {
    if (w[k] >= 1 - corner_share && !is_annulus(s, tri[k])) return tri[k];
  }
  for (uint32_t k = 0; k < 3; ++k) {
    const uint32_t a = tri[k], b = tri[(k + 1) % 3];
    if (w[(k + 2) % 3] >= side_share || (is_annulus(s, a) && is_annulus(s, b))) continue;
    return split_side(s, a, b, std::clamp(w[(k + 1) % 3] / (w[k] + w[(k + 1) % 3]), 0.2, 0.8));
  }
  return split_triangle(s, point.triangle, away_from_sides(w));
}

}  // namespace

void check_site(const Surgery &s, const mvs_site &site) {
  if (site.how == MVS_SITE_NODE) at_vertex(s, site.index);
  if (site.how == MVS_SITE_TRIANGLE) at_triangle(s, site);
  if (site.how == MVS_SITE_ANATOMICAL) scallop_of(s, site.scallop);
}

SheetPoint locate(const Surgery &s, const mvs_site &site) {
  if (site.how == MVS_SITE_NODE) return at_vertex(s, site.index);
  if (site.how == MVS_SITE_TRIANGLE) return at_triangle(s, site);
  const uint32_t scallop = scallop_of(s, site.scallop);
  const SheetPoint point = at_coordinates(s.before, scallop, site.u[0], site.u[1]);
  MVS_MUST(point.triangle != none, MVS_E_OP, "site", "%s: scallop %s has no triangle to be on",
           s.op_name, s.valve.scallops.get()[scallop].name.c_str());
  return point;
}

uint32_t node_at(Surgery &s, const mvs_site &site) {
  if (site.how == MVS_SITE_NODE) {
    at_vertex(s, site.index);
    MVS_MUST(!is_annulus(s, site.index), MVS_E_OP, format("node %u", site.index),
             "%s: node %u lies on the annulus, which the heart holds: choose a place inside the "
             "leaflet",
             s.op_name, site.index);
    return site.index;
  }
  return make_node(s, locate(s, site));
}

uint32_t vertex_at(const Model &model, const mvs_site &site) {
  const Surgery s{model, model.valve, {}, "site"};
  const SheetPoint point = locate(s, site);
  const Tri &tri = model.valve.triangles[point.triangle];
  uint32_t best = none;
  double most = -1;
  for (uint32_t k = 0; k < 3; ++k) {
    const double weight = point.weight[k] - (is_annulus(s, tri[k]) ? 1 : 0);
    if (best != none && weight <= most) continue;
    best = tri[k];
    most = weight;
  }
  return best;
}

mvs_site anatomical(const Model &model, const mvs_site &site) {
  if (site.how == MVS_SITE_ANATOMICAL || site.how == MVS_SITE_NONE) return site;
  const Surgery s{model, model.valve, {}, "site"};
  const SheetPoint point = locate(s, site);
  const uint32_t scallop = model.valve.triangle_scallop[point.triangle];
  const SheetMap map(model);
  mvs_site out = {};
  out.how = MVS_SITE_ANATOMICAL;
  out.scallop = model.valve.scallops[scallop].id;
  for (int k = 0; k < 3; ++k) {
    const uint32_t node = model.valve.triangles[point.triangle][k];
    out.u[0] += point.weight[k] * map.along(scallop, node);
    out.u[1] += point.weight[k] * map.height(node);
  }
  for (double &u : out.u) u = std::clamp(u, 0.0, 1.0);
  return out;
}

}  // namespace mvs::core
