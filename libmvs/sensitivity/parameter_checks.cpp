// Checks of parameters: whether the valve has them, and whether they have a derivative.
#include "base/error.h"
#include "sensitivity/chord_site.h"

namespace mvs::core {
namespace {

using Kind = ParameterKind;

bool has_modulus(const Chord &chord) {
  return chord.law == ChordLawId::linear || chord.law == ChordLawId::bilinear;
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
    case Kind::chord_site:
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
  if (p.kind == Kind::chord_site) return check_chord_site(model, p, place);
  size_t count = 1;
  if (p.kind == Kind::node_position || p.kind == Kind::head_position) count = 3;
  if (p.kind == Kind::leaflet_constant || p.kind == Kind::scallop_constant) {
    const Leaflet &leaflet = model.valve.leaflets[leaflet_of_parameter(model.valve, p)];
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

}  // namespace

void check_parameter(const Model &model, const Parameter &p, size_t place) {
  MVS_MUST(p.kind >= Kind::chord_rest_length && p.kind <= Kind::chord_site, MVS_E_ARGUMENT,
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

}  // namespace mvs::core
