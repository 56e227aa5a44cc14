// The tangent of the Newton solver, with its follower pressure, solved for each group; differences
// of closures.
#include "patient/fit/linear_closure.h"

#include "model/chord_law.h"
#include "solve/nodes.h"
#include "solve/static/newton_system.h"

namespace mvs::core {
namespace {

// Stiffness that is added to the tangent, in that of the load (pressure times length of a node).
constexpr double damping = 1e-3;
// Step of the differences: 0.15 mm of a chord of 15 mm, far above the error of a settled valve.
constexpr double difference = 0.01;

// The derivative of the gradient of the energy by the logarithm of a rest length.
void add_length_derivative(const Valve &valve, const Chord &c, const std::vector<Vec3> &x,
                           std::vector<Vec3> &g) {
  const Vec3 d = x[c.b] - x[c.a];
  const double length = d.norm(), stretch = length / c.rest_length;
  if (stretch <= 1) return;
  const Axial at = chord_response(valve, c, stretch - 1);
  const Vec3 f = (-c.area * at.slope * stretch / length) * d;
  g[c.a] -= f;
  g[c.b] += f;
}

}  // namespace

ClosedJacobian jacobian_by_linearisation() {
  return [](const ClosedValve &closed, const std::vector<ChordGroup> &groups,
            const std::vector<SurfaceMatch> &matches) {
    const Model &model = *closed.model;
    const std::vector<Vec3> &x = closed.state.x;
    TotalEnergy energy(model);
    SolveStats unseen;
    std::vector<Vec3> g;
    energy.use_verlet_list(false);
    energy.set_pressure(closed.state.load.pressure);
    energy.set_tools({});
    energy.prepare(x, x, 0, unseen.work);
    energy.gradient(x, g, unseen.work);
    const std::unique_ptr<DirectSolver> factor = make_direct_solver(Backend::block);
    NewtonSystem system(model, energy, *factor, x);
    system.set_scale(closed.state.load.pressure, mean_area(model));
    system.assemble(Curvature::exact, unseen.work);
    double lambda = damping;
    system.factorise(lambda, unseen);
    std::vector<std::vector<double>> jacobian;
    std::vector<Vec3> step;
    for (const ChordGroup &group : groups) {
      g.assign(x.size(), Vec3::Zero());
      for (const uint32_t c : group.chords) {
        add_length_derivative(model.valve, model.valve.chords[c], x, g);
      }
      system.solve(g, true, step, unseen);
      std::vector<double> column;
      column.reserve(matches.size());
      for (const SurfaceMatch &m : matches) column.push_back(m.derivative(step));
      jacobian.push_back(std::move(column));
    }
    return jacobian;
  };
}

ClosedJacobian jacobian_by_differences(Solver &solver) {
  return [&solver](const ClosedValve &closed, const std::vector<ChordGroup> &groups,
                   const std::vector<SurfaceMatch> &matches) {
    std::vector<std::vector<double>> jacobian;
    for (const ChordGroup &group : groups) {
      Valve changed = closed.model->valve;
      scale_groups(changed, {group}, {1 + difference});
      const ClosedValve moved = close_again(solver, closed, changed);
      std::vector<double> column;
      column.reserve(matches.size());
      for (const SurfaceMatch &m : matches) {
        column.push_back((m.residual(moved.state.x) - m.residual(closed.state.x)) / difference);
      }
      jacobian.push_back(std::move(column));
    }
    return jacobian;
  };
}

}  // namespace mvs::core
