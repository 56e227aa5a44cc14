// Cost of a repair: opens a copy of the valve, and measures it open and closed.
#include <mvs/cost.h>
#include <mvs/sim.h>

#include <cmath>
#include <limits>

#include "api/structs.h"
#include "geometry/aabb.h"
#include "history/event_limits.h"
#include "measure/annulus/frame.h"
#include "measure/cost/outflow.h"
#include "session/recorded_event.h"
#include "session/snapshot.h"
#include "solve/static/mesh_hierarchy.h"

using namespace mvs::core;

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

// m. Points of the septum that lie farther from the coaptation, or nearer to each other, are in
// another unit or frame: the distance is 0.01 to 0.04 m.
constexpr double farthest_septum = 0.1, least_septum = 1e-3;

// Pa. A valve is opened by some hundred; less than 0.15 mmHg is a number in mmHg (up to 20) or kPa.
constexpr double least_opening = 20, most_opening = 13332.2;  // to 100 mmHg

// Options with their defaults in place of zeros.
struct CostOptions {
  mvs_cost_options given;
  std::vector<Vec3> septum;
};

CostOptions read_options(const mvs_cost_options *options) {
  CostOptions read = {read_struct_or_default(options, "options"), {}};
  mvs_cost_options &given = read.given;
  must_be_backend(given.backend, "options.backend");
  MVS_MUST(!(given.pressure > 0 && given.pressure < least_opening), MVS_E_ARGUMENT,
           "options.pressure",
           "options.pressure is %g Pa, %.2g mmHg: a valve is opened by %g to %g Pa; looks like "
           "mmHg or kPa given as Pa",
           given.pressure, given.pressure * 120 / MVS_SYSTOLE_PA, least_opening, most_opening);
  given.pressure =
      or_default(given.pressure, MVS_DIASTOLE_PA, least_opening, most_opening, "options.pressure");
  must_be_in(given.residual, limits::residual, "options.residual");
  MVS_MUST(given.flow == 0 || (given.flow >= MVS_FLOW_MIN && given.flow <= MVS_FLOW_MAX),
           MVS_E_ARGUMENT, "options.flow",
           "options.flow is %g m3/s, %.3g ml/s: the flow through a mitral valve in diastole is "
           "about 250 ml/s, %g to %g ml/s are accepted: give it in m3/s",
           given.flow, 1e6 * given.flow, 1e6 * MVS_FLOW_MIN, 1e6 * MVS_FLOW_MAX);
  given.density = or_default(given.density, 1060, 500, 2000, "options.density");
  given.discharge = or_default(given.discharge, 0.85, 0.1, 1, "options.discharge");
  read.septum = read_points(given.septum, "options.septum");
  for (size_t k = 0; k < read.septum.size(); ++k) {
    const Vec3 &p = read.septum[k];
    MVS_MUST(p.allFinite(), MVS_E_ARGUMENT, "options.septum",
             "options.septum: point %zu is (%g, %g, %g): all coordinates have to be finite", k,
             p[0], p[1], p[2]);
  }
  const double extent = aabb_of(read.septum).longest_side();
  MVS_MUST(read.septum.size() < 2 || extent >= least_septum, MVS_E_ARGUMENT, "options.septum",
           "options.septum: its %zu points lie within %.3g m: give points of the septum in m",
           read.septum.size(), extent);
  return read;
}

// The valve opened as by mvs_set_load and mvs_settle.
SnapshotPtr open_valve(const mvs_snapshot &closed, const mvs_cost_options &options) {
  Progress progress;
  if (options.progress) {
    progress = [&options](double share, double residual) {
      return options.progress(options.user, share, residual) == 0;
    };
  }
  const Load load = {-options.pressure, 0};
  State state = closed.state;
  apply_event(*closed.model, state, event_of(load));
  Solver solver(static_cast<Backend>(options.backend));
  SolveOptions how = {};
  how.residual = options.residual;
  how.margins = false;
  settle_with_mesh_hierarchy(solver, *closed.model, state, how, progress);
  return make_snapshot(after_settle(closed.value, load, how, std::move(state)));
}

