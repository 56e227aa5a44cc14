// `mvs haptics list`: every driver with its path and the devices that it finds.
#include "haptics/haptics.h"

#include "haptics/device.h"

namespace cli {
namespace {

struct DriverRow {
  mvs::Driver driver;
  std::vector<mvs::FoundDevice> devices;
  std::string why_not;  // error sentence; empty: the driver answered
};

// A driver that cannot be loaded is a row of the list, or a failure if it was named.
DriverRow devices_of_driver(const mvs::Driver &driver, const DeviceOptions &options) {
  DriverRow row = {driver, {}, ""};
  try {
    row.devices =
        with_list_named([&] { return mvs::devices_of(driver.path, lines_of(options.options)); });
  } catch (const mvs::Error &failure) {
    if (!options.driver.empty()) throw;
    row.why_not = failure.what();
  }
  return row;
}

// The named driver, or all installed drivers.
std::vector<mvs::Driver> wanted_drivers(const DeviceOptions &options) {
  const std::string wanted = driver_of(options);
  std::vector<mvs::Driver> found;
  for (const mvs::Driver &driver : mvs::drivers()) {
    if (wanted.empty() || driver.name == wanted) found.push_back(driver);
  }
  if (found.empty() && !wanted.empty()) found.push_back({wanted, wanted});
  return found;
}

Json driver_json(const DriverRow &row) {
  Json devices = Json::array();
  for (const auto &device : row.devices) {
    devices.push_back({{"name", device.name}, {"model", device.model}});
  }
  return {{"name", row.driver.name},
          {"path", row.driver.path},
          {"devices", devices},
          {"why_not", row.why_not.empty() ? Json() : Json(row.why_not)}};
}

std::string driver_text(const DriverRow &row) {
  std::string lines = text("%-16s %s", row.driver.name.c_str(), row.driver.path.c_str());
  for (const auto &device : row.devices) {
    lines += text("\n  device \"%s\": %s", device.name.c_str(), device.model.c_str());
  }
  if (!row.why_not.empty()) return lines + "\n  " + row.why_not;
  return row.devices.empty() ? lines + "\n  finds no device" : lines;
}

void run_list(const DeviceOptions &options, const Console &console) {
  Json drivers = Json::array();
  std::string lines;
  for (const mvs::Driver &driver : wanted_drivers(options)) {
    const DriverRow row = devices_of_driver(driver, options);
    drivers.push_back(driver_json(row));
    lines += (lines.empty() ? "" : "\n") + driver_text(row);
  }
  if (drivers.empty()) {
    lines = "no driver is installed in the folder mvs/drivers beside the library";
  }
  print(console, {{"drivers", drivers}}, lines);
}

}  // namespace

void add_haptics_list(CLI::App &haptics, Console &console) {
  const auto [command, options] = add_command<DeviceOptions>(
      haptics, console, "list", "list the drivers and their devices", run_list);
  add_driver_options(*command, *options);
}

void add_haptics(CLI::App &app, Console &console) {
  CLI::App *haptics = app.add_subcommand("haptics", "find, check, test and record haptic devices");
  haptics->require_subcommand(1);
  add_haptics_list(*haptics, console);
  add_haptics_doctor(*haptics, console);
  add_haptics_test(*haptics, console);
  add_haptics_record(*haptics, console);
}

}  // namespace cli
