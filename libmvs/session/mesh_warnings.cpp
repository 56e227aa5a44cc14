// Checks of the mesh against the contact thickness, and of the leaflet names.
#include "session/mesh_warnings.h"

#include <algorithm>

#include "energy/contact.h"
#include "measure/annulus/annulus.h"
#include "measure/annulus/landmarks.h"

namespace mvs::core {
namespace {

// A triangle lower than this share of the contact thickness may keep a closure from converging
// (tests/stability, meshes/slivers); a share of 0.1 does not. A real valve with a share of 0.016
// closes, a finer mesh of it with 0.001 does not.
constexpr double needle_share = 0.01;

struct Needles {
  size_t count = 0;
  double lowest = 0;  // m
  Tri where{};
};

Needles needles_of(const Model &model) {
  const double limit = needle_share * model.valve.contact_thickness;
  Needles found;
  for (uint32_t t = 0; t < model.topology.triangle_edges.size(); ++t) {
    double longest = 0;
    for (const uint32_t edge : model.topology.triangle_edges[t]) {
      longest = std::max(longest, model.rest_length[edge]);
    }
    const double height = 2 * model.rest_area[t] / longest;
    if (height >= limit) continue;
    if (found.count++ == 0 || height < found.lowest) {
      found.lowest = height;
      found.where = model.valve.triangles[t];
    }
  }
  return found;
}

// All measures and rings depend on the anterior side.
void log_anterior(const mvs_sim &sim, const Model &model) {
  const Leaflet &leaflet = model.valve.leaflets[anterior_leaflet(model.valve)];
  if (leaflet.name[0] == 'A' || leaflet.name[0] == 'a') return;
  if (model.valve.leaflets.size() > 1) {
    sim.log(MVS_LOG_WARNING, "no leaflet is named A: %s is assumed to be anterior",
            leaflet.name.c_str());
    return;
  }
  const AnnulusMeasures m = measure_annulus(model, model.valve.rest);
  sim.log(MVS_LOG_WARNING,
          "no leaflet is named A: the first node of the annulus is assumed to be the middle of the "
          "anterior side, so that the annulus is %.3g mm wide from there (AP) and %.3g mm across "
          "(CC); name "
          "leaflets A and P, or start the annulus at that node",
          1e3 * m.ap, 1e3 * m.cc);
}

}  // namespace

void log_mesh(const mvs_sim &sim, const Model &model) {
  log_anterior(sim, model);
  const double r = model.valve.contact_thickness;
  const Needles needles = needles_of(model);
  if (needles.count > 0) {
    const auto [i, j, k] = needles.where;
    sim.log(
        MVS_LOG_WARNING,
        "the triangle of nodes %u, %u, %u is %.3g m high, under a hundredth of the contact "
        "thickness of %.3g m (%zu of them): the valve may not come to rest; merge nodes that are "
        "too close or make another mesh; to close without bending (bending_scale 0) may help too",
        i, j, k, needles.lowest, r, needles.count);
  }
  const auto thin = std::count_if(model.rest_length.begin(), model.rest_length.end(),
                                  [r](double length) { return length < r; });
  if (thin == 0) return;
  sim.log(
      MVS_LOG_INFO,
      "%td of %zu edges are shorter than the contact thickness of %.3g m: parts of the "
      "sheet closer than %.3g m at rest do not touch each other, the barrier only separates them",
      thin, model.topology.edges.size(), r, contact_rest_distance * r);
}

}  // namespace mvs::core
