// Checks of states and events that were read from a session file. Each throws MVS_E_FORMAT.
#pragma once

#include "history/history.h"

namespace mvs::core {

// A state fits its model.
void check_state(const ModelState &current);

// The tools and numbers of an event agree with its kind.
void check_event(const RecordedEvent &event);

}  // namespace mvs::core
