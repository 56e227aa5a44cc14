/* A ball that is pressed into a closed valve and drawn back follows its hand, and the result does
 * not depend on earlier tools. */
#include <math.h>

#include "tests/api/check.h"
#include "tests/founding.h"

static mvs_sim *sim;
static const mvs_snapshot *closed;
static double frame[12];

/* A push: its place, its depth, the distance that the hand moves in each step. */
typedef struct push {
  double dt, each, ap, cc, depth, stiffness;
} push;

static void close_valve(void) {
  const mvs_load_case systole = {sizeof systole, 0, MVS_SYSTOLE_PA, 1};
  MUST(generate_founding(sim));
  MUST(mvs_set_load(sim, &systole));
  MUST(mvs_settle(sim, NULL, NULL));
  MUST(mvs_get_snapshot(sim, &closed));
  MUST(mvs_snapshot_get_frame(closed, frame));
}

/* A point at these distances along AP and CC from the annulus centroid, up in the atrium. */
static void place(const push *p, double up, double at[3]) {
  for (int k = 0; k < 3; ++k) {
    at[k] = frame[k] + p->ap * frame[3 + k] + p->cc * frame[6 + k] + up * frame[9 + k];
  }
}

static double height(const double at[3]) {
  double up = 0;
  for (int k = 0; k < 3; ++k) up += (at[k] - frame[k]) * frame[9 + k];
  return up;
}

/* The largest number of consecutive steps in which a ball stayed although its hand, above it, moved
 * up. */
static int steps_stuck(const push *p) {
  const double top = 10e-3;
  const int down = (int)lround(p->depth / p->each);
  mvs_tool_desc ball = {.struct_size = sizeof ball, .kind = MVS_TOOL_KIND_BALL};
  const mvs_step_options step = {.struct_size = sizeof step, .dt = p->dt};
  mvs_id tool = 0;
  int stuck = 0, most = 0;
  double last = top;
  ball.stiffness = p->stiffness;
  place(p, top, ball.position);
  MUST(mvs_restore(sim, closed));
  MUST(mvs_add_tool(sim, &ball, &tool));
  for (int k = 1; k <= 2 * down; ++k) {
    mvs_tool_state state = {.struct_size = sizeof state};
    const double hand = top - p->each * (k <= down ? k : 2 * down - k);
    double at[3];
    place(p, hand, at);
    MUST(mvs_move_tool(sim, tool, at, NULL));
    MUST(mvs_step(sim, &step));
    MUST(mvs_get_tool(sim, tool, &state));
    const double now = height(state.proxy);
    /* its hand is farther above it than a ball at rest on tissue allows, and it moved by less than
     * a tenth of the hand's step */
    const int is_stuck = k > down && hand > now + 0.1e-3 && fabs(now - last) < 0.1 * p->each;
    stuck = is_stuck ? stuck + 1 : 0;
    if (stuck > most) most = stuck;
    last = now;
  }
  return most;
}

/* The most sensitive six of 480 pushes, all over the leaflets, at 0.1 to 1 mm in steps of 1 and 4
 * ms: a defective solver held these balls for 33, 42, 11, 9, 16 and 31 steps, pulled with up to 5
 * N. */
static void a_ball_drawn_back_comes_along(void) {
  static const push pushes[] = {
      {1e-3, 0.1e-3, -8e-3, 0, 18e-3, 200},   {1e-3, 0.1e-3, -8e-3, 6e-3, 18e-3, 1000},
      {1e-3, 0.25e-3, 11e-3, 0, 18e-3, 1000}, {1e-3, 0.5e-3, 11e-3, 6e-3, 18e-3, 1000},
      {4e-3, 0.1e-3, -8e-3, 0, 18e-3, 200},   {4e-3, 0.1e-3, 6e-3, 0, 18e-3, 1000},
  };
  for (size_t k = 0; k < sizeof pushes / sizeof *pushes; ++k) {
    const int stuck = steps_stuck(&pushes[k]);
    printf("push %zu: stuck for %d steps\n", k + 1, stuck);
    /* two: a step in which the hand passes the ball, and a shortened one */
    CHECK(stuck <= 2);
  }
}

