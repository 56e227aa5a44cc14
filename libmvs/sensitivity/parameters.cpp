// Analytic derivatives of cables, pressure and positions; differences of the elastic terms for
// tissue.
#include "sensitivity/parameters.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "energy/bending.h"
#include "energy/cable.h"
#include "energy/follower_pressure.h"
#include "energy/membrane.h"
#include "energy/spring.h"
#include "measure/annulus/frame.h"
#include "model/chord_law.h"

namespace mvs::core {
namespace {

using Kind = ParameterKind;

bool is_of_chord(Kind kind) {
  return kind == Kind::chord_rest_length || kind == Kind::chord_young || kind == Kind::chord_area;
}

bool is_of_tissue(Kind kind) {
  return kind >= Kind::leaflet_constant && kind <= Kind::prestrain;
}

bool has_modulus(const Chord &chord) {
  return chord.law == ChordLawId::linear || chord.law == ChordLawId::bilinear;
}

// The leaflet of a scallop.
uint32_t leaflet_of(const Valve &valve, const Parameter &p) {
  return p.kind == Kind::scallop_constant ? valve.scallops[p.index].leaflet : p.index;
}

// Rows of the list that the index of a parameter selects from, and their name.
struct Owner {
  size_t count;
  const char *what;
};
Owner owner_of(const Model &model, Kind kind) {
  const Valve &valve = model.valve;
  switch (kind) {
    case Kind::chord_rest_length:
    case Kind::chord_young:
    case Kind::chord_area:
      return {valve.chords.size(), "chord segments"};
    case Kind::leaflet_constant:
    case Kind::leaflet_thickness:
      return {valve.leaflets.size(), "leaflets"};
    case Kind::scallop_constant:
    case Kind::scallop_thickness:
      return {valve.scallops.size(), "scallops"};
    case Kind::node_position:
      return {model.node_count(), "nodes"};
    case Kind::head_position:
      return {valve.heads.size(), "papillary heads"};
    case Kind::prestrain:
    case Kind::pressure:
    case Kind::annulus_scale:
    case Kind::boundary_mode:
      break;
  }
  return {1, "parameters of this kind: leave index 0"};
}

void check_component(const Model &model, const Parameter &p, size_t place) {
  size_t count = 1;
  if (p.kind == Kind::node_position || p.kind == Kind::head_position) count = 3;
  if (p.kind == Kind::leaflet_constant || p.kind == Kind::scallop_constant) {
    const Leaflet &leaflet = model.valve.leaflets[leaflet_of(model.valve, p)];
    count = find_leaflet_law(leaflet.law)->constants.size();
  }
  MVS_MUST(p.component < count, MVS_E_ARGUMENT, "parameters",
           "parameters[%zu].component is %u: it has to be below %zu", place, p.component, count);
}

void check_mode(const Model &model, const Parameter &p, size_t place) {
  MVS_MUST(p.mode.size() == model.node_count(), MVS_E_ARGUMENT, "parameters",
           "parameters[%zu].mode has %zu rows, but the valve has %zu nodes", place, p.mode.size(),
           model.node_count());
  for (size_t i = 0; i < p.mode.size(); ++i) {
    MVS_MUST(p.mode[i].allFinite(), MVS_E_ARGUMENT, "parameters",
             "parameters[%zu].mode is not finite at node %zu", place, i);
    MVS_MUST(model.topology.fixed[i] || p.mode[i].isZero(0), MVS_E_ARGUMENT, "parameters",
             "parameters[%zu].mode moves node %zu, which is free: a mode moves annulus and "
             "papillary heads only",
             place, i);
  }
}

// The elastic terms of the leaflets.
void add_elastic(const Model &model, double times, const std::vector<Vec3> &x,
                 std::vector<Vec3> &g) {
  std::vector<Vec3> part(x.size(), Vec3::Zero());
  SpringTerm(model).gradient(x, part);
  MembraneTerm(model).gradient(x, part);
  BendingTerm(model).gradient(x, part);
  for (size_t i = 0; i < g.size(); ++i) g[i] += times * part[i];
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
      break;
  }
}

// The step of the difference: small beside the sharpest feature of a law, the rounded kink of the
// bilinear membrane, which is 0.2 % of its constant Ic.
double difference_step(const Model &model, const Parameter &p) {
  switch (p.kind) {
    case Kind::leaflet_thickness:
    case Kind::scallop_thickness:
      return 1e-2 * natural_scale(model, {}, p);  // a polynomial of third degree
    case Kind::prestrain:
      return 1e-4;
    default:
      return 1e-5 * natural_scale(model, {}, p);
  }
}

std::vector<Vec3> elastic_difference(const Model &model, const std::vector<Vec3> &x,
                                     const Parameter &p) {
  const double h = difference_step(model, p);
  std::vector<Vec3> g(x.size(), Vec3::Zero());
  for (const auto &[at, weight] : {std::array{1.0, 8.0 / 12}, std::array{-1.0, -8.0 / 12},
                                   std::array{2.0, -1.0 / 12}, std::array{-2.0, 1.0 / 12}}) {
    Model changed = model;
    apply(changed, p, at * h);
    add_elastic(changed, weight / h, x, g);
  }
  return g;
}

// One vector at each free node where it is not zero.
std::vector<NodeVector> sparse(const Model &model, const std::vector<Vec3> &field, bool fixed) {
  std::vector<NodeVector> list;
  for (uint32_t i = 0; i < field.size(); ++i) {
    const bool is_fixed = model.topology.fixed[i] != 0;
    if (is_fixed == fixed && !field[i].isZero(0)) list.push_back({i, field[i]});
  }
  return list;
}

std::vector<NodeVector> chord_force(const Model &model, const std::vector<Vec3> &x,
                                    const Parameter &p) {
  const Chord &chord = model.valve.chords[p.index];
  const Vec3 along = (x[chord.b] - x[chord.a]).normalized();
  const double slope = tension_derivative(model, p.index, x, p);
  std::vector<NodeVector> force;
  if (slope == 0) return force;
  if (!model.topology.fixed[chord.a]) force.push_back({chord.a, -slope * along});
  if (!model.topology.fixed[chord.b]) force.push_back({chord.b, slope * along});
  return force;
}

std::vector<NodeVector> pressure_force(const Model &model, const std::vector<Vec3> &x) {
  FollowerPressureTerm unit(model);
  unit.set_pressure(1);
  unit.freeze(x);
  std::vector<Vec3> g(x.size(), Vec3::Zero());
  unit.gradient(x, g);
  return sparse(model, g, false);
}

std::vector<NodeVector> scale_motion(const Model &model, const std::vector<Vec3> &x) {
  const Vec3 centre = valve_frame(model, x).origin;
  std::vector<NodeVector> motion;
  for (const uint32_t node : model.valve.annulus) motion.push_back({node, x[node] - centre});
  return motion;
}

}  // namespace

