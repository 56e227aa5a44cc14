// The Verlet list of the broad phase against brute force, over many steps.
#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "collision/broad_phase.h"
#include "tests/collision/brute_force.h"
#include "tests/collision/pairs.h"
#include "tests/short_run.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

// The Verlet list is kept from one build to the next, and the pairs that it checks again depend on
// all earlier builds: the result must not depend on them, for any motion and any shortened step.
void check_on_the_way(const Plates &plates, bool keep_near) {
  Random random(8);
  BroadPhase broad_phase(plates.model);
  broad_phase.use_verlet_list(keep_near);
  Positions x = wavy(plates, random);
  std::vector<size_t> found;
  const int every = short_run() ? 11 : 1;  // every kind of round occurs
  for (int round = 0; round < 96; ++round) {
    const StepMotion mode = round % 5 == 4 ? StepMotion::independent : StepMotion::together;
    const double slack = round % 7 == 6 ? 0.1e-3 : 0.02e-3;
    // slow; plate against plate; with a few fast nodes; a part of the sheet; everything fast; no
    // motion
    const int kind = (round / 8) % 6;
    const Vec3 drift = random.vector(kind == 4 ? 0.4e-3 : 0.03e-3);
    Positions step(x.size(), Vec3::Zero());
    for (size_t i = 0; i < x.size(); ++i) {
      if (kind == 5 || (kind == 3 && i % plates.upper > plates.upper / 4)) continue;
      step[i] = drift + random.vector(0.02e-3);
      if (kind == 1) step[i] = Vec3(0, 0, (i < x.size() / 2) == (round > 48) ? 0.1e-3 : -0.1e-3);
      if (kind == 2 && i % 40 == 0) step[i] += random.vector(0.6e-3);
    }
    Positions to = moved(x, 1, step);
    broad_phase.build(x, to, slack, mode);
    CAPTURE(round);
    if (round % every == 0) check_pairs(plates.model, broad_phase, {x, to, slack, mode});
    for (size_t i = 0; i < x.size(); i += 13) to[i] = x[i] + random(0, 1) * step[i];
    broad_phase.build(x, to, slack, mode);
    if (round % every == 0) check_pairs(plates.model, broad_phase, {x, to, slack, mode});
    found.push_back(broad_phase.barrier_candidates().size() +
                    broad_phase.barrier_edge_candidates().size());
    // a part of the motion, as of a shortened step
    x = moved(x, random(0.3, 1), step);
  }
  std::sort(found.begin(), found.end());
  CHECK(std::unique(found.begin(), found.end()) - found.begin() > 20);
}

}  // namespace

TEST_CASE("candidates_do_not_depend_on_earlier_positions") {
  const Plates plates = two_plates(5, 6.25e-3, 3e-3, false, [](Valve &) {});
  check_on_the_way(plates, true);
  check_on_the_way(plates, false);
}

// So fine that pairs near each other at rest have shorter barriers, and no coordinate is a round
// number.
TEST_CASE("candidates_of_a_fine_mesh_do_not_depend_on_earlier_positions") {
  const Plates plates = two_plates(5, 1.875e-3, 3e-3, false, [](Valve &valve) {
    Random random(3);
    for (auto &place : valve.rest.edit()) place += random.vector(0.03e-3);
  });
  check_on_the_way(plates, true);
  check_on_the_way(plates, false);
}

// No block of one plate is near the other when the Verlet list is built; all blocks come near
// later, by a third of the skin a step.
TEST_CASE("pairs_that_approach_from_a_distance_are_found") {
  const Plates plates = plates_for_steps();
  Random random(5);
  BroadPhase broad_phase(plates.model);
  Positions x = wavy(plates, random);
  const Vec3 step(0.03e-3, 0, -0.1e-3);
  for (size_t i = x.size() / 2; i < x.size(); ++i) x[i] -= 60 * step;
  size_t first = 0;
  for (int k = 0; k < 60; ++k) {
    Positions to = x;
    for (size_t i = x.size() / 2; i < x.size(); ++i) to[i] += step;
    broad_phase.build(x, to, 0.02e-3);
    if (k == 0) first = broad_phase.contact_candidates().size();
    CAPTURE(k);
    if (k % 6 == 5) check_pairs(plates.model, broad_phase, {x, to, 0.02e-3, StepMotion::together});
    x = to;
  }
  CHECK(broad_phase.contact_candidates().size() > first + 30);
}
