// Checks of states, events and texts that were read from a session file. Each throws MVS_E_FORMAT.
#pragma once

#include "formats/hdf5/tree.h"
#include "history/history.h"

namespace mvs::core {

// The file has the arrays of a session alone.
void check_arrays(const H5Tree &tree);

// A state fits its model.
void check_state(const ModelState &current);

// Every group has a number below the next one and a name; checkpoints have names, each its own.
void check_history(const History &history);

// A name, title or operation is UTF-8 without control characters.
void check_text(const std::string &text);

// The tools and numbers of an event agree with its kind.
void check_event(const RecordedEvent &event);

}  // namespace mvs::core
