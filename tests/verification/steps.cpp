// Energy and momentum balance of steps in time, with decreasing step.
#include <Eigen/Geometry>
#include <cmath>

#include "energy/total_energy.h"
#include "solve/dynamic/time_step.h"
#include "tests/model/small_valve.h"
#include "tests/solve/bench.h"
#include "tests/verification/published.h"
#include "tests/verification/study.h"

namespace mvs::core::verification {
namespace {

using test::Positions;

constexpr double pressure = 500;   // Pa, all at once on a flat disc
constexpr double duration = 2e-3;  // s, in which a wave crosses it

Model disc() {
  return test::clamped_disc(5, 12e-3, [](Valve &valve) {
    const Published law = published("neo-Hookean");
    valve.leaflets.resize(1);
    valve.leaflets[0].law = law.law;
    valve.leaflets[0].constants = law.constants;
  });
}

// The error of energy + dissipation - work at the end, relative to the largest kinetic energy.
Row balance(const char *name, SolverKind kind, double dt, double damping) {
  const Model model = disc();
  State state = initial_state(model);
  state.load.pressure = pressure;
  SolveOptions options;
  options.solver = kind;
  options.dt = dt;
  options.damping = damping;
  Solver solver(Backend::fastest);
  const double before = test::total_energy(model, state);
  double damped = 0, most = 0;
  const auto steps = std::lround(duration / dt);
  for (long k = 0; k < steps; ++k) {
    const double last = kinetic_energy(model, state.v);
    solver.step(model, state, options);
    const double now = kinetic_energy(model, state.v);
    damped += dt * damping * (last + now);  // 2 c T, by trapezes
    most = std::max(most, now);
  }
  return {name, 0, dt, test::total_energy(model, state) + damped - before, 0, most};
}

Study study_of(const std::string &name, const std::string &title) {
  Study s;
  s.name = name;
  s.title = title;
  s.level = "step, s";
  return s;
}

Study energy() {
  Study s = study_of("steps_energy", "Energy of a disc under sudden pressure");
  s.quantity = "energy + damped - work after 2 ms, J; relative to the largest kinetic energy";
  s.source = "conservation of energy";
  s.expects =
      "1: backward Euler takes energy away in proportion to its step; symplectic Euler "
      "keeps an energy that lies off by its step";
  s.tolerance = 0.05;  // at steps below those in use; what matters is that it falls
  s.order_low = 0.8;
  s.order_high = 1.2;
  for (const double dt : {4e-5, 2e-5, 1e-5, 5e-6}) {
    s.rows.push_back(balance("implicit, no damping", SolverKind::implicit_euler, dt, 0));
    s.rows.push_back(balance("implicit, damping 200 / s", SolverKind::implicit_euler, dt, 200));
  }
  // 0 would be the default damping
  for (const double dt : {8e-6, 4e-6, 2e-6, 1e-6}) {
    s.rows.push_back(balance("explicit, no damping", SolverKind::explicit_euler, dt, 1e-12));
    s.rows.push_back(balance("explicit, damping 200 / s", SolverKind::explicit_euler, dt, 200));
  }
  return s;
}

Vec3 momentum(const Model &model, const State &state) {
  Vec3 sum = Vec3::Zero();
  for (size_t i = 0; i < state.v.size(); ++i) sum += model.node_mass[i] * state.v[i];
  return sum;
}

Vec3 angular_momentum(const Model &model, const State &state) {
  Vec3 sum = Vec3::Zero();
  for (size_t i = 0; i < state.v.size(); ++i) {
    sum += model.node_mass[i] * state.x[i].cross(state.v[i]);
  }
  return sum;
}

// A valve without prescribed nodes or load, moving, rotating and vibrating.
struct Flight {
  Vec3 before, after;  // momentum
  Vec3 spin_before, spin_after;
};
// With `anew` each step computes a factor of its own, in double precision, so that its linear
// system is solved to rounding.
Flight flight(SolverKind kind, double dt, bool anew = false) {
  const Model model = test::model_of_sheet(small_valve(), {});
  State state = initial_state(model);
  test::Random random(17);
  for (size_t i = 0; i < state.v.size(); ++i) {
    state.v[i] = Vec3(0.1, -0.2, 0.15) + Vec3(5, -3, 8).cross(state.x[i]) + random.vector(0.05);
  }
  SolveOptions options;
  options.solver = kind;
  options.dt = dt;
  options.damping = 1e-12;
  Solver solver(anew ? Backend::block : Backend::fastest);
  Flight f;
  f.before = momentum(model, state);
  f.spin_before = angular_momentum(model, state);
  const auto steps = std::lround(duration / dt);
  for (long k = 0; k < steps; ++k) {
    if (anew) state.drop_cache();
    solver.step(model, state, options);
  }
  f.after = momentum(model, state);
  f.spin_after = angular_momentum(model, state);
  return f;
}

Row spin_row(const std::string &name, double dt, const Flight &f) {
  return {name, 0, dt, (f.spin_after - f.spin_before).norm(), 0, f.spin_before.norm()};
}

std::vector<Study> momenta() {
  Study exact = study_of("steps_momentum", "Momentum of a free valve without load");
  exact.quantity = "change in 2 ms, kg m/s; of the spin, kg m2/s; relative to what it was";
  exact.source = "conservation of momentum";
  exact.expects = "rounding: inner forces cancel, and the explicit step turns about where it is";
  exact.tolerance = 1e-10;
  Study drift = exact;
  drift.name = "steps_drift";
  drift.title = "Momentum of a free valve under implicit steps";
  drift.expects =
      "the linear system is solved to 1e-3 of a step's out-of-balance forces, which leave a "
      "thousandth of what they change";
  drift.tolerance = 1e-5;
  Study spin = exact;
  spin.name = "steps_spin";
  spin.title = "Spin of a free valve under implicit steps";
  spin.quantity = "change in 2 ms, kg m2/s; relative to what it was";
  spin.expects = "1: the linearised step turns about where the forces were";
  spin.tolerance = 0.01;
  spin.order_low = 0.7;
  spin.order_high = 1.3;
  Study kept = spin;
  kept.name = "steps_spin_kept";
  kept.title = "Spin of a free valve under implicit steps with a kept factor";
  kept.expects =
      "what steps_spin leaves, and a thousandth of what a step's out-of-balance forces change";
  kept.tolerance = 5e-5;
  kept.order_low = kept.order_high = 0;
  for (const SolverKind kind : {SolverKind::implicit_euler, SolverKind::explicit_euler}) {
    const bool is_explicit = kind == SolverKind::explicit_euler;
    const std::string name = is_explicit ? "explicit" : "implicit";
    for (const double dt : {2e-5, 1e-5, 5e-6}) {
      if (is_explicit && dt > 1e-5) continue;
      const Flight f = flight(kind, dt);
      (is_explicit ? exact : drift)
          .rows.push_back(
              {name + ", momentum", 0, dt, (f.after - f.before).norm(), 0, f.before.norm()});
      (is_explicit ? exact : kept).rows.push_back(spin_row(name + ", spin", dt, f));
      if (!is_explicit) spin.rows.push_back(spin_row(name + ", spin", dt, flight(kind, dt, true)));
    }
  }
  return {exact, drift, spin, kept};
}

}  // namespace

std::vector<Study> step_studies() {
  std::vector<Study> all = momenta();
  all.insert(all.begin(), energy());
  return all;
}

}  // namespace mvs::core::verification
