// Reads a valve description, with one function for each kind of part. A zero selects the default of
// include/mvs/valve.h.
#include "api/valve_desc.h"

#include <cmath>

#include "api/structs.h"
#include "base/array_view.h"
#include "model/checks/check.h"
#include "model/chord_law.h"
#include "model/plausible.h"

namespace mvs::core {
namespace {

void read_nodes_and_triangles(const mvs_valve_desc &desc, Described &described) {
  Valve &valve = described.valve;
  valve.rest = read_points(desc.nodes, "nodes");
  valve.open = read_points(desc.nodes_open, "nodes_open");
  valve.loaded = read_points(desc.nodes_loaded, "nodes_loaded");
  valve.origin = read_indices(desc.node_origin, "node_origin");
  described.now = read_points(desc.nodes_now, "nodes_now");
  valve.triangles = read_triangles(desc.triangles, "triangles");
  valve.triangle_leaflet = read_indices(desc.triangle_leaflet, "triangle_leaflet");
  valve.triangle_scallop = read_indices(desc.triangle_scallop, "triangle_scallop");
  valve.triangle_thickness = read_numbers(desc.triangle_thickness, "triangle_thickness");
  valve.triangle_fibre = read_points(desc.triangle_fibre, "triangle_fibre");
  valve.annulus = read_indices(desc.annulus, "annulus");
}

// Replaces zeros by the defaults of the law, but for negative ones, which are zeros. Keeps
// constants that the law does not have: find_faults reports them.
template <typename Law, typename Values>
void read_law_constants(const Law *law, const double *given, Values &values) {
  for (size_t k = 0; k < values.size(); ++k) {
    const bool is_default = given[k] == 0 && !std::signbit(given[k]);
    const bool known = law && k < law->constants.size();
    values[k] = known && is_default ? law->constants[k].fallback : given[k] + 0.0;  // no -0
  }
}

Leaflet read_leaflet(const mvs_leaflet_desc &given) {
  must_be_zero(given.reserved, "leaflets[].reserved");
  Leaflet leaflet;
  leaflet.id = given.id;
  leaflet.name = text_or_empty(given.name);
  if (given.law != 0) leaflet.law = static_cast<LeafletLawId>(given.law);
  leaflet.thickness = value_or(given.thickness, leaflet.thickness);
  read_law_constants(find_leaflet_law(leaflet.law), given.constants, leaflet.constants);
  return leaflet;
}

// A scallop belongs to the leaflet of its first triangle.
void read_scallops(const mvs_valve_desc &desc, Valve &valve) {
  check_list(desc.scallops, desc.scallop_count, "scallops");
  for (uint32_t s = 0; s < desc.scallop_count; ++s) {
    const Id id = desc.scallop_ids ? desc.scallop_ids[s] : 0;
    valve.scallops.push_back({id, text_or_empty(desc.scallops[s]), none});
  }
  const size_t count = std::min(valve.triangle_scallop.size(), valve.triangle_leaflet.size());
  for (size_t t = 0; t < count; ++t) {
    if (valve.triangle_scallop[t] >= valve.scallops.size()) continue;
    Scallop &scallop = valve.scallops[valve.triangle_scallop[t]];
    if (scallop.leaflet == none) scallop.leaflet = valve.triangle_leaflet[t];
  }
}

Chord read_chord(const mvs_chord_desc &given) {
  Chord chord;
  chord.id = given.id;
  chord.name = text_or_empty(given.name);
  chord.a = given.node_a;
  chord.b = given.node_b;
  chord.kind = static_cast<ChordKind>(given.kind);
  if (given.law != 0) chord.law = static_cast<ChordLawId>(given.law);
  chord.rest_length = given.rest_length;
  chord.young = value_or(given.young, chord.young);
  chord.area = value_or(given.area, chord.area);
  read_law_constants(find_chord_law(chord.law), given.constants, chord.constants);
  return chord;
}

Head read_head(const mvs_head_desc &given) {
  must_be_zero(given.reserved, "heads[].reserved");
  return {given.id, text_or_empty(given.name), given.node};
}

Ring read_ring(const mvs_ring_desc &given) {
  must_be_zero(given.reserved, "rings[].reserved");
  const RingKind kind = given.kind == 0 ? RingKind::rigid : static_cast<RingKind>(given.kind);
  return {given.id, text_or_empty(given.name), kind, read_points(given.curve, "rings[].curve")};
}

ChordCurve read_curve(const mvs_curve_desc &given) {
  return {given.id, text_or_empty(given.name), read_pairs(given.points, "curves[].points")};
}

void read_parts(const mvs_valve_desc &desc, Valve &valve) {
  valve.leaflets =
      read_list(desc.leaflets, desc.leaflet_count, desc.leaflet_stride, "leaflets", read_leaflet);
  read_scallops(desc, valve);
  valve.chords = read_list(desc.chords, desc.chord_count, desc.chord_stride, "chords", read_chord);
  valve.heads = read_list(desc.heads, desc.head_count, desc.head_stride, "heads", read_head);
  valve.rings = read_list(desc.rings, desc.ring_count, desc.ring_stride, "rings", read_ring);
  valve.curves = read_list(desc.curves, desc.curve_count, desc.curve_stride, "curves", read_curve);
}

void read_constants(const mvs_valve_desc &desc, Valve &valve) {
  if (desc.name) valve.name = desc.name;
  valve.density = value_or(desc.density, valve.density);
  valve.contact_thickness = value_or(desc.contact_thickness, valve.contact_thickness);
  valve.contact_stiffness = value_or(desc.contact_stiffness, valve.contact_stiffness);
  const bool no_bending = (desc.flags & MVS_VALVE_FLAG_NO_BENDING) != 0;
  MVS_MUST(!no_bending || desc.bending_scale == 0, MVS_E_ARGUMENT, "valve.bending_scale",
           "valve.bending_scale is %g: it has to be 0 with MVS_VALVE_FLAG_NO_BENDING",
           desc.bending_scale);
  valve.bending_scale = no_bending ? 0 : value_or(desc.bending_scale, 1);
}

}  // namespace

Described read_valve_desc(const mvs_valve_desc *given) {
  const mvs_valve_desc desc = read_struct(given, "valve");
  constexpr uint32_t known_flags = MVS_VALVE_FLAG_ORIENT | MVS_VALVE_FLAG_NO_BENDING;
  MVS_MUST((desc.flags & ~known_flags) == 0, MVS_E_ARGUMENT, "valve.flags",
           "valve.flags is %u: it has bits that this version does not know", desc.flags);
  must_be_zero(desc.reserved, "valve.reserved");
  Described described;
  read_nodes_and_triangles(desc, described);
  read_parts(desc, described.valve);
  read_constants(desc, described.valve);
  if (desc.flags & MVS_VALVE_FLAG_ORIENT) orient(described.valve);
  return described;
}

void set_tissue(Leaflet &leaflet, const mvs_leaflet_desc &tissue) {
  must_be_zero(tissue.reserved, "tissue.reserved");
  MVS_MUST(!tissue.name && tissue.id == 0, MVS_E_ARGUMENT, "tissue.name",
           "tissue.name and tissue.id have to be empty: a tissue has no name or id, the leaflet "
           "keeps its own");
  const bool bare = std::all_of(std::begin(tissue.constants), std::end(tissue.constants),
                                [](double constant) { return constant == 0; });
  const LeafletLawId law =
      tissue.law == 0 ? LeafletLawId::spring : static_cast<LeafletLawId>(tissue.law);
  if (bare && law == LeafletLawId::bilinear && leaflet.law == LeafletLawId::spring) {
    leaflet.constants = membrane_like(Bilinear(leaflet.constants));
  } else {
    read_law_constants(find_leaflet_law(law), tissue.constants, leaflet.constants);
  }
  leaflet.law = law;
  leaflet.thickness = value_or(tissue.thickness, leaflet.thickness);
}

State described_state(const Model &model, const std::vector<Vec3> &now) {
  State state = initial_state(model);
  if (now.empty()) return state;
  MVS_MUST(now.size() == state.x.size(), MVS_E_ARGUMENT, "nodes_now",
           "nodes_now has %zu rows, the valve has %zu nodes", now.size(), state.x.size());
  for (size_t n = 0; n < now.size(); ++n) {
    MVS_MUST(is_near_rest(now[n], state.x[n]), MVS_E_ARGUMENT, format("node %zu", n),
             "node %zu of nodes_now is not a number, or over %g m from its rest position", n,
             most_from_rest);
  }
  state.x = now;
  return state;
}

}  // namespace mvs::core
