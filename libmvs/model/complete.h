// Fills in what a valve may leave out: ids, names, scallops, fibres, thickness, lengths.
#pragma once

#include "model/valve.h"

namespace mvs::core {

// Completes a valve without faults. What is given already stays bit for bit, so that completing
// twice, or saving and loading in between, changes nothing.
void complete(Valve &valve);

}  // namespace mvs::core
