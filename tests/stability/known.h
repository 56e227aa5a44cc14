// What is known to fail, and why. Every line here is a line of README.md; a row that passes
// although it is here is told as BETTER, so that both lines can go.
#pragma once

namespace stability {

struct Known {
  const char *name, *way;  // way "": any
  const char *reason;
};

inline constexpr char last_resort[] =
    "a step whose every cut makes energy takes the shortest of them all the same";

inline constexpr char felt[] =
    "the forces of a snapshot and the residual of the step differ while a ball touches";

inline constexpr Known known_failures[] = {
    {"chords/each_minus_90", "live", last_resort},
    {"chords/all_removed", "live", last_resort},
    {"meshes/slivers_0.1_percent", "live", last_resort},
    {"loads/pressure_negative_x10", "live", last_resort},
    {"loads/dt_5_ms", "live", last_resort},
    {"loads/dt_20_ms", "live", last_resort},
    {"starts/inverted", "live", last_resort},
    {"starts/intersecting", "live", last_resort},
    {"meshes/slivers_10_percent", "live", last_resort},
    {"tools/grasp_50mm_up", "live", last_resort},
    {"tools/ball_through_at_1_m_s", "live", felt},
};

}  // namespace stability
