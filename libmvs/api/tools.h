// Tools come and go, for calls at work on a simulator.
#pragma once

#include <mvs/tool.h>

#include "api/simulator.h"

namespace mvs {

Id add_tool_now(mvs_sim &sim, const mvs_tool_desc &desc);
void remove_tool_now(mvs_sim &sim, Id id);

}  // namespace mvs
