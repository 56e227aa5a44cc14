// Pieces of a leaflet to resect, by size and by outline.
#pragma once

#include "surgery/leaflet/site.h"
#include "tests/surgery/operated.h"

namespace mvs::core::test {

inline mvs_op_resect resection(double width, double base_width, double depth, double position = 0) {
  auto op = op_of<mvs_op_resect>(MVS_OP_RESECT);
  op.width = width;
  op.base_width = base_width;
  op.depth = depth;
  op.position = position;
  return op;
}

inline ModelState fine_valve() {
  mvs_parametric_desc desc = {};
  desc.shape = MVS_SHAPE_FOUNDING;
  desc.struct_size = sizeof desc;
  desc.vertices = 6800;
  return shipped(desc);
}

inline uint32_t scallop_named(const Valve &valve, const std::string &name) {
  for (uint32_t k = 0; k < valve.scallops.size(); ++k) {
    if (valve.scallops[k].name == name) return k;
  }
  return none;
}

// The present place of a point of a scallop.
inline Vec3 place_on(const ModelState &p, const std::string &scallop, double along, double height) {
  const Surgery s{*p.model, p.model->valve, p.state, "test"};
  const Id id = p.model->valve.scallops[scallop_named(p.model->valve, scallop)].id;
  const SheetPoint at = locate(s, {MVS_SITE_ANATOMICAL, 0, id, {along, height, 0}});
  Vec3 sum = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    sum += at.weight[k] * p.state.x.get()[p.model->valve.triangles[at.triangle][k]];
  }
  return sum;
}

inline std::vector<Vec3> notch(const ModelState &p) {
  return {place_on(p, "P2", 0.3, 1), place_on(p, "P2", 0.45, 0.4), place_on(p, "P2", 0.6, 0.4),
          place_on(p, "P2", 0.7, 1)};
}

inline mvs_op_resect along_outline(const std::vector<Vec3> &points) {
  auto op = op_of<mvs_op_resect>(MVS_OP_RESECT);
  op.outline = array_of(points);
  return op;
}

}  // namespace mvs::core::test
