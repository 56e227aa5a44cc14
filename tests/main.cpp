// The main() of every doctest program.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include "tests/short_run.h"

namespace {

// Cases that run for minutes under the sanitizers and execute the same code paths as other cases.
constexpr const char *repeated =
    "the_valve_that_took_febio_107_seconds_closes,"
    "the_founding_valve_closes_competently_at_every_size,"
    "a_target_edge_length_gives_a_number_of_vertices,"
    "surface_registration_is_a_local_minimum,"
    "fifty_thousand_triangles_are_tested_at_interactive_speed,"
    "the_valve_closes_with_any_ring_that_is_in_use,"
    "any_piece_is_cut_or_refused,"
    "a_large_valve_closes_to_the_shape_of_the_plain_closure_in_fewer_iterations,"
    "the local model of a grasp predicts the force within 5 % for 1 mm around,"
    "the local model of a ball that pushes predicts the force within 10 % for 0.25 mm around";

}  // namespace

int main(int argc, char **argv) {
  doctest::Context context(argc, argv);
  if (short_run()) context.addFilter("test-case-exclude", repeated);
  return context.run();
}