void check_parameter(const Model &model, const Parameter &p, size_t place) {
  MVS_MUST(p.kind >= Kind::chord_rest_length && p.kind <= Kind::boundary_mode, MVS_E_ARGUMENT,
           "parameters", "parameters[%zu].kind is %u: it has to be one of MVS_PARAMETER_*", place,
           static_cast<uint32_t>(p.kind));
  const Owner owner = owner_of(model, p.kind);
  MVS_MUST(p.index < owner.count, MVS_E_ARGUMENT, "parameters",
           "parameters[%zu].index is %u, but the valve has %zu %s", place, p.index, owner.count,
           owner.what);
  check_component(model, p, place);
  if (p.kind == Kind::chord_young) {
    const Chord &chord = model.valve.chords[p.index];
    MVS_MUST(has_modulus(chord), MVS_E_ARGUMENT, "chord " + chord.name,
             "parameters[%zu]: the law of chord %s has no modulus; take its area, to which the "
             "force is proportional as well",
             place, chord.name.c_str());
  }
  if (p.kind == Kind::node_position) {
    MVS_MUST(model.topology.fixed[p.index], MVS_E_ARGUMENT, "parameters",
             "parameters[%zu]: node %u is free; only nodes of the annulus and papillary heads have "
             "a position to prescribe",
             place, p.index);
  }
  if (p.kind == Kind::boundary_mode) {
    check_mode(model, p, place);
  } else {
    MVS_MUST(p.mode.empty(), MVS_E_ARGUMENT, "parameters",
             "parameters[%zu].mode is given, but only MVS_PARAMETER_BOUNDARY_MODE has a mode",
             place);
  }
}

