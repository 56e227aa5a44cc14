// The regurgitant orifice: sample the sheet, cut the space between its samples, smooth the cut.
// The definition, the method and its errors are in README.md.
#include "measure/orifice/orifice.h"

#include "measure/annulus/frame.h"
#include "measure/orifice/samples.h"
#include "measure/orifice/smallest_cut.h"
#include "measure/orifice/smallest_surface.h"

namespace mvs::core {

Orifice measure_orifice(const Model &model, const std::vector<Vec3> &x) {
  const Frame frame = valve_frame(model, x);
  std::vector<Vec3> local;
  local.reserve(x.size());
  for (const Vec3 &p : x) local.push_back(frame.local(p));

  const orifice::Sheet sheet = orifice::local_sheet(model, local);
  const orifice::Samples samples = orifice::sample(sheet);
  const std::vector<Tri> cut = orifice::smallest_cut(sheet, samples);
  const orifice::Mesh surface = orifice::smallest_surface(sheet, samples, cut);

  Orifice result;
  result.area = orifice::area_of(surface);
  result.triangles = surface.triangles;
  for (const Vec3 &p : surface.x) {
    result.vertices.push_back(frame.axes.transpose() * p + frame.origin);
  }
  return result;
}

}  // namespace mvs::core
