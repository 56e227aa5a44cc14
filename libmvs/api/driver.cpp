// Drivers of haptic devices: lists the installed ones and the devices that one finds, and examines
// them.
#include <mvs/device.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "api/exception_boundary.h"
#include "api/structs.h"
#include "haptics/driver_plugin.h"
#include "haptics/examine.h"

using namespace mvs::core;

namespace {

// The drivers that the last mvs_get_driver_count of this thread found.
thread_local std::vector<DriverFile> listed_drivers;

}  // namespace

extern "C" {

mvs_result mvs_get_driver_count(uint32_t *count) {
  return at_boundary([&] {
    must_point(count, "count");
    listed_drivers = installed_drivers();
    *count = static_cast<uint32_t>(listed_drivers.size());
  });
}

mvs_result mvs_get_driver(uint32_t index, const char **name, const char **path) {
  return at_boundary([&] {
    must_point(name, "name");
    must_point(path, "path");
    MVS_MUST(index < listed_drivers.size(), MVS_E_ARGUMENT, "index",
             "index is %u, but mvs_get_driver_count found %zu drivers on this thread", index,
             listed_drivers.size());
    *name = listed_drivers[index].name.c_str();
    *path = listed_drivers[index].path.c_str();
  });
}

mvs_result mvs_device_list(const char *driver, const char *options, mvs_driver_found found,
                           void *user) {
  return at_boundary([&] {
    must_point(driver, "driver");
    MVS_MUST(found, MVS_E_ARGUMENT, "found", "found is a null pointer");
    const auto plugin = DriverPlugin::load(driver, text_or_empty(options), {});
    struct Names {
      std::vector<std::pair<std::string, std::string>> rows;
    };
    // owned by the call: a driver that exceeds the timeout may still write
    const auto names = std::make_shared<Names>();
    if (!plugin->api().list) return;
    plugin->call("list", nullptr, [names, plugin](const mvs_driver_api &api) {
      return api.list(
          plugin->host(),
          [](void *to, const char *name, const char *model) {
            static_cast<Names *>(to)->rows.emplace_back(text_or_empty(name), text_or_empty(model));
          },
          names.get());
    });
    for (const auto &[name, model] : names->rows) found(user, name.c_str(), model.c_str());
  });
}

mvs_result mvs_device_doctor(const char *driver, const char *options, mvs_driver_finding finding,
                             void *user) {
  return at_boundary([&] {
    MVS_MUST(finding, MVS_E_ARGUMENT, "finding", "finding is a null pointer");
    MVS_MUST(driver || !options, MVS_E_ARGUMENT, "options",
             "options are of one driver, and driver is a null pointer");
    for (const DriverFinding &row :
         driver ? examine(driver, text_or_empty(options)) : examine_all()) {
      finding(user, row.verdict, row.check.c_str(), row.sentence.c_str());
    }
  });
}

}  // extern "C"
