// Returns the arrays of a snapshot as views of its memory, without copies.
#include "api/structs.h"
#include "session/snapshot.h"

namespace {

using namespace mvs::core;

mvs_view view_of(const void *data, size_t count, uint32_t components, uint32_t type,
                 uint64_t value_size) {
  return {data, count, components, type, components * value_size};
}
mvs_view view_of(const std::vector<Vec3> &v) {
  return view_of(v.data(), v.size(), 3, MVS_TYPE_F64, 8);
}
mvs_view view_of(const std::vector<double> &v) {
  return view_of(v.data(), v.size(), 1, MVS_TYPE_F64, 8);
}
template <size_t components>
mvs_view view_of(const std::vector<std::array<double, components>> &v) {
  return view_of(v.data(), v.size(), components, MVS_TYPE_F64, 8);
}
template <size_t components>
mvs_view view_of(const std::vector<std::array<uint32_t, components>> &v) {
  return view_of(v.data(), v.size(), components, MVS_TYPE_U32, 4);
}
mvs_view view_of(const std::vector<uint32_t> &v) {
  return view_of(v.data(), v.size(), 1, MVS_TYPE_U32, 4);
}
mvs_view view_of(const std::vector<uint64_t> &v) {
  return view_of(v.data(), v.size(), 1, MVS_TYPE_U64, 8);
}
template <Enum Kind>
mvs_view view_of(const std::vector<Kind> &v) {
  constexpr uint32_t type = sizeof(Kind) == 1 ? MVS_TYPE_U8 : MVS_TYPE_U32;
  return view_of(v.data(), v.size(), 1, type, sizeof(Kind));
}
mvs_view view_of(const std::vector<uint8_t> &v) {
  return view_of(v.data(), v.size(), 1, MVS_TYPE_U8, 1);
}

// Empty if the number is not an array of the group.
using Viewed = std::optional<mvs_view>;

Viewed node_view(const mvs_snapshot &s, uint32_t which) {
  switch (which) {
    case MVS_ARRAY_NODE_POSITION:
      return view_of(s.state.x);
    case MVS_ARRAY_NODE_REST:
      return view_of(s.model->valve.rest);
    case MVS_ARRAY_NODE_OPEN:
      return view_of(s.model->valve.open);
    case MVS_ARRAY_NODE_ORIGIN:
      return view_of(s.model->valve.origin);
    case MVS_ARRAY_NODE_LOADED:
      return view_of(s.model->valve.loaded);
    case MVS_ARRAY_NODE_VELOCITY:
      return view_of(s.state.v);
    case MVS_ARRAY_NODE_KIND:
      return view_of(s.model->topology.node_kind.get());
    case MVS_ARRAY_NODE_FORCE:
      return view_of(s.forces().total);
    case MVS_ARRAY_NODE_CONTACT_FORCE:
      return view_of(s.forces().contact);
    case MVS_ARRAY_NODE_COAPTATION:
      return view_of(s.coaptation().distance);
    case MVS_ARRAY_NODE_STRAIN_FIBRE:
      return view_of(s.tensors().node_strain);
    case MVS_ARRAY_NODE_STRESS_FIBRE:
      return view_of(s.tensors().node_stress);
    case MVS_ARRAY_NODE_MODE:
      return view_of(s.stability().mode);
    default:
      return {};
  }
}

Viewed triangle_view(const mvs_snapshot &s, uint32_t which) {
  const Valve &valve = s.model->valve;
  switch (which) {
    case MVS_ARRAY_TRIANGLE_NODES:
      return view_of(valve.triangles.get());
    case MVS_ARRAY_TRIANGLE_LEAFLET:
      return view_of(valve.triangle_leaflet);
    case MVS_ARRAY_TRIANGLE_SCALLOP:
      return view_of(valve.triangle_scallop);
    case MVS_ARRAY_TRIANGLE_THICKNESS:
      return view_of(valve.triangle_thickness);
    case MVS_ARRAY_TRIANGLE_FIBRE:
      return view_of(valve.triangle_fibre);
    case MVS_ARRAY_TRIANGLE_STRETCH:
      return view_of(s.strain().stretch);
    case MVS_ARRAY_TRIANGLE_STRESS:
      return view_of(s.strain().stress);
    case MVS_ARRAY_TRIANGLE_STRAIN_FIBRE:
      return view_of(s.tensors().strain);
    case MVS_ARRAY_TRIANGLE_STRESS_FIBRE:
      return view_of(s.tensors().stress);
    case MVS_ARRAY_TRIANGLE_DIRECTION:
      return view_of(s.tensors().direction);
    case MVS_ARRAY_TRIANGLE_COAPTED:
      return view_of(s.coaptation().share);
    default:
      return {};
  }
}

Viewed chord_view(const mvs_snapshot &s, uint32_t which) {
  switch (which) {
    case MVS_ARRAY_CHORD_NODES:
      return view_of(s.tables().chord_nodes);
    case MVS_ARRAY_CHORD_REST_LENGTH:
      return view_of(s.tables().chord_rest_length);
    case MVS_ARRAY_CHORD_KIND:
      return view_of(s.tables().chord_kind);
    case MVS_ARRAY_CHORD_STRAIN:
      return view_of(s.chords().strain);
    case MVS_ARRAY_CHORD_TENSION:
      return view_of(s.chords().tension);
    case MVS_ARRAY_CHORD_ID:
      return view_of(s.tables().chord_id);
    case MVS_ARRAY_CHORD_YOUNG:
      return view_of(s.tables().chord_young);
    case MVS_ARRAY_CHORD_AREA:
      return view_of(s.tables().chord_area);
    case MVS_ARRAY_CHORD_FLAGS:
      return view_of(s.chords().flags);
    case MVS_ARRAY_CHORD_LAW:
      return view_of(s.tables().chord_law);
    case MVS_ARRAY_CHORD_CONSTANTS:
      return view_of(s.tables().chord_constants);
    default:
      return {};
  }
}

Viewed other_view(const mvs_snapshot &s, uint32_t which) {
  switch (which) {
    case MVS_ARRAY_LEAFLET_LAW:
      return view_of(s.tables().leaflet_law);
    case MVS_ARRAY_LEAFLET_CONSTANTS:
      return view_of(s.tables().leaflet_constants);
    case MVS_ARRAY_ANNULUS_NODES:
      return view_of(s.model->valve.annulus);
    case MVS_ARRAY_ANNULUS_FORCE:
      return view_of(s.annulus_force());
    case MVS_ARRAY_FREE_EDGE_NODES:
      return view_of(s.tables().free_edge_nodes);
    case MVS_ARRAY_HEAD_NODES:
      return view_of(s.tables().head_nodes);
    case MVS_ARRAY_HEAD_FORCE:
      return view_of(s.chords().head_force);
    case MVS_ARRAY_CURVE_POINTS:
      return view_of(s.tables().curve_points);
    case MVS_ARRAY_CURVE_START:
      return view_of(s.tables().curve_start);
    case MVS_ARRAY_RING_POINTS:
      return view_of(s.tables().ring_points);
    case MVS_ARRAY_RING_START:
      return view_of(s.tables().ring_start);
    case MVS_ARRAY_RING_KIND:
      return view_of(s.tables().ring_kind);
    case MVS_ARRAY_RING_ID:
      return view_of(s.tables().ring_id);
    case MVS_ARRAY_ORIFICE_VERTICES:
      return view_of(s.orifice().vertices);
    case MVS_ARRAY_ORIFICE_TRIANGLES:
      return view_of(s.orifice().triangles);
    case MVS_ARRAY_ORIFICE_PART:
      return view_of(s.orifice_parts().of_triangle);
    case MVS_ARRAY_VALVE_CONSTANTS:
      return view_of(s.tables().valve_constants.data(), 4, 1, MVS_TYPE_F64, 8);
    case MVS_ARRAY_STATE_TIME:
      return view_of(&s.state.time, 1, 1, MVS_TYPE_F64, 8);
    default:
      return {};
  }
}

}  // namespace

extern "C" mvs_result mvs_snapshot_get_array(const mvs_snapshot *snapshot, uint32_t which,
                                             mvs_view *view) {
  return at_boundary([&] {
    must_point(snapshot, "snapshot");
    must_point(view, "view");
    Viewed found = node_view(*snapshot, which);
    if (!found) found = triangle_view(*snapshot, which);
    if (!found) found = chord_view(*snapshot, which);
    if (!found) found = other_view(*snapshot, which);
    MVS_MUST(found, MVS_E_ARGUMENT, "which", "which is %u: no array of a snapshot has this number",
             which);
    *view = *found;
  });
}
