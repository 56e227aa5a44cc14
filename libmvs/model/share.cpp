// Arrays of two models that hold the same become one: what undo levels cost is what differs.
#include "model/model.h"

namespace mvs::core {
namespace {

void share(Rows &rows, const Rows &other) {
  rows.start.share_with(other.start);
  rows.items.share_with(other.items);
}

void share(Valve &valve, const Valve &other) {
  valve.rest.share_with(other.rest);
  valve.open.share_with(valve.rest) || valve.open.share_with(other.open);
  valve.loaded.share_with(valve.rest) || valve.loaded.share_with(other.loaded);
  valve.origin.share_with(other.origin);
  valve.triangles.share_with(other.triangles);
  valve.triangle_leaflet.share_with(other.triangle_leaflet);
  valve.triangle_scallop.share_with(other.triangle_scallop);
  valve.triangle_thickness.share_with(other.triangle_thickness);
  valve.triangle_fibre.share_with(other.triangle_fibre);
  valve.annulus.share_with(other.annulus);
  valve.leaflets.share_with(other.leaflets);
  valve.scallops.share_with(other.scallops);
  valve.chords.share_with(other.chords);
  valve.heads.share_with(other.heads);
  valve.rings.share_with(other.rings);
  valve.curves.share_with(other.curves);
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
  state.cache.data.share_with(other.cache.data);
}

}  // namespace mvs::core
