#include "valve/slack_chordae.h"

#include <algorithm>

namespace cli {
namespace {

// The id of a chord that an operation attached, else 0. A clip makes a chord as well, whose sutures
// lie between leaflets that touch: they are slack there by design.
mvs_id attached_by(const mvs_history_entry &operation) {
  const bool attaches = operation.kind == MVS_OP_CHORD_ADD || operation.kind == MVS_OP_NEOCHORD;
  return attaches ? operation.made : 0;
}

}  // namespace

std::vector<SlackChord> slack_new_chordae(const AtRest &closed) {
  if (!closed.stats.converged || closed.valve.load().pressure <= 0) return {};
  const std::vector<mvs_part> parts = closed.valve.parts(MVS_PART_CHORD);
  std::vector<SlackChord> slack;
  for (const mvs_history_entry &operation : closed.valve.history().done) {
    const mvs_id made = attached_by(operation);
    const auto part = std::find_if(parts.begin(), parts.end(),
                                   [made](const mvs_part &p) { return p.id == made; });
    if (made == 0 || part == parts.end()) continue;
    const mvs_chord_info chord = closed.valve.chord(static_cast<uint32_t>(part - parts.begin()));
    if (chord.tension == 0) slack.push_back({chord.name, chord.rest_length, chord.length});
  }
  return slack;
}

Json slack_json(const std::vector<SlackChord> &chordae) {
  Json rows = Json::array();
  for (const SlackChord &chord : chordae) {
    rows.push_back({{"name", chord.name},
                    {"rest_length_mm", 1e3 * chord.rest_length},
                    {"length_mm", 1e3 * chord.length}});
  }
  return rows;
}

}  // namespace cli
