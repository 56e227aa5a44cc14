// The ranges of loads, solver options and tools, wherever they come from: a call of the interface,
// a plan, a journal or a session file. An option may also be 0, its default.
#pragma once

#include <string>

#include "base/option_checks.h"
#include "history/history.h"

namespace mvs::core {

namespace limits {

struct Range {
  double least, most;
};

// Pa, ten times the highest pressure of a heart: a larger one is in the wrong unit.
inline constexpr double pressure = 400e3;
inline constexpr Range residual = {1e-12, 1e3};  // N
inline constexpr Range dt = {1e-9, 1};           // s
inline constexpr Range damping = {1e-6, 1e6};    // 1/s
// Passes over the energy terms: a step needs four.
inline constexpr uint32_t least_budget = 4, most_budget = 10000;
// m, of a place in space, along each axis: a larger one is probably in another unit.
inline constexpr double coordinate = 10;
inline constexpr Range tool_radius = {1e-4, 0.02};      // m, of a ball or rod
inline constexpr Range rod_length = {1e-3, 0.3};        // m
inline constexpr Range tool_stiffness = {1, 1e5};       // N/m
inline constexpr Range tool_max_force = {1e-3, 100.0};  // N

}  // namespace limits

// Throws unless an option of the interface is a number in its range or zero, its default.
inline void must_be_in(double value, const limits::Range &range, const char *what) {
  must_be_in(value, range.least, range.most, what);
}

// The fault of the numbers of a tool, as a sentence; "" without one. The stiffness and force of a
// device's own tool may lie below the ranges, as its limits do.
std::string fault_of(const Tool &tool);

// The same for an event.
std::string fault_of(const RecordedEvent &event);

}  // namespace mvs::core
