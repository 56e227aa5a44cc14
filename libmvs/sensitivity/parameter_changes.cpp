// A model with changed parameters, and the change of the forces at fixed positions.
#include "energy/bending.h"
#include "energy/cable.h"
#include "energy/contact.h"
#include "energy/follower_pressure.h"
#include "energy/membrane.h"
#include "energy/spring.h"
#include "sensitivity/chord_site.h"

namespace mvs::core {
namespace {

using Kind = ParameterKind;

bool is_of_tissue(Kind kind) {
  return kind >= Kind::leaflet_constant && kind <= Kind::prestrain;
}

// A leaflet of its own for the triangles of a scallop, in place of theirs.
void change_scallop(Valve &valve, const Parameter &p, double by) {
  const auto own = static_cast<uint32_t>(valve.leaflets.size());
  std::vector<uint32_t> &of = valve.triangle_leaflet.edit();
  uint32_t before = valve.scallops[p.index].leaflet;
  for (size_t t = 0; t < of.size(); ++t) {
    if (valve.triangle_scallop[t] != p.index) continue;
    before = of[t];
    of[t] = own;
  }
  Leaflet leaflet = valve.leaflets[before];
  leaflet.constants[p.component] += by;
  valve.leaflets.edit().push_back(leaflet);
}

void thicken(Valve &valve, const Parameter &p, double by) {
  const std::vector<uint32_t> &part =
      p.kind == Kind::scallop_thickness ? valve.triangle_scallop : valve.triangle_leaflet;
  std::vector<double> &thickness = valve.triangle_thickness.edit();
  for (size_t t = 0; t < thickness.size(); ++t) {
    if (part[t] == p.index) thickness[t] += by;
  }
}

void shrink_rest(Model &model, double prestrain) {
  const double scale = 1 / (1 + prestrain);
  for (Vec3 &rest : model.valve.rest.edit()) rest *= scale;
  for (double &area : model.rest_area.edit()) area *= scale * scale;
  for (double &area : model.vertex_area.edit()) area *= scale * scale;
  for (double &length : model.rest_length.edit()) length *= scale;
}

void apply(Model &model, const Parameter &p, double by) {
  Valve &valve = model.valve;
  switch (p.kind) {
    case Kind::chord_rest_length:
      valve.chords.edit()[p.index].rest_length += by;
      break;
    case Kind::chord_young:
      valve.chords.edit()[p.index].young += by;
      break;
    case Kind::chord_area:
      valve.chords.edit()[p.index].area += by;
      break;
    case Kind::leaflet_constant:
      valve.leaflets.edit()[p.index].constants[p.component] += by;
      break;
    case Kind::scallop_constant:
      change_scallop(valve, p, by);
      break;
    case Kind::leaflet_thickness:
    case Kind::scallop_thickness:
      thicken(valve, p, by);
      break;
    case Kind::prestrain:
      shrink_rest(model, by);
      break;
    case Kind::pressure:
    case Kind::node_position:
    case Kind::head_position:
    case Kind::annulus_scale:
    case Kind::boundary_mode:
    case Kind::chord_site:
      break;
  }
}

void add_contact(const Model &model, const std::vector<Vec3> &x, std::vector<Vec3> &g) {
  BroadPhase broad_phase(model);
  broad_phase.build(x, x, 0, StepMotion::together);
  ContactTerm contact(model);
  contact.collect(x, broad_phase);
  contact.gradient(g);
}

}  // namespace

void add_tissue(const Model &model, bool rest_changes, double times, const std::vector<Vec3> &x,
                std::vector<Vec3> &g) {
  std::vector<Vec3> part(x.size(), Vec3::Zero());
  SpringTerm(model).gradient(x, part);
  MembraneTerm(model).gradient(x, part);
  BendingTerm(model).gradient(x, part);
  if (rest_changes) add_contact(model, x, part);
  for (size_t i = 0; i < g.size(); ++i) g[i] += times * part[i];
}

Model changed_model(const Model &model, std::span<const ParameterStep> steps) {
  Model changed = model;
  for (const ParameterStep &step : steps) apply(changed, *step.parameter, step.by);
  return changed;
}

void add_change(const Model &model, std::span<const ParameterStep> steps,
                const std::vector<Vec3> &x, std::vector<Vec3> &g) {
  bool chords = false, tissue = false, rest = false, sites = false;
  double pressure = 0;
  for (const ParameterStep &step : steps) {
    chords = chords || is_of_chord(step.parameter->kind);
    tissue = tissue || is_of_tissue(step.parameter->kind);
    sites = sites || step.parameter->kind == Kind::chord_site;
    rest = rest || step.parameter->kind == Kind::prestrain;
    if (step.parameter->kind == Kind::pressure) pressure += step.by;
  }
  if (pressure != 0) {
    FollowerPressureTerm term(model);
    term.set_pressure(pressure);
    term.freeze(x);
    term.gradient(x, g);
  }
  if (!chords && !tissue && !sites) return;
  const Model changed = changed_model(model, steps);
  if (tissue) {
    add_tissue(changed, rest, 1, x, g);
    add_tissue(model, rest, -1, x, g);
  }
  if (chords) {
    std::vector<Vec3> before(x.size(), Vec3::Zero());
    CableTerm(changed).gradient(x, g);
    CableTerm(model).gradient(x, before);
    for (size_t i = 0; i < g.size(); ++i) g[i] -= before[i];
  }
  if (sites) add_site_change(changed, steps, x, g);
}

}  // namespace mvs::core
