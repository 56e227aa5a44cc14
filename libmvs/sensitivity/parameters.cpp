// Derivatives of forces and of the positions of prescribed nodes: analytic for cables, pressure and
// positions, differences of the terms for tissue.
#include "sensitivity/parameters.h"

#include <algorithm>
#include <cmath>

#include "energy/follower_pressure.h"
#include "measure/annulus/frame.h"
#include "model/chord_law.h"
#include "sensitivity/chord_site.h"

namespace mvs::core {
namespace {

using Kind = ParameterKind;

constexpr uint32_t kink_constant = 2;  // of the law of springs

// The step of the difference: small beside the sharpest feature of a law, the rounded kink of the
// bilinear membrane, which is 0.2 % of its constant Ic. Springs have sharp kinks and are linear
// between them: the smallest step whose difference rounding leaves right to 1e-7.
double difference_step(const Model &model, const Parameter &p) {
  const std::vector<Leaflet> &leaflets = model.valve.leaflets;
  const bool has_springs = std::any_of(leaflets.begin(), leaflets.end(), [](const Leaflet &one) {
    return one.law == LeafletLawId::spring;
  });
  switch (p.kind) {
    case Kind::leaflet_thickness:
    case Kind::scallop_thickness:
      return 1e-2 * natural_scale(model, {}, p);  // a polynomial of third degree
    case Kind::prestrain:
      return has_springs ? 1e-8 : 1e-4;
    case Kind::leaflet_constant:
    case Kind::scallop_constant:
      if (has_springs && p.component == kink_constant) return 1e-8;
      [[fallthrough]];
    default:
      return 1e-5 * natural_scale(model, {}, p);
  }
}

std::vector<Vec3> tissue_difference(const Model &model, const std::vector<Vec3> &x,
                                    const Parameter &p) {
  const double h = difference_step(model, p);
  std::vector<Vec3> g(x.size(), Vec3::Zero());
  for (const auto &[at, weight] : {std::array{1.0, 8.0 / 12}, std::array{-1.0, -8.0 / 12},
                                   std::array{2.0, -1.0 / 12}, std::array{-2.0, 1.0 / 12}}) {
    const ParameterStep step = {&p, at * h};
    add_tissue(changed_model(model, {&step, 1}), p.kind == Kind::prestrain, weight / h, x, g);
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

bool is_of_chord(ParameterKind kind) {
  return kind == Kind::chord_rest_length || kind == Kind::chord_young || kind == Kind::chord_area;
}

uint32_t leaflet_of_parameter(const Valve &valve, const Parameter &p) {
  return p.kind == Kind::scallop_constant ? valve.scallops[p.index].leaflet : p.index;
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
    case Kind::chord_site:
      return {site_force(model, x, p), {}};
    default:
      return {sparse(model, tissue_difference(model, x, p), false), {}};
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
      const Leaflet &leaflet = valve.leaflets[leaflet_of_parameter(valve, p)];
      const double value = std::abs(leaflet.constants[p.component]);
      return value > 0 ? value : find_leaflet_law(leaflet.law)->constants[p.component].fallback;
    }
    case Kind::leaflet_thickness:
      return valve.leaflets[p.index].thickness;
    case Kind::scallop_thickness:
      return valve.leaflets[valve.scallops[p.index].leaflet].thickness;
    case Kind::pressure:
      return std::max(std::abs(state.load.pressure), 1.0);
    case Kind::chord_site:
      return chord_site(model, p).edge;
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
