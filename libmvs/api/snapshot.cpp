// Snapshots: reference counts, hash, load, measures, comparison, sections.
#include "session/snapshot.h"

#include "api/structs.h"
#include "base/struct_fields.h"

using namespace mvs::core;

namespace {

Vec3 read_vector(const double given[3], const char *what) {
  must_point(given, what);
  Vec3 vector(given[0], given[1], given[2]);
  MVS_MUST(vector.allFinite(), MVS_E_ARGUMENT, what, "%s has a component that is not a number",
           what);
  return vector;
}

mvs_comparison public_comparison(const Comparison &c) {
  mvs_comparison out = {};
  out.struct_size = sizeof out;
  out.same_mesh = c.same_mesh ? 1 : 0;
  out.node_rms = c.node_rms;
  out.node_max = c.node_max;
  out.surface_rms = c.surface_rms;
  out.surface_max = c.surface_max;
  out.node_rms_registered = c.node_rms_registered;
  out.node_max_registered = c.node_max_registered;
  out.surface_rms_registered = c.surface_rms_registered;
  out.surface_max_registered = c.surface_max_registered;
  std::copy(c.registration.begin(), c.registration.end(), out.registration);
  return out;
}

}  // namespace

namespace {

mvs_chord_info public_chord(const mvs_snapshot &s, uint32_t index) {
  const Chord &chord = s.model->valve.chords[index];
  const ChordMeasures &measured = s.chords();
  const ChordEnds &ends = s.chord_ends();
  mvs_chord_info info = {};
  info.struct_size = sizeof info;
  info.kind = static_cast<mvs_chord_kind>(chord.kind);
  info.id = chord.id;
  info.name = chord.name.c_str();
  info.heads = ends.heads[index].c_str();
  info.scallops = ends.scallops[index].c_str();
  info.length = (s.state.x[chord.b] - s.state.x[chord.a]).norm();
  info.rest_length = chord.rest_length;
  info.strain = measured.strain[index];
  info.tension = measured.tension[index];
  info.flags = measured.flags[index];
  return info;
}

mvs_region_measures public_region(const mvs_snapshot &s, uint32_t index) {
  const RegionMap &map = s.region_map();
  const RegionMeasures &m = s.regions()[index];
  mvs_region_measures out = {};
  out.struct_size = sizeof out;
  out.kind = index < map.scallops() ? MVS_REGION_SCALLOP : MVS_REGION_COMMISSURE;
  out.name = map.name(index).c_str();
  out.coaptation_area = m.coaptation_area;
  out.coaptation_length_mean = m.coaptation_length_mean;
  out.coaptation_length_min = m.coaptation_length_min;
  out.orifice_area = m.orifice_area;
  out.gap = m.gap;
  out.billow_height = m.billow_height;
  out.billow_volume = m.billow_volume;
  out.tenting_height = m.tenting_height;
  out.tenting_volume = m.tenting_volume;
  return out;
}

mvs_orifice_part public_part(const OrificePart &part) {
  mvs_orifice_part out = {};
  out.struct_size = sizeof out;
  out.triangles = part.triangles;
  out.area = part.area;
  out.gap = part.gap;
  std::copy(part.centroid.begin(), part.centroid.end(), out.centroid);
  std::copy(part.direction.begin(), part.direction.end(), out.direction);
  out.anterior = part.anterior.c_str();
  out.posterior = part.posterior.c_str();
  out.commissures = part.commissures.c_str();
  return out;
}

}  // namespace

