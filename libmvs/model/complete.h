// Default values of a valve: ids, names, scallops, fibres, thickness, lengths.
#pragma once

#include "model/valve.h"

namespace mvs::core {

// Fills in the missing values of a valid valve. Given values stay bit for bit, so that completing
// twice, or saving and loading in between, changes nothing.
void complete(Valve &valve);

}  // namespace mvs::core
