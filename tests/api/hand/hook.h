/* Fixture: a small valve and a hook of three bodies that goes down its orifice. */
#ifndef TESTS_HOOK_H
#define TESTS_HOOK_H

#include "tests/api/check.h"
#include "tests/api/hand/small_valve.h"

/* A shaft, a cross bar of rounded box, and a tip that is a cone. */
static const mvs_body_desc hook[3] = {
    {.kind = MVS_BODY_KIND_CAPSULE, .end = {0, 0, 20e-3}, .radius = 0.6e-3},
    {.kind = MVS_BODY_KIND_BOX,
     .position = {2e-3, 0, 0},
     .size = {4e-3, 1e-3, 1e-3},
     .orientation = {2, 0, 0, 0},
     .radius = 0.2e-3},
    {.kind = MVS_BODY_KIND_CONE,
     .position = {4e-3, 0, 0},
     .end = {4e-3, 0, 3e-3},
     .size = {0.5e-3},
     .radius = 0.1e-3}};

static inline mvs_tool_desc hook_at(double height) {
  mvs_tool_desc desc = {.struct_size = sizeof desc,
                        .kind = MVS_TOOL_KIND_CONVEX,
                        .bodies = hook,
                        .body_count = 3,
                        .body_stride = sizeof *hook};
  desc.position[2] = height;
  return desc;
}

/* A hook that goes down the orifice and turns, in ten steps. */
static inline mvs_id make_work(void) {
  mvs_id tool = 0;
  double at[3] = {0, 0, 0.02}, turn[4] = {1, 0, 0, 0};
  start();
  mvs_tool_desc desc = hook_at(at[2]);
  MUST(mvs_add_tool(sim, &desc, &tool));
  for (int k = 0; k < 10; ++k) {
    at[2] -= 1e-3;
    turn[3] += 0.02;
    MUST(mvs_move_tool_pose(sim, tool, at, turn));
    MUST(mvs_step(sim, NULL));
  }
  return tool;
}

#endif
