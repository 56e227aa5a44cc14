// Warnings about chordae that an operation attached in vain.
#pragma once

#include "session/simulator.h"

namespace mvs::core {

// Logs the chordae that the operations of a valve's history attached and that carry no force, in
// the order of the operations. `closed` is at rest under pressure: an open valve hangs on no chord.
void log_slack_chordae(const mvs_sim &sim, const mvs_snapshot &closed);

}  // namespace mvs::core
