// Fixtures of the tests of mesh levels: valves of every kind, and the properties that levels
// preserve.
#pragma once

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "anatomy/coarsen.h"
#include "anatomy/parametric.h"
#include "anatomy/refine.h"
#include "base/error.h"
#include "geometry/intersect.h"
#include "model/checks/check.h"
#include "tests/model/real_valves.h"
#include "tests/model/small_valve.h"

namespace mvs::core::test {

struct Named {
  std::string name;
  ModelPtr model;
};

inline ModelPtr parametric(uint32_t vertices, uint32_t branching = 0) {
  mvs_parametric_desc desc{};
  desc.shape = MVS_SHAPE_FOUNDING;
  desc.struct_size = sizeof desc;
  desc.vertices = vertices;
  desc.branching = branching;
  return make_model(make_parametric_valve(desc));
}

// A dilated valve with tall leaflets and a boundary that moves under load.
inline ModelPtr dilated() {
  mvs_parametric_desc desc{};
  desc.shape = MVS_SHAPE_FOUNDING;
  desc.struct_size = sizeof desc;
  desc.vertices = 900;
  desc.annulus_ap = 0.033;
  desc.annulus_cc = 0.041;
  desc.anterior_height = 0.027;
  desc.annulus_contraction = 0.95;
  desc.annulus_scale = 1.15;
  desc.indentation_depth = 0.004;
  return make_model(make_parametric_valve(desc));
}

// Kaiser's valve: triangles of every shape; the finer mesh in its loaded shape, see
// tests/geometry/orient.cpp.
inline void add_real(std::vector<Named> &valves, const std::string &file, const char *places) {
  const nlohmann::json json = read_real_valve(file);
  if (json.is_null()) {
    MESSAGE("skipped: no " << file);
    return;
  }
  Valve valve = kaiser_valve(json);
  for (size_t n = 0; n < valve.rest.size(); ++n) valve.rest[n] = in_metres(json[places][n]);
  orient(valve);
  valves.push_back({file, make_model(std::move(valve))});
}

inline std::vector<Named> all_kinds_of_valves() {
  std::vector<Named> valves = {{"425", parametric(425)},
                               {"1700, branching", parametric(1700, 1)},
                               {"dilated", dilated()},
                               {"small", make_model(small_valve())}};
  add_real(valves, "kaiser_mitral_normal_1/N32.json", "vertices_relaxed");
  add_real(valves, "kaiser_mitral_normal_1/N128.json", "vertices_pressurized");
  return valves;
}

// Counted apart from the library, which tells its own number in reports.
inline size_t counted_vertices(const Model &model) {
  size_t count = 0;
  for (size_t n = 0; n < model.node_count(); ++n) {
    count += !model.topology.node_triangles[n].empty();
  }
  return count;
}

inline long euler(const Model &model) {
  return static_cast<long>(counted_vertices(model)) -
         static_cast<long>(model.topology.edges.size()) +
         static_cast<long>(model.valve.triangles.size());
}

inline double area(const Model &model) {
  return std::accumulate(model.rest_area.begin(), model.rest_area.end(), 0.0);
}

inline std::vector<double> scallop_areas(const Model &model) {
  std::vector<double> areas(model.valve.scallops.size(), 0);
  for (size_t t = 0; t < model.rest_area.size(); ++t) {
    areas[model.valve.triangle_scallop[t]] += model.rest_area[t];
  }
  return areas;
}

inline double quality(const Model &model, const Tri &t) {
  const std::vector<Vec3> &x = model.valve.rest;
  const Vec3 ab = x[t[1]] - x[t[0]], ac = x[t[2]] - x[t[0]];
  return 2 * std::sqrt(3.0) * ab.cross(ac).norm() /
         (ab.squaredNorm() + ac.squaredNorm() + (ac - ab).squaredNorm());
}

inline double worst_quality(const Model &model) {
  double worst = 1;
  for (const Tri &t : model.valve.triangles) worst = std::min(worst, quality(model, t));
  return worst;
}

inline size_t crossings(const Model &model) {
  return find_intersections(model.valve.rest, model.valve.triangles).size();
}

// Returns the sentence of the error that `work` throws; "" if it throws no error.
template <typename Work>
std::string refusal(Work work) {
  try {
    work();
  } catch (const Error &error) {
    CHECK(error.code == MVS_E_ARGUMENT);
    return error.what();
  }
  return "";
}

}  // namespace mvs::core::test
