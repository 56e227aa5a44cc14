// Checks of states, events and texts that were read from a session file. Each throws MVS_E_FORMAT.
#pragma once

#include "history/history.h"

namespace mvs::core {

// A state fits its model.
void check_state(const ModelState &current);

// A name, title or operation is UTF-8.
void check_text(const std::string &text);

// The tools and numbers of an event agree with its kind.
void check_event(const RecordedEvent &event);

}  // namespace mvs::core
