// Steps led by hands, many in one move: a hand that moves does so at every step, and an hour of it
// has to stay small. One row holds where the hands of a run went, and how often was stepped there.
#pragma once

#include "history/history.h"

namespace mvs::core {

// The places that a hand has in a row: its position, and the axis of a rod.
size_t places_of(const Tool &tool);
size_t places_in_row(const RecordedEvent &lead);

// Steps after hands have moved; `hands` are moves of tools.
RecordedEvent lead_of(const std::vector<RecordedEvent> &hands, const RecordedEvent &step);

// Takes as many steps from the front of `more` into `run`, which they follow, as fit there; all of
// them are taken where the count of `more` becomes 0. Where memory ends nothing is changed.
void take_on(RecordedEvent &run, RecordedEvent &more);

// The same lead with a place for each hand of `last` too, a lead that it follows: two hands that
// move in turn make one run.
RecordedEvent widened(const RecordedEvent &last, RecordedEvent lead);

// Whether rows, hands and counts of a lead agree.
bool is_whole(const RecordedEvent &lead);

// Moves the tools of a state to where a row has their hands; throws MVS_E_ID where one is not
// there.
void take_row(State &state, const RecordedEvent &lead, size_t row);

}  // namespace mvs::core
