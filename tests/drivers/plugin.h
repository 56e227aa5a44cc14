// Fixture: loads a driver and calls it as libmvs does, for tests of drivers alone.
#pragma once

#include <dlfcn.h>
#include <mvs/driver.h>

#include <doctest/doctest.h>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

// Whether a sentence holds these words.
inline bool has(const std::string &sentence, const std::string &words) {
  return sentence.find(words) != std::string::npos;
}

class Plugin {
 public:
  // `driver` is a name in the folder of drivers, or a path; options are those of an application.
  explicit Plugin(const std::string &driver, std::map<std::string, std::string> options = {})
      : options_(std::move(options)) {
    const std::string path =
        driver.front() == '/' ? driver : std::string(MVS_DRIVERS_DIR) + "/" + driver + ".so";
    // never closed: vendors' libraries do not support unloading
    void *const library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!library) throw std::runtime_error(dlerror());
    const auto negotiate =
        reinterpret_cast<mvs_driver_negotiate_fn>(dlsym(library, "mvs_driver_negotiate"));
    if (!negotiate) throw std::runtime_error(path + " exports no mvs_driver_negotiate");
    api.struct_size = sizeof api;
    if (negotiate(&host_, &api) != MVS_DRIVER_OK) throw std::runtime_error(path + " refused");
  }
  ~Plugin() { close(); }
  Plugin(const Plugin &) = delete;
  Plugin &operator=(const Plugin &) = delete;

  int32_t open(const char *name = nullptr) { return api.open(&host_, name, &device); }
  void close() {
    if (device) api.close(device);
    device = nullptr;
  }
  std::string error() const { return api.error(device); }

  mvs_driver_info info() {
    mvs_driver_info out = {};
    out.struct_size = sizeof out;
    REQUIRE_EQ(api.info(device, &out), MVS_DRIVER_OK);
    return out;
  }
  int32_t read(uint64_t now_ns, mvs_driver_state &state) {
    state = {};
    state.struct_size = sizeof state;
    return api.read(device, now_ns, &state);
  }
  int32_t write(double x, double y, double z, bool on = true) {
    mvs_driver_force force = {};
    force.struct_size = sizeof force;
    force.on = on ? 1 : 0;
    force.force[0] = x;
    force.force[1] = y;
    force.force[2] = z;
    return api.write(device, &force);
  }

  struct Finding {
    int32_t verdict;
    std::string check, sentence;
  };
  std::vector<Finding> doctor() {
    std::vector<Finding> found;
    api.doctor(
        &host_,
        [](void *user, int32_t verdict, const char *check, const char *sentence) {
          static_cast<std::vector<Finding> *>(user)->push_back({verdict, check, sentence});
        },
        &found);
    return found;
  }
  std::vector<std::string> list() {
    std::vector<std::string> names;
    api.list(
        &host_,
        [](void *user, const char *name, const char *) {
          static_cast<std::vector<std::string> *>(user)->push_back(name);
        },
        &names);
    return names;
  }

  mvs_driver_api api = {};
  mvs_driver_device *device = nullptr;
  std::vector<std::string> logged;

 private:
  static const char *option(void *host, const char *key) {
    const auto &options = static_cast<Plugin *>(host)->options_;
    const auto found = options.find(key);
    return found == options.end() ? nullptr : found->second.c_str();
  }
  static void log(void *host, const char *sentence) {
    static_cast<Plugin *>(host)->logged.push_back(sentence);
  }

  std::map<std::string, std::string> options_;
  mvs_driver_host host_ = {sizeof host_, MVS_DRIVER_VERSION, MVS_DRIVER_VERSION, 0, this, option,
                           log};
};
