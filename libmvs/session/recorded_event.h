// Conversion of loads, solver options and tool changes to recorded events, and back.
#pragma once

#include "history/history.h"
#include "solve/solver.h"

namespace mvs::core {

inline RecordedEvent event_of(RecordedEvent::Kind kind, const SolveOptions &how) {
  RecordedEvent event;
  event.kind = kind;
  event.solver = how.solver;
  event.max_iterations = how.max_iterations;
  event.residual = how.residual;
  event.dt = how.dt;
  event.damping = how.damping;
  event.budget = how.budget;
  return event;
}

inline RecordedEvent event_of(const Load &load) {
  RecordedEvent event;
  event.pressure = load.pressure;
  event.boundary_fraction = load.boundary_fraction;
  return event;
}

// The snapshot after a load and the settle under it.
inline Snapshot after_settle(const Snapshot &start, const Load &load, const SolveOptions &how,
                             State settled) {
  State loaded = start.current.state;
  apply_event(*start.current.model, loaded, event_of(load));
  const Snapshot before = after_event(start, std::move(loaded), event_of(load));
  return after_event(before, std::move(settled), event_of(RecordedEvent::settle, how));
}

inline SolveOptions options_of(const RecordedEvent &event) {
  return {event.solver, event.max_iterations, event.residual,
          event.dt,     event.damping,        event.budget};
}

// The event tool_add, tool_move or tool_remove of a tool.
inline RecordedEvent event_of(RecordedEvent::Kind kind, const Tool &tool) {
  RecordedEvent event;
  event.kind = kind;
  event.tools = {tool};
  return event;
}

}  // namespace mvs::core
