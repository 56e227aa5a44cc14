// What the host is told of numbers that can be, but are more likely in another unit than they
// should be.
#pragma once

#include "session/simulator.h"

namespace mvs::core {

// Logs tissue and chordae that no valve could live with, and chordae whose length no surgeon would
// cut.
void log_units(const mvs_sim &sim, const Model &model);

// Logs a pressure that looks like one in mmHg.
void log_pressure(const mvs_sim &sim, double pressure);

}  // namespace mvs::core
