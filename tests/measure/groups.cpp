// A snapshot computes the groups of measures that it is asked for, and no other.
#include <doctest/doctest.h>

#include "anatomy/parametric.h"
#include "base/struct_fields.h"
#include "session/snapshot.h"

using namespace mvs::core;

namespace {

SnapshotPtr small_valve() {
  mvs_parametric_desc desc = {};
  desc.struct_size = sizeof desc;
  desc.vertices = 200;
  const ModelPtr model = make_model(make_parametric_valve(desc));
  return make_snapshot({{model, initial_state(*model)}, {}});
}

}  // namespace

TEST_CASE("groups_that_are_not_asked_for_are_not_computed") {
  const SnapshotPtr valve = small_valve();
  CHECK(valve->computed_groups() == 0);
  valve->measures(0);
  CHECK(valve->computed_groups() == 0);
  const mvs_measure_group_flags all = all_measure_groups();
  for (mvs_measure_group_flags group = 1; group <= all; group <<= 1) {
    const SnapshotPtr fresh = small_valve();
    fresh->measures(group);
    CHECK(fresh->computed_groups() == group);
  }
  valve->measures();
  CHECK(valve->computed_groups() == all);
}

TEST_CASE("an_array_and_its_group_are_computed_once") {
  const SnapshotPtr valve = small_valve();
  valve->coaptation();
  CHECK(valve->computed_groups() == MVS_MEASURE_GROUP_COAPTATION);
  const mvs_measures some = valve->measures(MVS_MEASURE_GROUP_COAPTATION);
  CHECK(some.coaptation_area == valve->coaptation().area);
}
