/* A settle in slices has the bits of one call, and every end of it leaves the valve whole. */
#include "check.h"
#include "funnel.h"

#include <math.h>

typedef struct host {
  int calls, stop_at;
} host;

static int32_t count_calls(void *user, double share, double residual) {
  host *h = user;
  (void)share, (void)residual;
  return ++h->calls == h->stop_at;
}

static mvs_sim *loaded_funnel(host *h) {
  static funnel f;
  mvs_sim *sim;
  mvs_sim_desc desc = {.struct_size = sizeof desc, .progress = count_calls, .user = h};
  mvs_load_case load = funnel_load();
  make_funnel(&f);
  MUST(mvs_create(&desc, &sim));
  MUST(mvs_set_valve(sim, &f.desc));
  MUST(mvs_set_load(sim, &load));
  return sim;
}

/* Slices of one iteration, the shortest; returns their number. */
static int run_slices(mvs_sim *sim, const mvs_settle_options *options, mvs_stats *stats) {
  const hash128 before = sim_hash(sim);
  double share = 0, last = 0;
  int slices = 0;
  MUST(mvs_begin_settle(sim, options));
  while (share < 1) {
    CHECK(same_hash(before, sim_hash(sim)));
    MUST(mvs_advance_settle(sim, 0, &share, stats));
    CHECK(share >= last && share <= 1);
    last = share;
    ++slices;
  }
  MUST_FAIL(mvs_advance_settle(sim, 0, &share, stats), MVS_E_STATE, "mvs_begin_settle");
  return slices;
}

static void slices_have_the_bits_of_one_call(void) {
  static const mvs_solver solvers[] = {MVS_SOLVER_NEWTON, MVS_SOLVER_IMPLICIT, MVS_SOLVER_EXPLICIT};
  for (int k = 0; k < 3; ++k) {
    host one = {0}, many = {0};
    mvs_sim *whole = loaded_funnel(&one), *sliced = loaded_funnel(&many);
    mvs_settle_options options = {.struct_size = sizeof options, .solver = solvers[k]};
    if (k > 0) options.max_iterations = 300; /* enough to compare */
    mvs_stats expected = {.struct_size = sizeof expected}, found = expected;
    MUST(mvs_settle(whole, &options, &expected));
    const int slices = run_slices(sliced, &options, &found);
    CHECK(slices == (int)found.iterations + 1);
    CHECK(found.iterations == expected.iterations && found.iterations > 1);
    CHECK(found.converged == expected.converged && found.residual == expected.residual);
    CHECK(found.energy == expected.energy && found.contact_pairs == expected.contact_pairs);
    CHECK(many.calls == one.calls);
    CHECK(same_hash(sim_hash(whole), sim_hash(sliced)));
    mvs_destroy(whole);
    mvs_destroy(sliced);
  }
}

/* Closed over coarser meshes, and pushed by a ball, whose point is a node of the solver. */
static void slices_of_a_fine_valve_have_the_bits_of_one_call(void) {
  mvs_parametric_desc shape = {
      .struct_size = sizeof shape, .vertices = 1300, .shape = MVS_SHAPE_FOUNDING};
  mvs_load_case load = {.struct_size = sizeof load, .pressure = 16e3, .boundary_fraction = 1};
  hash128 closed[2], pushed[2];
  for (int k = 0; k < 2; ++k) {
    mvs_sim *sim;
    MUST(mvs_create(NULL, &sim));
    MUST(mvs_generate_valve(sim, &shape));
    MUST(mvs_set_load(sim, &load));
    mvs_stats stats = {.struct_size = sizeof stats};
    if (k == 0) MUST(mvs_settle(sim, NULL, &stats));
    if (k == 1) CHECK(run_slices(sim, NULL, &stats) > (int)stats.iterations);
    CHECK(stats.converged);
    closed[k] = sim_hash(sim);
    mvs_tool_desc ball = {.struct_size = sizeof ball, .kind = MVS_TOOL_KIND_BALL, .radius = 2e-3};
    mvs_id id = 0;
    ball.position[2] = 20e-3; /* above the annulus */
    MUST(mvs_add_tool(sim, &ball, &id));
    const double pushed_to[3] = {0, 0, -5e-3};
    MUST(mvs_move_tool(sim, id, pushed_to, NULL));
    mvs_settle_options few = {.struct_size = sizeof few, .max_iterations = 5};
    if (k == 0) MUST(mvs_settle(sim, &few, NULL));
    if (k == 1) run_slices(sim, &few, NULL);
    pushed[k] = sim_hash(sim);
    mvs_destroy(sim);
  }
  CHECK(same_hash(closed[0], closed[1]));
  CHECK(same_hash(pushed[0], pushed[1]));
}

