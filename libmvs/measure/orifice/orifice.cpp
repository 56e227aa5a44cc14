// Regurgitant orifice: samples the sheet, computes the minimum cut of the space between the
// samples, and shrinks it to a surface of least area. METHOD.md has definition, method and errors.
#include "measure/orifice/orifice.h"

#include "geometry/triangle_bvh.h"
#include "measure/annulus/frame.h"
#include "measure/orifice/samples.h"
#include "measure/orifice/seal.h"
#include "measure/orifice/smallest_cut.h"
#include "measure/orifice/smallest_surface.h"

namespace mvs::core {

Orifice measure_orifice(const Model &model, const std::vector<Vec3> &x) {
  if (orifice::is_zipped(model, x)) return {};
  return cut_orifice(model, x);
}

Orifice cut_orifice(const Model &model, const std::vector<Vec3> &x) {
  return cut_orifice_of(x, model.valve.triangles, model, x);
}

Orifice cut_orifice_of(const std::vector<Vec3> &points, const std::vector<Tri> &triangles,
                       const Model &model, const std::vector<Vec3> &x) {
  const Frame frame = valve_frame(model, x);
  const orifice::Sheet sheet = orifice::local_sheet(points, triangles, model, x, frame);
  const orifice::Samples samples = orifice::sample(sheet);
  const TriangleBvh tree(sheet.mesh.triangles, sheet.mesh.x);
  const std::vector<Tri> cut = orifice::smallest_cut(sheet, tree, samples);
  const orifice::Mesh surface = orifice::smallest_surface(sheet, tree, samples, cut);

  Orifice result;
  result.area = orifice::area_of(surface);
  result.triangles = surface.triangles;
  for (const Vec3 &p : surface.x) {
    result.vertices.push_back(frame.axes.transpose() * p + frame.origin);
  }
  return result;
}

}  // namespace mvs::core
