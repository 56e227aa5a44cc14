// What a driver's doctor finds, and what is found of all drivers that are installed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace mvs::core {

struct DriverFinding {
  int32_t verdict;  // as mvs_driver_finding has it
  std::string check, sentence;
};

// Options are "key=value" lines. Throws where the driver cannot be loaded or asked.
std::vector<DriverFinding> examine(const std::string &driver, const std::string &options);
// Every driver in the folder beside the library. A check is "driver: check"; a driver without a
// device has one row, a note: nobody has every device.
std::vector<DriverFinding> examine_all();

}  // namespace mvs::core
