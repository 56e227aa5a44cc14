// A live step, after a few warm-up steps, allocates no memory and makes no system call: counted by
// a malloc of our own, and shown by a process that is killed on any other call.
#include <mvs/experimental.h>
#include <mvs/mvs.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>

#include "check.h"
#include "tests/fault/counted.h"
#include "tests/founding.h"

namespace {

[[maybe_unused]] constexpr int warm_up = 50;

mvs_sim *closed_valve() {
  mvs_sim *sim = nullptr;
  const mvs_load_case systole = {sizeof systole, 0, MVS_SYSTOLE_PA, 1};
  MUST(mvs_create(nullptr, &sim));
  MUST(generate_founding(sim));
  MUST(mvs_set_load(sim, &systole));
  MUST(mvs_settle(sim, nullptr, nullptr));
  return sim;
}

// Pressures under which the leaflets part and meet again, ten times in a thousand steps.
void beat(mvs_sim *sim, int step) {
  const double share = 0.55 + 0.45 * std::cos(2 * 3.14159265358979 * step / 100);
  const mvs_load_case load = {sizeof load, 0, MVS_SYSTOLE_PA * share, 1};
  MUST(mvs_set_load(sim, &load));
}

mvs_profile profile_of(mvs_sim *sim) {
  mvs_profile profile = {};
  profile.struct_size = sizeof profile;
  MUST(mvs_get_profile(sim, &profile));
  return profile;
}

mvs_stats stats_of(mvs_sim *sim) {
  mvs_stats stats = {};
  stats.struct_size = sizeof stats;
  MUST(mvs_get_stats(sim, &stats));
  return stats;
}

#if HAS_OWN_MALLOC
void steps_allocate_nothing(uint32_t solver) {
  mvs_sim *sim = closed_valve();
  mvs_step_options how = {};
  how.struct_size = sizeof how;
  how.solver = solver;
  long made = 0;
  uint32_t least = UINT32_MAX, most = 0;
  for (int k = 0; k < warm_up + 1000; ++k) {
    if (k % 5 == 0) beat(sim, k);
    const long before = allocations;
    MUST(mvs_step(sim, &how));
    if (k < warm_up) continue;
    made += allocations - before;
    const uint32_t pairs = stats_of(sim).contact_pairs;
    least = pairs < least ? pairs : least;
    most = pairs > most ? pairs : most;
  }
  std::printf("solver %u: %ld allocations in 1000 steps, %u to %u contacts\n", solver, made, least,
              most);
  CHECK(made == 0);
  CHECK(least < most);
  mvs_destroy(sim);
}

// A held snapshot keeps its memory; after its release, steps allocate nothing again.
void a_snapshot_costs_a_step_or_two(void) {
  mvs_sim *sim = closed_valve();
  const mvs_snapshot *held = nullptr;
  for (int k = 0; k < warm_up; ++k) MUST(mvs_step(sim, nullptr));
  MUST(mvs_get_snapshot(sim, &held));
  const hash128 seen = snapshot_hash(held);
  beat(sim, 25);
  for (int k = 0; k < 100; ++k) MUST(mvs_step(sim, nullptr));
  CHECK(same_hash(seen, snapshot_hash(held)));
  CHECK(!same_hash(seen, sim_hash(sim)));
  mvs_snapshot_release(held);
  for (int k = 0; k < 3; ++k) MUST(mvs_step(sim, nullptr));
  const long before = allocations;
  for (int k = 0; k < 10; ++k) MUST(mvs_step(sim, nullptr));
  CHECK(allocations == before);
  mvs_destroy(sim);
}

uint64_t plan_size(mvs_sim *sim) {
  const mvs_snapshot *now = nullptr;
  uint64_t size = 0;
  MUST(mvs_get_snapshot(sim, &now));
  MUST(mvs_write_plan(now, nullptr, nullptr, 0, &size));
  mvs_snapshot_release(now);
  return size;
}

// A host that sets the present load before each step; moving, and at rest.
void the_same_load_records_and_allocates_nothing(void) {
  for (const int phase : {0, 25}) {
    mvs_sim *sim = closed_valve();
    for (int k = 0; k < warm_up; ++k) {
      beat(sim, phase);
      MUST(mvs_step(sim, nullptr));
    }
    const uint64_t size = plan_size(sim);
    for (int k = 0; k < 3; ++k) MUST(mvs_step(sim, nullptr));
    const long before = allocations;
    for (int k = 0; k < 100; ++k) {
      beat(sim, phase);
      MUST(mvs_step(sim, nullptr));
    }
    CHECK(allocations == before);
    CHECK(plan_size(sim) <= size + 2);                  // digits of the number of steps
    CHECK(phase != 0 || stats_of(sim).converged == 1);  // the valve that rested stays at rest
    mvs_destroy(sim);
  }
}
#endif

#if HAS_SECCOMP
void steps_call_no_system(void) {
  mvs_sim *sim = closed_valve();
  for (int k = 0; k < 2 * warm_up; ++k) {
    if (k % 5 == 0) beat(sim, k);
    MUST(mvs_step(sim, nullptr));
  }
  beat(sim, 50);
  CHECK(computes_only([&] {
    int failed = 0;
    for (int k = 0; k < 100; ++k) failed += mvs_step(sim, nullptr) != MVS_OK;
    return failed == 0;
  }));
  mvs_destroy(sim);
}
#endif

// An idle valve falls asleep; any change wakes it.
void a_valve_at_rest_sleeps(void) {
  mvs_sim *sim = closed_valve();
  MUST(mvs_step(sim, nullptr));
  CHECK(profile_of(sim).skipped & MVS_SKIPPED_STEP);
  beat(sim, 25);
  MUST(mvs_step(sim, nullptr));
  CHECK(!(profile_of(sim).skipped & MVS_SKIPPED_STEP));
  beat(sim, 0);
  int steps = 0;
  do {
    MUST(mvs_step(sim, nullptr));
  } while (!(profile_of(sim).skipped & MVS_SKIPPED_STEP) && ++steps < 5000);
  std::printf("asleep after %d steps\n", steps);
  CHECK(steps < 5000);
  CHECK(stats_of(sim).residual <= 1.0001e-5);
  CHECK(stats_of(sim).kinetic == 0);
  mvs_destroy(sim);
}

}  // namespace

int main(void) {
  a_valve_at_rest_sleeps();
#if HAS_OWN_MALLOC
  steps_allocate_nothing(MVS_SOLVER_IMPLICIT);
  steps_allocate_nothing(MVS_SOLVER_EXPLICIT);
  a_snapshot_costs_a_step_or_two();
  the_same_load_records_and_allocates_nothing();
#endif
#if HAS_SECCOMP
  steps_call_no_system();
#endif
  return finish("live");
}