extern "C" {

void mvs_snapshot_retain(const mvs_snapshot *snapshot) {
  if (snapshot) snapshot->retain();
}

void mvs_snapshot_release(const mvs_snapshot *snapshot) {
  if (snapshot) snapshot->release();
}

mvs_result mvs_snapshot_get_hash(const mvs_snapshot *snapshot, uint64_t hash[2]) {
  return at_boundary([&] {
    must_point(snapshot, "snapshot");
    must_point(hash, "hash");
    const std::array<uint64_t, 2> value = hash_of(*snapshot->model, snapshot->state);
    std::copy(value.begin(), value.end(), hash);
  });
}

const char *mvs_snapshot_get_name(const mvs_snapshot *snapshot) {
  return snapshot ? snapshot->model->valve.name.c_str() : "";
}

mvs_result mvs_snapshot_get_load(const mvs_snapshot *snapshot, mvs_load_case *load) {
  return at_boundary([&] {
    must_point(snapshot, "snapshot");
    write_struct(load, public_load(snapshot->state.load), "load");
  });
}

mvs_result mvs_snapshot_get_rest(const mvs_snapshot *snapshot, mvs_rest *rest) {
  return at_boundary([&] {
    must_point(snapshot, "snapshot");
    const double tolerance = snapshot->state.rest_tolerance;
    write_struct(rest, mvs_rest{sizeof(mvs_rest), tolerance > 0, tolerance}, "rest");
  });
}

mvs_result mvs_snapshot_get_stability(const mvs_snapshot *snapshot, mvs_stability *stability) {
  return at_boundary([&] {
    must_point(snapshot, "snapshot");
    checked_struct_size(stability, "stability");
    const Stability &found = snapshot->stability();
    write_struct(stability,
                 mvs_stability{sizeof(mvs_stability), found.is_stable, found.stiffness, found.rate},
                 "stability");
  });
}

mvs_result mvs_snapshot_get_chord(const mvs_snapshot *snapshot, uint32_t index,
                                  mvs_chord_info *chord) {
  return at_boundary([&] {
    must_point(snapshot, "snapshot");
    checked_struct_size(chord, "chord");
    const std::vector<Chord> &chords = snapshot->model->valve.chords;
    MVS_MUST(index < chords.size(), MVS_E_ARGUMENT, "index",
             "index is %u, but the valve has %zu chords", index, chords.size());
    write_struct(chord, public_chord(*snapshot, index), "chord");
  });
}

mvs_result mvs_snapshot_get_region_count(const mvs_snapshot *snapshot, uint32_t *count) {
  return at_boundary([&] {
    must_point(snapshot, "snapshot");
    must_point(count, "count");
    *count = static_cast<uint32_t>(snapshot->region_map().size());
  });
}

mvs_result mvs_snapshot_get_region(const mvs_snapshot *snapshot, uint32_t index,
                                   mvs_region_measures *region) {
  return at_boundary([&] {
    must_point(snapshot, "snapshot");
    checked_struct_size(region, "region");
    const size_t count = snapshot->region_map().size();
    MVS_MUST(index < count, MVS_E_ARGUMENT, "index", "index is %u, but the valve has %zu regions",
             index, count);
    write_struct(region, public_region(*snapshot, index), "region");
  });
}

mvs_result mvs_snapshot_get_orifice_part_count(const mvs_snapshot *snapshot, uint32_t *count) {
  return at_boundary([&] {
    must_point(snapshot, "snapshot");
    must_point(count, "count");
    *count = static_cast<uint32_t>(snapshot->orifice_parts().parts.size());
  });
}

mvs_result mvs_snapshot_get_orifice_part(const mvs_snapshot *snapshot, uint32_t index,
                                         mvs_orifice_part *part) {
  return at_boundary([&] {
    must_point(snapshot, "snapshot");
    checked_struct_size(part, "part");
    const std::vector<OrificePart> &parts = snapshot->orifice_parts().parts;
    MVS_MUST(index < parts.size(), MVS_E_ARGUMENT, "index",
             "index is %u, but the orifice has %zu parts", index, parts.size());
    write_struct(part, public_part(parts[index]), "part");
  });
}

mvs_result mvs_snapshot_measure(const mvs_snapshot *snapshot, mvs_measures *measures) {
  return at_boundary([&] {
    must_point(snapshot, "snapshot");
    checked_struct_size(measures, "measures");
    write_struct(measures, snapshot->measures(), "measures");
  });
}

mvs_result mvs_snapshot_measure_groups(const mvs_snapshot *snapshot, mvs_measure_group_flags groups,
                                       mvs_measures *measures) {
  return at_boundary([&] {
    must_point(snapshot, "snapshot");
    checked_struct_size(measures, "measures");
    const mvs_measure_group_flags unknown = groups & ~all_measure_groups();
    MVS_MUST(unknown == 0, MVS_E_ARGUMENT, "groups",
             "groups has bits 0x%x that this version does not know: join MVS_MEASURE_GROUP_* by |",
             unknown);
    write_struct(measures, snapshot->measures(groups), "measures");
  });
}

mvs_result mvs_snapshot_compare(const mvs_snapshot *a, const mvs_snapshot *b,
                                mvs_comparison *comparison) {
  return at_boundary([&] {
    must_point(a, "a");
    must_point(b, "b");
    checked_struct_size(comparison, "comparison");
    const Comparison found = compare_shapes(*a->model, a->state.x, *b->model, b->state.x);
    write_struct(comparison, public_comparison(found), "comparison");
  });
}

mvs_result mvs_snapshot_section(const mvs_snapshot *snapshot, const double point[3],
                                const double normal[3], double *points, uint64_t capacity,
                                uint64_t *count) {
  return at_boundary([&] {
    must_point(snapshot, "snapshot");
    must_point(count, "count");
    if (capacity > 0) must_point(points, "points");
    const Vec3 at = read_vector(point, "point"), along = read_vector(normal, "normal");
    MVS_MUST(!along.isZero(0), MVS_E_ARGUMENT, "normal", "normal has no length");
    const std::vector<Vec3> found =
        plane_section(*snapshot->model, snapshot->state.x, at, along.stableNormalized());
    const size_t written = std::min<uint64_t>(capacity, found.size());
    for (size_t k = 0; k < 3 * written; ++k) points[k] = found[k / 3][k % 3];
    *count = found.size();
  });
}

mvs_result mvs_snapshot_get_frame(const mvs_snapshot *snapshot, double frame[12]) {
  return at_boundary([&] {
    must_point(snapshot, "snapshot");
    must_point(frame, "frame");
    const Frame found = valve_frame(*snapshot->model, snapshot->state.x);
    for (int k = 0; k < 3; ++k) {
      frame[k] = found.origin[k];
      for (int row = 0; row < 3; ++row) frame[3 + 3 * row + k] = found.axes(row, k);
    }
  });
}

mvs_result mvs_get_chord_limits(uint32_t kind, double *strain, double *tension) {
  return at_boundary([&] {
    must_point(strain, "strain");
    must_point(tension, "tension");
    MVS_MUST(kind <= MVS_CHORD_KIND_SUTURE, MVS_E_ARGUMENT, "kind",
             "kind is %u: it has to be one of MVS_CHORD_KIND_*", kind);
    const ChordLimits limits = chord_limits(static_cast<ChordKind>(kind));
    *strain = limits.strain;
    *tension = limits.tension;
  });
}

}  // extern "C"
