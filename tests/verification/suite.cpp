// The studies as tests.
#include <doctest/doctest.h>

#include "tests/verification/study.h"

using namespace mvs::core::verification;

namespace {

void check(const std::vector<Study> &studies) {
  for (const Study &study : studies) {
    INFO(as_text(study));
    CHECK(faults(study).empty());
  }
}

}  // namespace

TEST_CASE("every_law_gives_the_stress_of_its_paper") {
  check(law_studies());
}
TEST_CASE("springs_in_shear_have_the_reported_error") {
  check(shear_studies());
}
TEST_CASE("the_patch_and_the_rigid_motion_are_exact") {
  check(patch_studies());
}
TEST_CASE("discs_deflect_as_hencky_and_the_finite_membrane") {
  check(disc_studies());
}
TEST_CASE("spheres_and_tubes_follow_laplace") {
  check(laplace_studies());
}
TEST_CASE("tubes_of_fibres_bend_as_haringx_columns") {
  check(buckling_studies());
}
TEST_CASE("cables_hang_as_the_closed_forms") {
  check(cable_studies());
}
TEST_CASE("a_strip_bends_as_the_heavy_cantilever") {
  check(bending_studies());
}
TEST_CASE("steps_in_time_keep_their_balances") {
  check(step_studies());
}
