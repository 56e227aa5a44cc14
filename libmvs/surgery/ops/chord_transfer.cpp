// Operation chord_transfer: moves one end of a chord.
#include "base/error.h"
#include "surgery/leaflet/site.h"
#include "surgery/surgery.h"

namespace mvs::core {
namespace {

bool is_sheet(const Model &model, uint32_t node) {
  const NodeKind kind = model.topology.node_kind[node];
  return kind == NodeKind::leaflet || kind == NodeKind::annulus;
}

uint32_t new_leaflet_end(Surgery &s, const Chord &chord, const mvs_site &site) {
  MVS_MUST(is_sheet(s.before, chord.b), MVS_E_OP, "chord " + chord.name,
           "chord_transfer: chord %s ends at a branch point, not at a leaflet: transfer the "
           "chordae that it branches into",
           chord.name.c_str());
  MVS_MUST(site.how != MVS_SITE_NONE, MVS_E_ARGUMENT, "chord_transfer.site",
           "chord_transfer: the leaflet end of chord %s needs a site to go to", chord.name.c_str());
  return node_at(s, site);
}

// Moves the head end. With its old length a chord to a farther head would be torn, one to a nearer
// head slack.
void move_to_head(const Surgery &s, Chord &chord, Id head, double length) {
  MVS_MUST(head != 0, MVS_E_ID, "chord_transfer.head",
           "chord_transfer: the head end of chord %s needs a papillary head to go to",
           chord.name.c_str());
  const uint32_t index = head_of(s, head);
  chord.a = s.valve.heads.get()[index].node;
  if (length == 0) chord.rest_length = length_like_neighbours(s, index, chord.b);
}

}  // namespace

void operate(Surgery &s, const mvs_op_chord_transfer &op) {
  MVS_MUST(op.reserved == 0, MVS_E_ARGUMENT, "chord_transfer", "chord_transfer.reserved is not 0");
  const uint32_t index = chord_of(s, op.chord);
  Chord chord = s.valve.chords.get()[index];
  if (op.end == MVS_CHORD_END_HEAD) {
    move_to_head(s, chord, op.head, op.length);
  } else {
    chord.b = new_leaflet_end(s, chord, op.site);
  }
  must_not_be_tied(s, chord.a, chord.b);
  if (op.length != 0) chord.rest_length = op.length;
  s.title = format("Transfer the %s end of chord %s, %.1f mm",
                   op.end == MVS_CHORD_END_HEAD ? "head" : "leaflet", chord.name.c_str(),
                   1e3 * chord.rest_length);
  s.valve.chords[index] = std::move(chord);
  prune_chords(s);
}

}  // namespace mvs::core