static void other_calls_cancel_the_slices(void) {
  host h = {0};
  mvs_sim *sim = loaded_funnel(&h);
  mvs_load_case load = funnel_load();
  const mvs_snapshot *kept;
  double share = 7;
  MUST_FAIL(mvs_advance_settle(sim, 0, &share, NULL), MVS_E_STATE, "no settle is under way");
  CHECK(share == 7);
  MUST(mvs_cancel_settle(sim));

  MUST(mvs_get_snapshot(sim, &kept));
  for (int k = 0; k < 4; ++k) {
    MUST(mvs_begin_settle(sim, NULL));
    MUST(mvs_advance_settle(sim, 0, NULL, NULL));
    if (k == 0) MUST(mvs_set_load(sim, &load));
    if (k == 1) MUST(mvs_step(sim, NULL));
    if (k == 2) MUST(mvs_restore(sim, kept));
    if (k == 3) MUST(mvs_cancel_settle(sim));
    const hash128 before = sim_hash(sim);
    MUST_FAIL(mvs_advance_settle(sim, 0, NULL, NULL), MVS_E_STATE, "changed");
    CHECK(same_hash(before, sim_hash(sim)));
  }
  /* a call that fails changes nothing, and the settle goes on */
  MUST(mvs_begin_settle(sim, NULL));
  CHECK(mvs_undo(sim) != MVS_OK);
  MUST(mvs_advance_settle(sim, 0, NULL, NULL));
  /* a second begin replaces the first */
  MUST(mvs_begin_settle(sim, NULL));
  share = 0;
  MUST(mvs_advance_settle(sim, 3600, &share, NULL));
  CHECK(share == 1);
  mvs_snapshot_release(kept);
  mvs_destroy(sim);
}

static void wrong_arguments_and_a_cancelling_host_change_nothing(void) {
  host h = {0};
  mvs_sim *sim = loaded_funnel(&h);
  const hash128 before = sim_hash(sim);
  mvs_settle_options wrong = {.struct_size = sizeof wrong, .residual = -1};
  MUST_FAIL(mvs_begin_settle(sim, &wrong), MVS_E_ARGUMENT, "options.residual");
  MUST_FAIL(mvs_begin_settle(NULL, NULL), MVS_E_ARGUMENT, "sim");
  MUST(mvs_begin_settle(sim, NULL));
  const double seconds[] = {-1, 3601, NAN};
  for (int k = 0; k < 3; ++k) {
    MUST_FAIL(mvs_advance_settle(sim, seconds[k], NULL, NULL), MVS_E_ARGUMENT, "seconds");
  }
  h.stop_at = 3;
  MUST_FAIL(mvs_advance_settle(sim, 10, NULL, NULL), MVS_E_CANCELLED, "cancelled");
  CHECK(h.calls == 3);
  CHECK(same_hash(before, sim_hash(sim)));
  MUST_FAIL(mvs_advance_settle(sim, 10, NULL, NULL), MVS_E_STATE, "mvs_begin_settle");
  MUST(mvs_begin_settle(sim, NULL)); /* destroyed half-way */
  MUST(mvs_advance_settle(sim, 0, NULL, NULL));
  mvs_destroy(sim);

  mvs_sim *empty;
  MUST(mvs_create(NULL, &empty));
  MUST_FAIL(mvs_begin_settle(empty, NULL), MVS_E_STATE, "no valve");
  mvs_destroy(empty);
}

int main(void) {
  slices_have_the_bits_of_one_call();
  slices_of_a_fine_valve_have_the_bits_of_one_call();
  other_calls_cancel_the_slices();
  wrong_arguments_and_a_cancelling_host_change_nothing();
  return finish("slices");
}