ParameterLoad parameter_load(const Model &model, const State &state, const Parameter &p) {
  const std::vector<Vec3> &x = state.x;
  Vec3 axis = Vec3::Zero();
  axis[static_cast<int>(std::min(p.component, 2u))] = 1;
  switch (p.kind) {
    case Kind::chord_rest_length:
    case Kind::chord_young:
    case Kind::chord_area:
      return {chord_force(model, x, p), {}};
    case Kind::pressure:
      return {pressure_force(model, x), {}};
    case Kind::node_position:
      return {{}, {{p.index, axis}}};
    case Kind::head_position:
      return {{}, {{model.valve.heads[p.index].node, axis}}};
    case Kind::annulus_scale:
      return {{}, scale_motion(model, x)};
    case Kind::boundary_mode:
      return {{}, sparse(model, p.mode, true)};
    default:
      return {sparse(model, elastic_difference(model, x, p), false), {}};
  }
}

Model changed_model(const Model &model, std::span<const ParameterStep> steps) {
  Model changed = model;
  for (const ParameterStep &step : steps) apply(changed, *step.parameter, step.by);
  return changed;
}

void add_change(const Model &model, std::span<const ParameterStep> steps,
                const std::vector<Vec3> &x, std::vector<Vec3> &g) {
  bool chords = false, tissue = false;
  double pressure = 0;
  for (const ParameterStep &step : steps) {
    chords = chords || is_of_chord(step.parameter->kind);
    tissue = tissue || is_of_tissue(step.parameter->kind);
    if (step.parameter->kind == Kind::pressure) pressure += step.by;
  }
  if (pressure != 0) {
    FollowerPressureTerm term(model);
    term.set_pressure(pressure);
    term.freeze(x);
    term.gradient(x, g);
  }
  if (!chords && !tissue) return;
  const Model changed = changed_model(model, steps);
  if (tissue) {
    add_elastic(changed, 1, x, g);
    add_elastic(model, -1, x, g);
  }
  if (chords) {
    std::vector<Vec3> before(x.size(), Vec3::Zero());
    CableTerm(changed).gradient(x, g);
    CableTerm(model).gradient(x, before);
    for (size_t i = 0; i < g.size(); ++i) g[i] -= before[i];
  }
}

double natural_scale(const Model &model, const State &state, const Parameter &p) {
  const Valve &valve = model.valve;
  switch (p.kind) {
    case Kind::chord_rest_length:
      return valve.chords[p.index].rest_length;
    case Kind::chord_young:
      return valve.chords[p.index].young;
    case Kind::chord_area:
      return valve.chords[p.index].area;
    case Kind::leaflet_constant:
    case Kind::scallop_constant: {
      const Leaflet &leaflet = valve.leaflets[leaflet_of(valve, p)];
      const double value = std::abs(leaflet.constants[p.component]);
      return value > 0 ? value : find_leaflet_law(leaflet.law)->constants[p.component].fallback;
    }
    case Kind::leaflet_thickness:
      return valve.leaflets[p.index].thickness;
    case Kind::scallop_thickness:
      return valve.leaflets[valve.scallops[p.index].leaflet].thickness;
    case Kind::pressure:
      return std::max(std::abs(state.load.pressure), 1.0);
    default:
      return 1;
  }
}

double tension_derivative(const Model &model, uint32_t index, const std::vector<Vec3> &x,
                          const Parameter &p) {
  if (!is_of_chord(p.kind) || p.index != index) return 0;
  const Chord &chord = model.valve.chords[index];
  const double stretch = (x[chord.b] - x[chord.a]).norm() / chord.rest_length, e = stretch - 1;
  if (e <= 0) return 0;
  const Axial at = chord_response(model.valve, chord, e);
  if (p.kind == Kind::chord_rest_length) {
    return -chord.area * at.slope * stretch / chord.rest_length;
  }
  if (p.kind == Kind::chord_area) return at.stress;
  const double kink = chord.law == ChordLawId::bilinear ? chord.constants[0] : e;
  return chord.area * std::min(e, kink);
}

}  // namespace mvs::core
