// Calls the doctor functions of drivers and collects their findings.
#include "haptics/examine.h"

#include <memory>

#include "base/error.h"
#include "haptics/driver_plugin.h"

namespace mvs::core {
namespace {

using Findings = std::vector<DriverFinding>;

constexpr int32_t good = 1, fault = 0, note = 2;

std::string text_of(const char *text) {
  return text ? text : "";
}

Findings findings_of(const std::shared_ptr<DriverPlugin> &plugin) {
  Findings first = {{good, "driver", plugin->api().about ? plugin->api().about : plugin->name()}};
  if (!plugin->api().doctor) return first;
  // owned by the call: a driver that hangs may still write to it
  const auto rows = std::make_shared<Findings>(std::move(first));
  plugin->call("doctor", nullptr, [rows, plugin](const mvs_driver_api &api) {
    return api.doctor(
        plugin->host(),
        [](void *to, int32_t verdict, const char *check, const char *sentence) {
          static_cast<Findings *>(to)->push_back({verdict, text_of(check), text_of(sentence)});
        },
        rows.get());
  });
  return *rows;
}

// Returns why the driver has no device to examine; "" if it has one.
std::string absence(const std::shared_ptr<DriverPlugin> &plugin) {
  if (!plugin->api().list) return "";
  const auto count = std::make_shared<size_t>(0);
  const DriverPlugin::Answer answer =
      plugin->ask("list", nullptr, [count, plugin](const mvs_driver_api &api) {
        return api.list(
            plugin->host(),
            [](void *to, const char *, const char *) { ++*static_cast<size_t *>(to); },
            count.get());
      });
  if (answer.code == MVS_DRIVER_E_LIBRARY) return "not installed: " + answer.sentence;
  if (answer.code == MVS_DRIVER_E_ABSENT) return "no device: " + answer.sentence;
  return answer.code >= 0 && *count == 0 ? "it finds no device" : "";
}

// A driver that cannot be loaded or does not answer becomes a finding.
Findings examine_installed(const std::string &path) {
  try {
    const auto plugin = DriverPlugin::load(path, "", {});
    const std::string why = absence(plugin);
    if (!why.empty()) return {{note, "driver", why}};
    return findings_of(plugin);
  } catch (const Error &failure) {
    return {{fault, "driver", failure.what()}};
  }
}

}  // namespace

Findings examine(const std::string &driver, const std::string &options) {
  return findings_of(DriverPlugin::load(driver, options, {}));
}

Findings examine_all() {
  Findings all;
  for (const DriverFile &file : installed_drivers()) {
    for (DriverFinding &found : examine_installed(file.path)) {
      found.check = file.name + ": " + found.check;
      all.push_back(std::move(found));
    }
  }
  return all;
}

}  // namespace mvs::core
