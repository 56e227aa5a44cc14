// Static closures by the solver.
#include "patient/fit/closure.h"

#include "solve/static/mesh_hierarchy.h"

namespace mvs::core {
namespace {

SolveOptions without_margins() {
  SolveOptions options;
  options.margins = false;
  return options;
}

}  // namespace

ClosedValve close_open(Solver &solver, ModelPtr model, double pressure, const Progress &progress) {
  ClosedValve closed{std::move(model), {}, {}};
  closed.state = initial_state(*closed.model);
  closed.state.load = {pressure, 1};
  closed.stats =
      settle_with_mesh_hierarchy(solver, *closed.model, closed.state, without_margins(), progress);
  return closed;
}

ClosedValve close_again(Solver &solver, const ClosedValve &from, const Valve &valve) {
  ClosedValve closed{make_model(valve, from.model.get()), from.state, {}};
  closed.state.drop_cache();
  closed.state.rest_tolerance = 0;
  closed.stats = solver.settle(*closed.model, closed.state, without_margins(), {});
  return closed;
}

}  // namespace mvs::core
