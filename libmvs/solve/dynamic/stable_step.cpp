// The stiffness of the springs along the sides of each triangle, and of the chordae, by node.
#include "solve/dynamic/stable_step.h"

#include <algorithm>
#include <cmath>

#include "model/chord_law.h"
#include "model/law.h"
#include "solve/settings.h"
#include "solve/step_settings.h"

namespace mvs::core {
namespace {

// Pa, the stiffest tangent up to the stress of tissue that is hit.
double working_tangent(const Leaflet &leaflet) {
  namespace set = settings::explicit_euler;
  const LeafletLaw &law = *find_leaflet_law(leaflet.law);
  const auto stress = [&](double stretch) {
    return equibiaxial_stress(law, leaflet.constants, stretch);
  };
  constexpr double d = 1e-3;
  constexpr auto count = static_cast<uint32_t>((set::largest_stretch - 1) / d);
  double stiffest = 0;
  for (uint32_t k = 0; k < count; ++k) {
    const double stretch = 1 + k * d, here = stress(stretch);
    stiffest = std::max(stiffest, (stress(stretch + d) - here) / d);
    if (here > set::largest_stress) break;
  }
  return stiffest;
}

// N/m.
double working_stiffness(const Valve &valve, const Chord &chord) {
  double slope = 0;
  for (const double strain : {0.0, 0.02, 0.05, 0.1}) {
    slope = std::max(slope, chord_response(valve, chord, strain).slope);
  }
  return slope * chord.area / chord.rest_length;
}

}  // namespace

double stable_explicit_step(const Model &model) {
  const Valve &valve = model.valve;
  std::vector<double> tangent, stiffness(model.node_count(), 0.0);
  for (const Leaflet &leaflet : valve.leaflets) tangent.push_back(working_tangent(leaflet));
  for (size_t t = 0; t < valve.triangles.size(); ++t) {
    const double volume = valve.triangle_thickness[t] * model.rest_area[t];
    for (const uint32_t e : model.topology.triangle_edges[t]) {
      const double length = model.rest_length[e];
      const double k = tangent[valve.triangle_leaflet[t]] * volume / (length * length);
      for (const uint32_t node : model.topology.edges[e]) stiffness[node] += k;
    }
  }
  for (const Chord &chord : valve.chords) {
    const double k = working_stiffness(valve, chord);
    stiffness[chord.a] += k;
    stiffness[chord.b] += k;
  }
  double square = 0;  // of omega
  for (size_t n = 0; n < stiffness.size(); ++n) {
    if (!model.topology.fixed[n]) square = std::max(square, 2 * stiffness[n] / model.node_mass[n]);
  }
  const double dt = square > 0 ? settings::explicit_euler::stable_share * 2 / std::sqrt(square) : 1;
  return std::min(dt, settings::defaults::explicit_dt);
}

}  // namespace mvs::core
