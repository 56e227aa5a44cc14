// The driver handshake, for drivers that run without hardware: versions, struct sizes, optional
// functions.
#include <cstring>
#include <set>
#include <thread>

#include "mouse_window.h"
#include "plugin.h"

namespace {

mvs_driver_negotiate_fn negotiate_of(const std::string &name) {
  void *const library =
      dlopen((std::string(MVS_DRIVERS_DIR) + "/" + name + ".so").c_str(), RTLD_NOW | RTLD_LOCAL);
  REQUIRE(library);
  return reinterpret_cast<mvs_driver_negotiate_fn>(dlsym(library, "mvs_driver_negotiate"));
}

const char *const kDrivers[] = {"template", "replay", "hand", "mouse"};

std::map<std::string, std::string> options_of(const std::string &driver) {
  static MouseWindow window;
  if (driver == "mouse") return {{"pointer", window.name()}};
  if (driver != "replay") return {};
  return {{"file", MVS_SOURCE_DIR "/haptic_drivers/replay/trajectories/circle.txt"}};
}

}  // namespace

TEST_CASE("a_driver_accepts_a_host_of_version_1") {
  for (const std::string name : kDrivers) {
    CAPTURE(name);
    const auto negotiate = negotiate_of(name);
    const auto asked = [&](uint32_t oldest, uint32_t newest, uint32_t room) {
      mvs_driver_host host = {};
      host.struct_size = sizeof host;
      host.oldest = oldest;
      host.newest = newest;
      mvs_driver_api api = {};
      api.struct_size = room;
      const int32_t code = negotiate(&host, &api);
      CHECK_EQ(code == MVS_DRIVER_OK, api.version == 1);
      return code;
    };
    const uint32_t whole = sizeof(mvs_driver_api);
    CHECK_EQ(asked(1, 1, whole), MVS_DRIVER_OK);
    CHECK_EQ(asked(0, 7, whole), MVS_DRIVER_OK);
    CHECK_EQ(asked(2, 3, whole), MVS_DRIVER_E_VERSION);
    CHECK_EQ(asked(0, 0, whole), MVS_DRIVER_E_VERSION);
    CHECK_EQ(asked(1, 1, 8), MVS_DRIVER_E_VERSION);
    CHECK_EQ(negotiate(nullptr, nullptr), MVS_DRIVER_E_VERSION);
  }
}

TEST_CASE("a_driver_reports_the_size_it_filled_to_a_newer_host") {
  for (const std::string name : kDrivers) {
    CAPTURE(name);
    struct {
      mvs_driver_api api;
      uint64_t later;
    } room = {};
    room.api.struct_size = sizeof room;
    room.later = 42;
    mvs_driver_host host = {};
    host.struct_size = sizeof host;
    host.oldest = host.newest = 1;
    REQUIRE_EQ(negotiate_of(name)(&host, &room.api), MVS_DRIVER_OK);
    CHECK_EQ(room.api.struct_size, sizeof room.api);
    CHECK_EQ(room.later, 42);
    CHECK_EQ(std::string(room.api.name), name);
    CHECK(room.api.about[0] != 0);
    CHECK(room.api.error(nullptr) != nullptr);
  }
}

TEST_CASE("a_driver_writes_at_most_the_size_of_its_host") {
  for (const std::string name : kDrivers) {
    CAPTURE(name);
    Plugin plugin(name, options_of(name));
    REQUIRE_EQ(plugin.open(), MVS_DRIVER_OK);
    REQUIRE_EQ(plugin.api.start(plugin.device), MVS_DRIVER_OK);
    mvs_driver_info info;
    std::memset(&info, 0x5a, sizeof info);
    info.struct_size = offsetof(mvs_driver_info, peak_force);
    REQUIRE_EQ(plugin.api.info(plugin.device, &info), MVS_DRIVER_OK);
    CHECK_EQ(info.struct_size, offsetof(mvs_driver_info, peak_force));
    CHECK_LT(info.workspace_min[0], info.workspace_max[0]);
    CHECK_EQ(info.model[0], 0x5a);
    mvs_driver_state state;
    std::memset(&state, 0x5a, sizeof state);
    state.struct_size = offsetof(mvs_driver_state, orientation);
    REQUIRE_EQ(plugin.api.read(plugin.device, 1, &state), MVS_DRIVER_OK);
    CHECK_EQ(state.sequence, 1);
    CHECK_EQ(state.cause, 0x5a5a5a5au);
    // a force of which only `on` was filled is zero; memory behind it is not read
    mvs_driver_force force;
    std::memset(&force, 0xff, sizeof force);
    force.struct_size = offsetof(mvs_driver_force, force);
    force.on = 1;
    CHECK_EQ(plugin.api.write(plugin.device, &force), MVS_DRIVER_OK);
  }
}

