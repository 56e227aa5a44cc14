// Warnings about numbers that are possible but probably in another unit.
#pragma once

#include "session/simulator.h"

namespace mvs::core {

// Logs leaflets and chordae whose response to systolic pressure is implausible, and chordae of
// implausible length. With `before`, the model before an operation, those alone that the operation
// made or changed.
void log_units(const mvs_sim &sim, const Model &model, const Model *before = nullptr);

// Logs a pressure that is probably in mmHg, kPa or MPa.
void log_pressure(const mvs_sim &sim, double pressure);

}  // namespace mvs::core