void add_opening(const mvs_snapshot &opened, const mvs_cost_options &options, mvs_cost &cost) {
  cost.opened = opened.state.is_at_rest();
  cost.open_area = cost.opened ? opened.orifice().area : unknown;
  cost.gradient = options.flow > 0 ? pressure_drop(options.flow, cost.open_area, options.density,
                                                   options.discharge)
                                   : unknown;
}

// The distance from the coaptation to the nearest point of the septum, which faces the anterior
// leaflet: the point has to be in front of the coaptation along the AP axis of the annulus.
double septal_distance(const mvs_snapshot &closed, const Outflow &outflow,
                       const std::vector<Vec3> &septum) {
  const std::optional<Vec3> nearest = outflow.nearest_of(septum);
  if (!nearest) return unknown;
  const Vec3 away = *nearest - *outflow.coaptation;
  MVS_MUST(away.norm() <= farthest_septum, MVS_E_ARGUMENT, "options.septum",
           "options.septum: its nearest point lies %.3g m from where the leaflets meet, and the "
           "septum 0.01 to 0.04 m: give its points in m, in the frame of the valve",
           away.norm());
  const double behind = -valve_frame(*closed.model, closed.state.x).axes.row(0).dot(away);
  MVS_MUST(behind <= 0, MVS_E_ARGUMENT, "options.septum",
           "options.septum: its nearest point lies %.3g m behind the line where the leaflets meet, "
           "on the side of the posterior leaflet, and the septum faces the anterior one: give its "
           "points in the frame of the valve (LPS or RAS), and check which leaflet is anterior",
           behind);
  return away.norm();
}

void add_outflow(const mvs_snapshot &closed, const std::vector<Vec3> &septum, mvs_cost &cost) {
  const Outflow outflow = measure_outflow(*closed.model, closed.state.x);
  cost.anterior_height = outflow.anterior_height;
  cost.posterior_height = outflow.posterior_height;
  cost.anterior_length = outflow.anterior_length;
  cost.posterior_length = outflow.posterior_length;
  cost.length_ratio = outflow.ratio();
  cost.septal_distance = septal_distance(closed, outflow, septum);
  const bool is_closed = closed.state.is_at_rest() && closed.state.load.pressure > 0;
  if (!is_closed || std::isnan(cost.septal_distance)) return;
  const bool raised = cost.length_ratio <= sam_ratio || cost.septal_distance <= sam_distance;
  cost.sam_risk = raised ? MVS_SAM_RAISED : MVS_SAM_LOW;
}

void add_forces(const mvs_snapshot &closed, mvs_cost &cost) {
  for (const Vec3 &force : closed.annulus_force()) {
    cost.annulus_force_max = std::max(cost.annulus_force_max, force.norm());
    cost.annulus_force_sum += force.norm();
  }
  cost.rings = static_cast<uint32_t>(closed.model->valve.rings.size());
  cost.chords_over_strain = closed.chords().over_strain;
  cost.chords_over_tension = closed.chords().over_tension;
}

}  // namespace

extern "C" {

mvs_result mvs_snapshot_measure_cost(const mvs_snapshot *snapshot, const mvs_cost_options *options,
                                     mvs_cost *cost, const mvs_snapshot **opened) {
  return at_boundary([&] {
    must_point(snapshot, "snapshot");
    checked_struct_size(cost, "cost");
    const CostOptions how = read_options(options);
    SnapshotPtr open = open_valve(*snapshot, how.given);
    mvs_cost found = {};
    add_opening(*open.get(), how.given, found);
    add_outflow(*snapshot, how.septum, found);
    add_forces(*snapshot, found);
    write_struct(cost, found, "cost");
    if (opened) *opened = open.release();
  });
}

}  // extern "C"
