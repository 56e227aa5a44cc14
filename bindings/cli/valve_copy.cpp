// Every array of the snapshot goes back as it came; only what was edited differs.
#include "valve_copy.h"

#include <algorithm>

namespace cli {

ValveCopy::ValveCopy(mvs::Snapshot snapshot)
    : snapshot_(std::move(snapshot)),
      leaflet_parts_(snapshot_.parts(MVS_PART_LEAFLET)),
      scallop_parts_(snapshot_.parts(MVS_PART_SCALLOP)),
      chord_parts_(snapshot_.parts(MVS_PART_CHORD)),
      head_parts_(snapshot_.parts(MVS_PART_HEAD)) {
  copy_leaflets();
  copy_scallops();
  copy_chords();
  copy_heads();
}

void ValveCopy::scale_chord(const std::string &name, double factor) {
  chords_[snapshot_.find(MVS_PART_CHORD, name).index].rest_length *= factor;
}

void ValveCopy::set(mvs::Sim &sim) const {
  const double *constants = snapshot_.view<double>(MVS_VALVE_CONSTANTS).data();
  mvs_valve_desc desc = {};
  const std::string name = snapshot_.name();
  desc.name = name.c_str();
  desc.nodes = array(MVS_NODE_REST);
  desc.nodes_loaded = array(MVS_NODE_LOADED);
  desc.nodes_now = array(MVS_NODE_POSITION);
  desc.triangles = array(MVS_TRIANGLE_NODES);
  desc.triangle_leaflet = array(MVS_TRIANGLE_LEAFLET);
  desc.triangle_scallop = array(MVS_TRIANGLE_SCALLOP);
  desc.triangle_thickness = array(MVS_TRIANGLE_THICKNESS);
  desc.triangle_fibre = array(MVS_TRIANGLE_FIBRE);
  desc.annulus = array(MVS_ANNULUS_NODES);
  desc.leaflets = leaflets_.data();
  desc.leaflet_count = static_cast<uint32_t>(leaflets_.size());
  desc.scallops = scallop_names_.data();
  desc.scallop_ids = scallop_ids_.data();
  desc.scallop_count = static_cast<uint32_t>(scallop_names_.size());
  desc.chords = chords_.data();
  desc.chord_count = static_cast<uint32_t>(chords_.size());
  desc.heads = heads_.data();
  desc.head_count = static_cast<uint32_t>(heads_.size());
  desc.density = constants[0];
  desc.contact_thickness = constants[1];
  desc.contact_stiffness = constants[2];
  // in a description zero is the default, so that none is a negative number
  desc.bending_scale = constants[3] > 0 ? constants[3] : -1;
  sim.set_valve(desc);
}

mvs_array ValveCopy::array(uint32_t which) const {
  mvs_view view = {};
  mvs::must(mvs_snapshot_view(snapshot_.get(), which, &view));
  return {view.data, view.count, view.components, view.type, view.stride};
}

void ValveCopy::copy_leaflets() {
  const auto law = snapshot_.view<uint32_t>(MVS_LEAFLET_LAW);
  const auto constants = snapshot_.view<double>(MVS_LEAFLET_CONSTANTS);
  for (const mvs_part &part : leaflet_parts_) {
    mvs_leaflet_desc leaflet = {};
    leaflet.name = part.name;
    leaflet.id = part.id;
    leaflet.law = *law.row(part.index);
    const double *row = constants.row(part.index);
    leaflet.thickness = row[0];
    std::copy(row + 1, row + 9, leaflet.constants);
    leaflets_.push_back(leaflet);
  }
}

void ValveCopy::copy_scallops() {
  for (const mvs_part &part : scallop_parts_) {
    scallop_names_.push_back(part.name);
    scallop_ids_.push_back(part.id);
  }
}

void ValveCopy::copy_chords() {
  const auto nodes = snapshot_.view<uint32_t>(MVS_CHORD_NODES);
  const auto kind = snapshot_.view<uint32_t>(MVS_CHORD_KIND);
  const auto rest_length = snapshot_.view<double>(MVS_CHORD_REST_LENGTH);
  const auto young = snapshot_.view<double>(MVS_CHORD_YOUNG);
  const auto area = snapshot_.view<double>(MVS_CHORD_AREA);
  for (const mvs_part &part : chord_parts_) {
    const uint32_t c = part.index;
    mvs_chord_desc chord = {};
    chord.node_a = nodes.row(c)[0];
    chord.node_b = nodes.row(c)[1];
    chord.kind = *kind.row(c);
    chord.rest_length = *rest_length.row(c);
    chord.young = *young.row(c);
    chord.area = *area.row(c);
    chord.id = part.id;
    chord.name = part.name;
    chords_.push_back(chord);
  }
}

void ValveCopy::copy_heads() {
  const auto nodes = snapshot_.view<uint32_t>(MVS_HEAD_NODES);
  for (const mvs_part &part : head_parts_) {
    mvs_head_desc head = {};
    head.node = *nodes.row(part.index);
    head.id = part.id;
    head.name = part.name;
    heads_.push_back(head);
  }
}

}  // namespace cli
