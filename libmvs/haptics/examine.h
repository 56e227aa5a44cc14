// Findings of a driver's doctor function, and of all installed drivers.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace mvs::core {

struct DriverFinding {
  int32_t verdict;  // as mvs_driver_finding has it
  std::string check, sentence;
};

// Options are "key=value" lines. Throws if the driver cannot be loaded or does not answer.
std::vector<DriverFinding> examine(const std::string &driver, const std::string &options);
// Examines every driver in the folder beside the library. A check is named "driver: check"; a
// driver without a device gives one note, because most users have at most one kind of device.
std::vector<DriverFinding> examine_all();

}  // namespace mvs::core