/* The hash after a ball or rod moved down by 15 mm into the closed valve. */
static hash128 pushed(mvs_sim *by, mvs_tool_desc tool) {
  const push p = {1e-3, 1e-3, -8e-3, 0, 15e-3, 1000};
  mvs_tool_state state = {.struct_size = sizeof state};
  mvs_id id = 0;
  double down[3];
  place(&p, 10e-3, tool.position);
  place(&p, 10e-3 - p.depth, down);
  MUST(mvs_restore(by, closed));
  MUST(mvs_add_tool(by, &tool, &id));
  MUST(mvs_move_tool(by, id, down, NULL));
  for (int k = 0; k < 15; ++k) MUST(mvs_step(by, NULL));
  MUST(mvs_get_tool(by, id, &state));
  CHECK(state.touching == 1);
  return sim_hash(by);
}

/* Restoring a snapshot also restores the next tool id, and the next tool gets it: data cached for
 * the first tool with that id must not be used for it. */
static void a_tool_with_the_id_of_another_is_its_own(void) {
  static const mvs_tool_desc first[] = {
      {.struct_size = sizeof *first, .kind = MVS_TOOL_KIND_BALL, .radius = 2e-3},
      {.struct_size = sizeof *first,
       .kind = MVS_TOOL_KIND_ROD,
       .axis = {0, 0, 1},
       .length = 10e-3}};
  for (size_t k = 0; k < 2; ++k) {
    mvs_tool_desc second = first[k];
    mvs_sim *fresh = NULL;
    if (second.kind == MVS_TOOL_KIND_BALL) second.radius = 3e-3;
    if (second.kind == MVS_TOOL_KIND_ROD) second.length = 15e-3;
    MUST(mvs_create(NULL, &fresh));
    const hash128 wanted = pushed(fresh, second);
    CHECK(!same_hash(pushed(sim, first[k]), wanted));
    CHECK(same_hash(pushed(sim, second), wanted));
    mvs_destroy(fresh);
  }
}

/* A hand that jumps through the closed valve and stands still there, 45 mm below the annulus: the
 * ball pushes its way between the leaflets, and the valve closes behind it. With weaker barriers
 * both stood still for ever, with a force of 5 to 100 N out of balance. */
static void a_ball_pressed_hard_does_not_stop_the_valve(void) {
  static const struct { double stiffness, force; } presses[] = {{200, 5}, {1e5, 100}};
  const mvs_load_case systole = {sizeof systole, 0, MVS_SYSTOLE_PA, 1};
  for (size_t k = 0; k < sizeof presses / sizeof *presses; ++k) {
    mvs_tool_desc ball = {.struct_size = sizeof ball, .kind = MVS_TOOL_KIND_BALL};
    mvs_tool_state state = {.struct_size = sizeof state};
    mvs_stats stats = {.struct_size = sizeof stats};
    const push p = {.ap = 6e-3};
    double down[3];
    mvs_id tool = 0;
    MUST(mvs_generate_valve(sim, NULL));
    MUST(mvs_set_load(sim, &systole));
    MUST(mvs_settle(sim, NULL, NULL));
    ball.stiffness = presses[k].stiffness;
    ball.max_force = presses[k].force;
    place(&p, 15e-3, ball.position);
    place(&p, -45e-3, down);
    MUST(mvs_add_tool(sim, &ball, &tool));
    MUST(mvs_move_tool(sim, tool, down, NULL));
    for (int step = 0; step < 500; ++step) MUST(mvs_step(sim, NULL));
    MUST(mvs_get_tool(sim, tool, &state));
    MUST(mvs_get_stats(sim, &stats));
    printf("press %zu: ball at %.1f mm, residual %.1e N\n", k + 1, 1e3 * height(state.proxy),
           stats.residual);
    CHECK(fabs(height(state.proxy) + 45e-3) < 1e-3);
    CHECK(stats.residual < 1e-2);
  }
}

int main(void) {
  MUST(mvs_create(NULL, &sim));
  close_valve();
  a_ball_drawn_back_comes_along();
  a_tool_with_the_id_of_another_is_its_own();
  a_ball_pressed_hard_does_not_stop_the_valve();
  mvs_snapshot_release(closed);
  mvs_destroy(sim);
  return finish("push");
}
