// Operation annulus_scale: scales the prescribed positions of the annulus about its centroid.
#include "base/error.h"
#include "measure/annulus/frame.h"
#include "measure/annulus/landmarks.h"
#include "surgery/surgery.h"

namespace mvs::core {
namespace {

// Scales the prescribed positions about their centroid, along their own axes.
void scale(const Surgery &s, const Vec3 &along, CowVector<Vec3> &places) {
  const Frame frame = valve_frame(s.before, places);
  for (const uint32_t node : s.valve.annulus.get()) {
    const Vec3 local = frame.local(places[node]).cwiseProduct(along);
    places[node] = frame.origin + frame.axes.transpose() * local;
  }
}

}  // namespace

void operate(Surgery &s, const mvs_op_annulus_scale &op) {
  const double all = op.factor != 0 ? op.factor : 1;
  const Vec3 along(op.ap != 0 ? all * op.ap : all, op.cc != 0 ? all * op.cc : all, all);
  MVS_MUST(op.factor != 0 || op.ap != 0 || op.cc != 0, MVS_E_ARGUMENT, "annulus_scale",
           "annulus_scale: give at least one of factor, ap and cc");
  must_have_no_ring(s, "which has to stay on it: scale before, or sew in a ring of another size");
  scale(s, along, s.valve.open);
  scale(s, along, s.valve.loaded);
  must_be_a_perimeter(s, Loop(s.valve.annulus, s.valve.loaded).length(), "factor");
  s.title =
      format("Scale the annulus to %.0f %% (AP) and %.0f %% (CC)", 100 * along[0], 100 * along[1]);
}

}  // namespace mvs::core
