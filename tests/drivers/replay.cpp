// The driver that plays a recording: the samples it plays.
#include <cmath>
#include <cstring>

#include "recording_file.h"

namespace {

const double kRootHalf = std::sqrt(0.5);

}  // namespace

TEST_CASE("a_recording_is_interpolated_linearly_between_its_samples") {
  const RecordingFile file(short_recording);
  Plugin plugin("replay", {{"file", file.path()}});
  REQUIRE_EQ(plugin.open(), MVS_DRIVER_OK);
  CHECK_EQ(at(plugin, 1).position[0], 0.01);  // before start() it waits at its beginning
  REQUIRE_EQ(plugin.api.start(plugin.device), MVS_DRIVER_OK);
  CHECK_EQ(at(plugin, 100).position[0], 0.01);  // and begins with the first read after it

  // the clock counts nanoseconds, and 5.01 - 5 is rounded
  const double tolerance = 1e-9;
  const mvs_driver_state early = at(plugin, 100.005);
  CHECK(std::abs(early.position[0] - 0.015) < tolerance);
  CHECK(std::abs(early.velocity[0] - 1) < tolerance);
  CHECK((early.flags & MVS_DRIVER_FLAG_VELOCITY) != 0);
  CHECK_EQ(early.buttons, 0);
  CHECK(std::abs(early.gripper - 0.1) < tolerance);
  // an eighth of a turn: the file has the quarter with the other sign, which is the same turn
  CHECK(std::abs(std::abs(early.orientation[0]) - std::cos(std::atan(1) / 2)) < tolerance);
  CHECK(std::abs(early.orientation[0] * early.orientation[3] - kRootHalf / 2) < tolerance);

  const mvs_driver_state middle = at(plugin, 100.03);
  CHECK_EQ(middle.position[0], 0.02);
  CHECK(std::abs(middle.position[1] - 0.02) < tolerance);
  CHECK(std::abs(middle.velocity[1] - 1) < tolerance);
  CHECK_EQ(middle.buttons, 1);
  CHECK(std::abs(std::abs(middle.orientation[3]) - kRootHalf) < tolerance);
  CHECK(std::abs(at(plugin, 100.075).velocity[2] - 1) < tolerance);
}

TEST_CASE("a_recording_plays_the_same_at_any_rate") {
  const std::string file = std::string(recordings_folder) + "grasp_a2.txt";
  Plugin fast("replay", {{"file", file}}), slow("replay", {{"file", file}});
  REQUIRE_EQ(fast.open(), MVS_DRIVER_OK);
  REQUIRE_EQ(slow.open(), MVS_DRIVER_OK);
  fast.api.start(fast.device);
  slow.api.start(slow.device);
  for (int ms = 0; ms < 12000; ++ms) {
    const mvs_driver_state one = at(fast, 1 + ms * 1e-3);
    if (ms % 7) continue;
    const mvs_driver_state other = at(slow, 1 + ms * 1e-3);
    for (int k = 0; k < 3; ++k) CHECK_EQ(one.position[k], other.position[k]);
    CHECK_EQ(one.buttons, other.buttons);
  }
}

TEST_CASE("a_recording_stays_loops_or_stops_at_its_end") {
  const RecordingFile file(short_recording);
  const auto begun = [&](Plugin &plugin) {
    REQUIRE_EQ(plugin.open(), MVS_DRIVER_OK);
    plugin.api.start(plugin.device);
    at(plugin, 1);
  };
  Plugin stay("replay", {{"file", file.path()}});
  begun(stay);
  CHECK_EQ(at(stay, 2).position[2], 0.03);
  CHECK_EQ(at(stay, 2.1).velocity[2], 0);
  const uint64_t before = at(stay, 2.2).sequence;
  CHECK_GT(at(stay, 2.3).sequence, before);  // it is at rest, not lost

  Plugin loop("replay", {{"file", file.path()}, {"end", "loop"}});
  begun(loop);
  CHECK(std::abs(at(loop, 1 + 7 * 0.1 + 0.005).position[0] - 0.015) < 1e-9);

  Plugin stop("replay", {{"file", file.path()}, {"end", "stop"}});
  begun(stop);
  at(stop, 1.099);
  mvs_driver_state state;
  CHECK_EQ(stop.read(1101000000, state), MVS_DRIVER_E_END);
  CHECK(has(stop.error(), file.path() + " is over"));
  CHECK_EQ(stop.read(1102000000, state), MVS_DRIVER_E_END);
  stop.api.start(stop.device);  // starts from its beginning again
  CHECK_EQ(at(stop, 2).position[0], 0.01);
}

