// Sharing of equal arrays between two models or states: an undo level costs only the arrays that
// differ.
#include "model/model.h"
#include "model/valve_arrays.h"

namespace mvs::core {
namespace {

void share(Rows &rows, const Rows &other) {
  rows.start.share_with(other.start);
  rows.items.share_with(other.items);
}

void share(Valve &valve, const Valve &other) {
  for_each_array([&](auto array) { (valve.*array).share_with(other.*array); });
  valve.open.share_with(valve.rest);
  valve.loaded.share_with(valve.rest);
}

void share(Topology &topology, const Topology &other) {
  topology.edges.share_with(other.edges);
  topology.edge_triangles.share_with(other.edge_triangles);
  topology.triangle_edges.share_with(other.triangle_edges);
  topology.hinges.share_with(other.hinges);
  topology.hinge_edge.share_with(other.hinge_edge);
  share(topology.node_triangles, other.node_triangles);
  share(topology.node_chords, other.node_chords);
  topology.node_kind.share_with(other.node_kind);
  topology.fixed.share_with(other.fixed);
  topology.free_edges.share_with(other.free_edges);
}

}  // namespace

void share(Model &model, const Model &other) {
  share(model.valve, other.valve);
  share(model.topology, other.topology);
  model.rest_area.share_with(other.rest_area);
  model.rest_length.share_with(other.rest_length);
  model.vertex_area.share_with(other.vertex_area);
  model.node_mass.share_with(other.node_mass);
}

void share(State &state, const State &other) {
  state.x.share_with(other.x);
  state.v.share_with(other.v);
  for (PreconditionerKey *to : {&state.serving, &state.coming}) {
    for (const PreconditionerKey *from : {&other.serving, &other.coming}) to->x.share_with(from->x);
  }
}

}  // namespace mvs::core
