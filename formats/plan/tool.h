// What was done with tools, as steps of a plan.
#pragma once

#include <optional>

#include "formats/text/json.h"
#include "history/history.h"

namespace mvs::core {

Json tool_json(const RecordedEvent &move);

// Steps led by hands: whose, and where they were, the options of the steps being the caller's.
Json lead_json(const RecordedEvent &move);
RecordedEvent read_lead(const Json &json);

// Null where the step is of another kind; throws MVS_E_FORMAT with what is wrong.
std::optional<RecordedEvent> read_tool_step(const Json &json);

}  // namespace mvs::core