TEST_CASE("a_recording_plays_faster_on_request") {
  const RecordingFile file(short_recording);
  Plugin plugin("replay", {{"file", file.path()}, {"speed", "2"}});
  REQUIRE_EQ(plugin.open(), MVS_DRIVER_OK);
  plugin.api.start(plugin.device);
  at(plugin, 1);
  CHECK(std::abs(at(plugin, 1.015).position[1] - 0.02) < 1e-9);
  CHECK(std::abs(at(plugin, 1.016).velocity[1] - 2) < 1e-9);
}

TEST_CASE("a_recording_describes_its_device") {
  const RecordingFile file(short_recording);
  Plugin plugin("replay", {{"file", file.path()}});
  REQUIRE_EQ(plugin.open(), MVS_DRIVER_OK);
  const mvs_driver_info info = plugin.info();
  CHECK_EQ(std::string(info.model), "Test stylus");
  CHECK_EQ(info.peak_force, 3.5);
  CHECK_EQ(info.max_stiffness, 0);  // unknown
  CHECK_EQ(info.rate, 500);
  CHECK_EQ(info.freedoms_in, 6);
  CHECK_EQ(info.freedoms_out, 3);
  CHECK_EQ(info.has_gripper, 1);
  CHECK_EQ(info.buttons, 2);
  // unknown: around zero, 20 mm beyond the farthest sample
  CHECK_EQ(info.workspace_min[2], -0.05);
  CHECK_EQ(info.workspace_max[2], 0.05);

  Plugin told("replay",
              {{"file", file.path()}, {"force", "0"}, {"device", "Mouse"}, {"rate", "60"}});
  REQUIRE_EQ(told.open(), MVS_DRIVER_OK);
  CHECK_EQ(told.info().freedoms_out, 0);
  CHECK_EQ(told.info().rate, 60);
  CHECK_EQ(std::string(told.info().model), "Mouse");
}

TEST_CASE("a_force_beyond_the_device_saturates_and_an_invalid_one_is_refused") {
  const RecordingFile file(short_recording);
  Plugin plugin("replay", {{"file", file.path()}});
  REQUIRE_EQ(plugin.open(), MVS_DRIVER_OK);
  plugin.api.start(plugin.device);
  CHECK_EQ(plugin.write(0, 3.5, 0), MVS_DRIVER_OK);
  CHECK_EQ(at(plugin, 1).flags & MVS_DRIVER_FLAG_SATURATED, 0);
  CHECK_EQ(plugin.write(0, 3.6, 0), MVS_DRIVER_OK);
  CHECK((at(plugin, 2).flags & MVS_DRIVER_FLAG_SATURATED) != 0);
  CHECK_EQ(plugin.write(0, std::nan(""), 0), MVS_DRIVER_E_FAULT);
  CHECK_EQ(at(plugin, 3).flags & MVS_DRIVER_FLAG_FORCE_ON, 0);
}

TEST_CASE("a_loop_with_a_jump_causes_a_warning") {
  const RecordingFile file(short_recording);
  Plugin plugin("replay", {{"file", file.path()}, {"end", "loop"}});
  const auto findings = plugin.doctor();
  REQUIRE_EQ(findings.size(), 2);
  CHECK_EQ(findings[0].verdict, 1);
  CHECK_EQ(findings[1].verdict, -1);
}

TEST_CASE("two_recordings_play_side_by_side") {
  const RecordingFile file(short_recording);
  Plugin one("replay", {{"file", file.path()}}), two("replay", {{"file", file.path()}});
  REQUIRE_EQ(one.open(), MVS_DRIVER_OK);
  REQUIRE_EQ(two.open(), MVS_DRIVER_OK);
  one.api.start(one.device);
  two.api.start(two.device);
  at(one, 1);
  CHECK_EQ(at(two, 2).position[0], 0.01);
  CHECK_EQ(at(one, 2).position[2], 0.03);
  one.close();
  CHECK_EQ(at(two, 3).position[2], 0.03);
}
