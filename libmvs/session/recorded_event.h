// The moves that a history keeps, from loads and solver options and back to them.
#pragma once

#include "history/history.h"
#include "solve/solver.h"

namespace mvs::core {

inline RecordedEvent move_of(RecordedEvent::Kind kind, const SolveOptions &how) {
  RecordedEvent move;
  move.kind = kind;
  move.solver = how.solver;
  move.max_iterations = how.max_iterations;
  move.residual = how.residual;
  move.dt = how.dt;
  move.damping = how.damping;
  move.budget = how.budget;
  return move;
}

inline SolveOptions options_of(const RecordedEvent &move) {
  return {move.solver, move.max_iterations, move.residual, move.dt, move.damping, move.budget};
}

inline RecordedEvent move_of(const Load &load) {
  RecordedEvent move;
  move.pressure = load.pressure;
  move.boundary_fraction = load.boundary_fraction;
  return move;
}

// What is done with a tool.
inline RecordedEvent move_of(RecordedEvent::Kind kind, const Tool &tool) {
  RecordedEvent move;
  move.kind = kind;
  move.tool = {tool};
  return move;
}

}  // namespace mvs::core
