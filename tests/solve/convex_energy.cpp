// Energy of convex tools: a step ends at no more energy than it starts with, once the hand is where
// it leads. What a hand adds is the energy of its own spring when it moves.
#include <doctest/doctest.h>

#include <algorithm>

#include "energy/forces.h"
#include "tests/solve/bench.h"
#include "tests/solve/convex_tools.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

// The bound of a step is 1e-12 of the energy at its start (settings::implicit::energy_rounding);
// here energies are sums in another order, of some thousand terms.
constexpr double rounding = 1e-9;

// A tool above a disc, without pressure: all of the energy has a potential.
struct Bench {
  explicit Bench(int kind) {
    Random random(kind + 1);
    add_tool(disc, state, random_tool(random, kind, Vec3(1e-3, 0.5e-3, 9e-3)));
  }
  double energy() const {
    double sum = evaluate_forces(disc, state).energy;
    for (size_t i = 0; i < state.v.size(); ++i)
      sum += 0.5 * disc.node_mass[i] * state.v[i].squaredNorm();
    return sum;
  }
  // 1 m/s, and a turn of 5 degrees.
  void move_hand() {
    state.tools[0].position.z() -= 1e-3;
    state.tools[0].axis.x() += 0.02;
  }
  // The energy that a step makes while the hand rests.
  double step() {
    const double before = energy();
    solver.step(disc, state, {});
    return energy() - before;
  }

  Model disc = clamped_disc(8, 12e-3, [](Valve &) {});
  State state = initial_state(disc);
  Solver solver{Backend::fastest};
};

}  // namespace

TEST_CASE("a_step_after_a_convex_tool_was_moved_makes_no_energy") {
  for (int kind = 0; kind < tool_kinds; ++kind) {
    CAPTURE(kind);
    Bench bench(kind);
    double most = 0, created = 0;
    bool touches = false;
    for (int k = 0; k < 15; ++k) {
      bench.move_hand();
      most = std::max(most, bench.energy());
      created = std::max(created, bench.step());
      touches = touches ||
                clearance(bench.disc, bench.state.x, bench.state.tools[0]) < tool_range(bench.disc);
    }
    CHECK(touches);
    CHECK(most > 1e-5);
    CHECK(created <= rounding * most);
  }
}

TEST_CASE("a_hand_that_holds_still_gives_no_energy") {
  for (int kind = 0; kind < tool_kinds; ++kind) {
    CAPTURE(kind);
    Bench bench(kind);
    for (int k = 0; k < 15; ++k) {
      bench.move_hand();
      bench.step();
    }
    const double most = bench.energy();
    double created = 0;
    for (int k = 0; k < 150; ++k) created = std::max(created, bench.step());
    MESSAGE("kind " << kind << ": " << most << " J at the stop, at most " << created
                    << " J created in a step");
    CHECK(most > 1e-5);
    CHECK(created <= rounding * most);
  }
}
