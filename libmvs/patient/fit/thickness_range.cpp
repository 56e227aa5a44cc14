// Thickness per triangle and of contact, scaled.
#include "patient/fit/thickness_range.h"

#include <algorithm>

#include "base/error.h"
#include "patient/findings.h"

namespace mvs::core {
namespace {

// Contact thickness per mean edge length: adjacent vertices lie outside the range of contact.
constexpr double contact_per_edge = 0.6;

}  // namespace

double mean_thickness(const Valve &valve) {
  double sum = 0;
  const size_t count = valve.triangles.size();
  for (size_t t = 0; t < count; ++t) {
    sum += valve.triangle_thickness.empty()
               ? valve.leaflets[valve.triangle_leaflet.get()[t]].thickness
               : valve.triangle_thickness.get()[t];
  }
  return sum / static_cast<double>(count);
}

double contact_thickness(const Valve &valve) {
  double edges = 0;
  for (const Tri &t : valve.triangles.get()) {
    for (size_t k = 0; k < 3; ++k) edges += (valve.rest[t[k]] - valve.rest[t[(k + 1) % 3]]).norm();
  }
  const double mean_edge = edges / (3 * static_cast<double>(valve.triangles.size()));
  return std::min(mean_thickness(valve), contact_per_edge * mean_edge);
}

Valve with_thickness(const Valve &valve, double factor) {
  Valve changed = valve;
  for (double &thickness : changed.triangle_thickness.edit()) thickness *= factor;
  for (Leaflet &leaflet : changed.leaflets) leaflet.thickness *= factor;
  changed.contact_thickness = contact_thickness(changed);
  return changed;
}

void report_thin_contact(const Valve &valve, Findings &findings) {
  constexpr double least_gap = 1e-3;
  const double thickness = mean_thickness(valve), contact = valve.contact_thickness;
  if (thickness - contact < least_gap) return;
  add_measured(
      findings, "thin_contact",
      format("the leaflets are %.2f mm thick in the mean and touch where their middles are %.2f mm "
             "apart: contact has to be shorter than the sides of the mesh. Gaps that the thickness "
             "closes may leak in the model; give fewer vertices",
             1e3 * thickness, 1e3 * contact),
      {contact, thickness}, "m");
}

void report_thickness_error(double error, Findings &findings) {
  if (!(error > 0)) return;
  findings.push_back(
      {"thickness_error",
       FindingSource::given,
       1,
       format("the leaflets may be %.2f mm thicker or thinner, as given; the interval "
              "of leaks allows for it",
              error * 1e3),
       {error},
       "m"});
}

}  // namespace mvs::core