TEST_CASE("the_sample_is_constant_while_the_clock_stands") {
  for (const std::string name : kDrivers) {
    CAPTURE(name);
    Plugin plugin(name, options_of(name));
    REQUIRE_EQ(plugin.open(), MVS_DRIVER_OK);
    REQUIRE_EQ(plugin.api.start(plugin.device), MVS_DRIVER_OK);
    mvs_driver_state first, again, earlier, later;
    CHECK_EQ(plugin.read(1000000, first), MVS_DRIVER_OK);
    CHECK_EQ(plugin.read(1000000, again), MVS_DRIVER_OK);
    CHECK_EQ(plugin.read(500000, earlier), MVS_DRIVER_OK);
    CHECK_EQ(plugin.read(2000000, later), MVS_DRIVER_OK);
    CHECK_EQ(first.time_ns, 1000000);
    CHECK_EQ(again.sequence, first.sequence);
    CHECK_EQ(earlier.sequence, first.sequence);
    CHECK_EQ(earlier.time_ns, first.time_ns);
    CHECK_EQ(later.sequence, first.sequence + 1);
    CHECK_EQ(later.time_ns, 2000000);
  }
}

TEST_CASE("a_driver_lists_the_options_that_it_reads") {
  struct Asked {
    std::map<std::string, std::string> given;
    std::set<std::string> keys;
  };
  for (const std::string name : kDrivers) {
    CAPTURE(name);
    Plugin plugin(name);
    Asked asked = {options_of(name), {}};
    mvs_driver_host host = {};
    host.struct_size = sizeof host;
    host.oldest = host.newest = 1;
    host.host = &asked;
    host.option = [](void *to, const char *key) {
      Asked &all = *static_cast<Asked *>(to);
      all.keys.insert(key);
      const auto found = all.given.find(key);
      return found == all.given.end() ? nullptr : found->second.c_str();
    };
    REQUIRE_EQ(plugin.api.open(&host, nullptr, &plugin.device), MVS_DRIVER_OK);
    std::set<std::string> listed;
    for (const char *const *o = plugin.api.options; o && *o; ++o)
      listed.insert(std::string(*o).substr(0, std::string(*o).find(':')));
    if (name == "hand") {  // read only where a fault, a file, or neither is given
      asked.given = {{"fault", "jump"}};
      plugin.close();
      REQUIRE_EQ(plugin.api.open(&host, nullptr, &plugin.device), MVS_DRIVER_OK);
    }
    CHECK_EQ(asked.keys, listed);
  }
}

TEST_CASE("forces_are_on_between_start_and_stop_only") {
  for (const std::string name : kDrivers) {
    CAPTURE(name);
    Plugin plugin(name, options_of(name));
    REQUIRE_EQ(plugin.open(), MVS_DRIVER_OK);
    uint64_t now = 0;
    const auto on = [&] {
      mvs_driver_state state;
      CHECK_EQ(plugin.write(0, 1, 0), MVS_DRIVER_OK);
      CHECK_EQ(plugin.read(now += 1000000, state), MVS_DRIVER_OK);
      return (state.flags & MVS_DRIVER_FLAG_FORCE_ON) != 0;
    };
    if (plugin.info().freedoms_out == 0) {  // no motors
      CHECK_EQ(plugin.api.start(plugin.device), MVS_DRIVER_OK);
      CHECK_FALSE(on());
      continue;
    }
    CHECK_FALSE(on());
    CHECK_EQ(plugin.api.start(plugin.device), MVS_DRIVER_OK);
    CHECK(on());
    std::thread([&] { CHECK_EQ(plugin.api.stop(plugin.device), MVS_DRIVER_OK); }).join();
    CHECK_FALSE(on());
    CHECK_EQ(plugin.api.stop(plugin.device), MVS_DRIVER_OK);
    CHECK_EQ(plugin.api.start(plugin.device), MVS_DRIVER_OK);
    CHECK(on());
    if (!plugin.api.panic) continue;
    plugin.api.panic(plugin.device);
    CHECK_FALSE(on());
  }
}

TEST_CASE("stop_may_be_called_while_the_device_is_read") {
  for (const std::string name : kDrivers) {
    CAPTURE(name);
    Plugin plugin(name, options_of(name));
    REQUIRE_EQ(plugin.open(), MVS_DRIVER_OK);
    REQUIRE_EQ(plugin.api.start(plugin.device), MVS_DRIVER_OK);
    std::thread other([&] {
      for (int n = 0; n < 100; ++n) plugin.api.stop(plugin.device);
    });
    mvs_driver_state state;
    for (uint64_t n = 1; n <= 1000; ++n) {
      CHECK_EQ(plugin.read(n * 1000000, state), MVS_DRIVER_OK);
      CHECK_EQ(plugin.write(0, 0, 1), MVS_DRIVER_OK);
    }
    other.join();
    CHECK_EQ(plugin.read(2000000000, state), MVS_DRIVER_OK);
    CHECK_EQ(state.flags & MVS_DRIVER_FLAG_FORCE_ON, 0);
  }
}
