// Static closures by the solver.
#include "patient/fit/closure.h"

#include "base/error.h"
#include "solve/static/mesh_hierarchy.h"

namespace mvs::core {
namespace {

// A closure from a closed valve has some ten iterations; one that wanders is given up for another
// trial of the fit.
constexpr uint32_t most_again = 150;

SolveOptions without_margins() {
  SolveOptions options;
  options.margins = false;
  return options;
}

}  // namespace

ClosedValve close_open(Solver &solver, ModelPtr model, double pressure, const Progress &progress,
                       uint32_t most_iterations) {
  ClosedValve closed{std::move(model), {}, {}};
  closed.state = initial_state(*closed.model);
  closed.state.load = {pressure, 1};
  SolveOptions options = without_margins();
  options.max_iterations = most_iterations;
  closed.stats = settle_with_mesh_hierarchy(solver, *closed.model, closed.state, options, progress);
  return closed;
}

ClosedValve close_again(Solver &solver, const ClosedValve &from, const Valve &valve) {
  ClosedValve closed{make_model(valve, from.model.get()), from.state, {}};
  closed.state.drop_cache();
  closed.state.rest_tolerance = 0;
  SolveOptions options = without_margins();
  options.max_iterations = most_again;
  closed.stats = solver.settle(*closed.model, closed.state, options, {});
  return closed;
}

bool without_divergence(const std::function<bool()> &part) {
  try {
    return part();
  } catch (const Error &error) {
    if (error.code != MVS_E_DIVERGED) throw;
    return false;
  }
}

}  // namespace mvs::core
