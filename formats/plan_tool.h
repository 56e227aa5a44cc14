// What was done with tools, as steps of a plan.
#pragma once

#include <optional>

#include "formats/json.h"
#include "surgery/history.h"

namespace mvs {

Json tool_json(const Move &move);

// Null where the step is of another kind; throws MVS_E_FORMAT with what is wrong.
std::optional<Move> read_tool_step(const Json &json);

}  // namespace mvs
