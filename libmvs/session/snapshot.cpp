// Measures and tables of a snapshot.
#include "session/snapshot.h"

#include <limits>

#include "base/struct_fields.h"
#include "geometry/intersect.h"
#include "measure/fields.h"
#include "measure/tissue/sheet_topology.h"

namespace {

using namespace mvs::core;

Tables make_tables(const Model &model) {
  const Valve &valve = model.valve;
  Tables tables;
  for (const Chord &chord : valve.chords) {
    tables.chord_nodes.push_back({chord.a, chord.b});
    tables.chord_kind.push_back(chord.kind);
    tables.chord_id.push_back(chord.id);
    tables.chord_rest_length.push_back(chord.rest_length);
    tables.chord_young.push_back(chord.young);
    tables.chord_area.push_back(chord.area);
    tables.chord_law.push_back(chord.law);
    tables.chord_constants.push_back(chord.constants);
  }
  for (const Head &head : valve.heads) tables.head_nodes.push_back(head.node);
  tables.ring_start = {0};
  for (const Ring &ring : valve.rings) {
    tables.ring_kind.push_back(ring.kind);
    tables.ring_id.push_back(ring.id);
    tables.ring_points.insert(tables.ring_points.end(), ring.curve.begin(), ring.curve.end());
    tables.ring_start.push_back(static_cast<uint32_t>(tables.ring_points.size()));
  }
  tables.curve_start = {0};
  for (const ChordCurve &curve : valve.curves) {
    tables.curve_points.insert(tables.curve_points.end(), curve.points.begin(), curve.points.end());
    tables.curve_start.push_back(static_cast<uint32_t>(tables.curve_points.size()));
  }
  for (const Leaflet &leaflet : valve.leaflets) {
    tables.leaflet_law.push_back(leaflet.law);
    auto &row = tables.leaflet_constants.emplace_back();
    row[0] = leaflet.thickness;
    std::copy(leaflet.constants.begin(), leaflet.constants.end(), row.begin() + 1);
  }
  for (const std::vector<uint32_t> &loop : model.topology.free_edges) {
    tables.free_edge_nodes.insert(tables.free_edge_nodes.end(), loop.begin(), loop.end());
  }
  tables.valve_constants = {valve.density, valve.contact_thickness, valve.contact_stiffness,
                            valve.bending_scale};
  return tables;
}

void add_crossings(const mvs_snapshot &s, mvs_measures &m) {
  m.intersections = s.crossings();
}

// NaN in every number and 0 in every count.
mvs_measures no_measures() {
  mvs_measures measures = {};
  measures.struct_size = sizeof measures;
  for (const mvs_field_info &field : struct_fields(MVS_STRUCT_MEASURES)) {
    if (field.type == MVS_FIELD_NUMBER) {
      write_field(&measures, field, std::numeric_limits<double>::quiet_NaN());
    }
  }
  return measures;
}

}  // namespace

