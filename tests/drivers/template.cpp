// The driver template works unchanged.
#include "plugin.h"

TEST_CASE("the_template_is_a_device_at_rest") {
  Plugin plugin("template");
  REQUIRE_EQ(plugin.list(), std::vector<std::string>{"desk"});
  const auto findings = plugin.doctor();
  REQUIRE_EQ(findings.size(), 1);
  CHECK_EQ(findings[0].verdict, 1);
  REQUIRE_EQ(plugin.open("desk"), MVS_DRIVER_OK);
  const mvs_driver_info info = plugin.info();
  CHECK_EQ(info.freedoms_in, 3);
  CHECK_EQ(info.freedoms_out, 3);
  CHECK_GT(info.max_stiffness, 0);
  CHECK_LE(info.continuous_force, info.peak_force);
  REQUIRE_EQ(plugin.api.start(plugin.device), MVS_DRIVER_OK);
  for (uint64_t n = 1; n <= 100; ++n) {
    mvs_driver_state state;
    REQUIRE_EQ(plugin.read(n * 1000000, state), MVS_DRIVER_OK);
    REQUIRE_EQ(plugin.write(0.5, 0, 0), MVS_DRIVER_OK);
    CHECK_EQ(state.sequence, n);
    CHECK((state.flags & MVS_DRIVER_FLAG_CALIBRATED) != 0);
    for (int k = 0; k < 3; ++k) {
      CHECK_EQ(state.position[k], 0.5 * (info.workspace_min[k] + info.workspace_max[k]));
      CHECK_EQ(state.velocity[k], 0);
    }
    CHECK_EQ(state.orientation[0], 1);
  }
}

TEST_CASE("the_template_opens_once") {
  Plugin first("template"), second("template");
  REQUIRE_EQ(first.open(), MVS_DRIVER_OK);
  CHECK_EQ(second.open(), MVS_DRIVER_E_BUSY);
  CHECK_EQ(second.device, nullptr);
  CHECK_NE(second.error().find("open already"), std::string::npos);
  first.close();
  CHECK_EQ(second.open(), MVS_DRIVER_OK);
}

TEST_CASE("the_template_lists_its_devices") {
  Plugin plugin("template");
  CHECK_EQ(plugin.open("attic"), MVS_DRIVER_E_ABSENT);
  CHECK_EQ(plugin.error(), "there is no device \"attic\": try \"desk\"");
}
