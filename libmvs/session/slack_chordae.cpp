#include "session/slack_chordae.h"

#include <mvs/op.h>

#include <algorithm>

#include "session/snapshot.h"

namespace mvs::core {
namespace {

// The chord that an operation attached, else 0. A clip makes chordae as well, the sutures between
// leaflets that touch: they are slack there by design.
Id attached_by(const HistoryEntry &entry) {
  const mvs_op_kind kind = entry.op.get()->kind;
  const bool attaches = kind == MVS_OP_CHORD_ADD || kind == MVS_OP_NEOCHORD;
  return attaches ? entry.made : 0;
}

}  // namespace

void log_slack_chordae(const mvs_sim &sim, const mvs_snapshot &closed) {
  std::vector<Id> attached;
  for (const auto &entry : closed.value.history.past.items()) {
    if (const Id made = attached_by(**entry)) attached.push_back(made);
  }
  if (attached.empty()) return;
  const std::vector<Chord> &chordae = closed.model->valve.chords;
  for (const Id id : attached) {
    const auto chord =
        std::find_if(chordae.begin(), chordae.end(), [id](const Chord &c) { return c.id == id; });
    if (chord == chordae.end()) continue;
    if (closed.chords().tension[static_cast<size_t>(chord - chordae.begin())] > 0) continue;
    const double length = (closed.state.x[chord->b] - closed.state.x[chord->a]).norm();
    sim.log(MVS_LOG_WARNING,
            "chord %s carries no force in the closed valve: its rest length is %.2f mm, its ends "
            "are %.2f mm apart; only a rest length below that holds the leaflet",
            chord->name.c_str(), 1e3 * chord->rest_length, 1e3 * length);
  }
}

}  // namespace mvs::core
