// `mvs haptics list`: every driver, where it lies, and which devices it finds.
#include "haptics.h"

#include <memory>

#include "device.h"

namespace cli {
namespace {

struct Row {
  mvs::Driver driver;
  std::vector<mvs::FoundDevice> devices;
  std::string why_not;  // empty: the driver was asked
};

// One of all that cannot be asked is told; the one that was named is a failure.
Row ask(const mvs::Driver &driver, const DeviceOptions &options) {
  Row row = {driver, {}, ""};
  try {
    row.devices = mvs::devices_of(driver.path, lines_of(options.options));
  } catch (const mvs::Error &failure) {
    if (!options.driver.empty()) throw;
    row.why_not = failure.what();
  }
  return row;
}

// The one that is named, or all that are installed.
std::vector<mvs::Driver> wanted_drivers(const DeviceOptions &options) {
  const std::string wanted = driver_of(options);
  std::vector<mvs::Driver> found;
  for (const mvs::Driver &driver : mvs::drivers()) {
    if (wanted.empty() || driver.name == wanted) found.push_back(driver);
  }
  if (found.empty() && !wanted.empty()) found.push_back({wanted, wanted});
  return found;
}

Json row_json(const Row &row) {
  Json devices = Json::array();
  for (const auto &device : row.devices) {
    devices.push_back({{"name", device.name}, {"model", device.model}});
  }
  return {{"name", row.driver.name},
          {"path", row.driver.path},
          {"devices", devices},
          {"why_not", row.why_not.empty() ? Json() : Json(row.why_not)}};
}

std::string row_text(const Row &row) {
  std::string told = text("%-16s %s", row.driver.name.c_str(), row.driver.path.c_str());
  for (const auto &device : row.devices) {
    told += text("\n  device \"%s\": %s", device.name.c_str(), device.model.c_str());
  }
  if (!row.why_not.empty()) return told + "\n  " + row.why_not;
  return row.devices.empty() ? told + "\n  finds no device" : told;
}

void list(const DeviceOptions &options, const Console &console) {
  Json drivers = Json::array();
  std::string told;
  for (const mvs::Driver &driver : wanted_drivers(options)) {
    const Row row = ask(driver, options);
    drivers.push_back(row_json(row));
    told += (told.empty() ? "" : "\n") + row_text(row);
  }
  if (drivers.empty()) {
    told = "no driver is installed: they lie in the folder mvs/drivers beside the library";
  }
  print(console, {{"drivers", drivers}}, told);
}

}  // namespace

void add_haptics_list(CLI::App &haptics, Console &console) {
  auto options = std::make_shared<DeviceOptions>();
  CLI::App *command = add_command(haptics, console, "list", "name the drivers and their devices");
  add_driver_options(*command, *options);
  command->callback([=, &console] { list(*options, console); });
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