const BoundaryForces &mvs_snapshot::boundary_forces() const {
  return forces_.get([this] {
    BoundaryForces forces = {evaluate_forces(*model, state), {}};
    for (const uint32_t node : model->valve.annulus) {
      forces.annulus.push_back(forces.all.total[node]);
    }
    return forces;
  });
}
const Forces &mvs_snapshot::forces() const {
  return boundary_forces().all;
}
const Coaptation &mvs_snapshot::coaptation() const {
  return coaptation_.get([this] { return measure_coaptation(*model, state.x); });
}
const Strain &mvs_snapshot::strain() const {
  return strain_.get([this] { return measure_strain(*model, state.x); });
}
const Tensors &mvs_snapshot::tensors() const {
  return tensors_.get([this] { return measure_tensors(*model, state.x); });
}
const ChordMeasures &mvs_snapshot::chords() const {
  return chords_.get([this] { return measure_chords(*model, state.x); });
}
const ChordEnds &mvs_snapshot::chord_ends() const {
  return chord_ends_.get([this] { return find_chord_ends(*model); });
}
const Orifice &mvs_snapshot::orifice() const {
  return orifice_.get([this] { return measure_orifice(*model, state.x); });
}
const OrificeParts &mvs_snapshot::orifice_parts() const {
  return orifice_parts_.get(
      [this] { return find_orifice_parts(*model, state.x, region_map(), orifice()); });
}
const RegionMap &mvs_snapshot::region_map() const {
  return region_map_.get([this] { return RegionMap(*model); });
}
const std::vector<RegionMeasures> &mvs_snapshot::regions() const {
  return regions_.get([this] {
    return measure_regions(*model, state.x, region_map(), coaptation(), orifice_parts(),
                           atrial_surface());
  });
}
const Stability &mvs_snapshot::stability() const {
  return stability_.get([this] { return check_stability(*model, state); });
}
const std::vector<Vec3> &mvs_snapshot::annulus_force() const {
  return boundary_forces().annulus;
}
const Tables &mvs_snapshot::tables() const {
  return tables_.get([this] { return make_tables(*model); });
}
const AnnulusMeasures &mvs_snapshot::annulus() const {
  return annulus_.get([this] { return measure_annulus(*model, state.x); });
}
const AtrialSide &mvs_snapshot::atrial_side() const {
  return atrial_side_.get([this] {
    AtrialSide side;
    side.surface = mvs::core::atrial_surface(*model, state.x);
    side.tenting_billow = measure_tenting_billow(side.surface);
    return side;
  });
}
const AtrialSurface &mvs_snapshot::atrial_surface() const {
  return atrial_side().surface;
}
const TentingBillow &mvs_snapshot::tenting_billow() const {
  return atrial_side().tenting_billow;
}
uint32_t mvs_snapshot::crossings() const {
  return crossings_.get([this] {
    const Valve &valve = model->valve;
    const auto sheet = sheet_topology(*model);
    return static_cast<uint32_t>(find_intersections(state.x, valve.triangles, *sheet).size());
  });
}
const mvs_measures &mvs_snapshot::measures() const {
  return measures_.get([this] { return measures(all_measure_groups()); });
}
mvs_measures mvs_snapshot::measures(mvs_measure_group_flags groups) const {
  mvs_measures m = no_measures();
  if ((groups & MVS_MEASURE_GROUP_CROSSINGS) != 0) add_crossings(*this, m);
  if ((groups & MVS_MEASURE_GROUP_ORIFICE) != 0) fill_group(orifice(), m);
  if ((groups & MVS_MEASURE_GROUP_COAPTATION) != 0) fill_group(coaptation(), m);
  if ((groups & MVS_MEASURE_GROUP_TENTING) != 0) fill_group(tenting_billow(), m);
  if ((groups & MVS_MEASURE_GROUP_ANNULUS) != 0) fill_group(annulus(), m);
  if ((groups & MVS_MEASURE_GROUP_CHORDS) != 0) fill_group(chords(), m);
  if ((groups & MVS_MEASURE_GROUP_LEAFLETS) != 0) fill_group(strain(), m);
  m.at_rest = state.is_at_rest();
  m.under_load = state.load.pressure > 0;
  return m;
}
mvs_measure_group_flags mvs_snapshot::computed_groups() const {
  mvs_measure_group_flags groups = 0;
  if (crossings_.is_computed()) groups |= MVS_MEASURE_GROUP_CROSSINGS;
  if (orifice_.is_computed()) groups |= MVS_MEASURE_GROUP_ORIFICE;
  if (coaptation_.is_computed()) groups |= MVS_MEASURE_GROUP_COAPTATION;
  if (atrial_side_.is_computed()) groups |= MVS_MEASURE_GROUP_TENTING;
  if (annulus_.is_computed()) groups |= MVS_MEASURE_GROUP_ANNULUS;
  if (chords_.is_computed()) groups |= MVS_MEASURE_GROUP_CHORDS;
  if (strain_.is_computed()) groups |= MVS_MEASURE_GROUP_LEAFLETS;
  return groups;
}
