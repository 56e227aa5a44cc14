/* Fixture: a small valve under some load, and the state of a tool. */
#ifndef TESTS_SMALL_VALVE_H
#define TESTS_SMALL_VALVE_H

#include "tests/api/check.h"

static mvs_sim *sim;

static inline void new_valve(void) {
  mvs_parametric_desc small = {
      .struct_size = sizeof small, .vertices = 200, .shape = MVS_SHAPE_FOUNDING};
  MUST(mvs_generate_valve(sim, &small));
}

static inline void start(void) {
  mvs_load_case load = {sizeof load, 0, 2000, 0.2};
  new_valve();
  MUST(mvs_set_load(sim, &load));
}

static inline mvs_tool_state state_of(mvs_sim *of, mvs_id tool) {
  mvs_tool_state state = {.struct_size = sizeof state};
  MUST(mvs_get_tool(of, tool, &state));
  return state;
}

#endif
