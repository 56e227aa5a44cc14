// Options of the replay driver, and the description of the replayed device.
#pragma once

#include <mvs/driver.h>

#include <string>

#include "common/recording.h"

namespace replay {

enum class End { kStay, kLoop, kStop };

struct Settings {
  std::string file;
  End end = End::kStay;
  double speed = 1;
  driver::Recording recording;
  mvs_driver_info info;
};

// Reads the options and their file, or the file `name` if it is not null; throws a Refusal.
Settings settings(const mvs_driver_host *host, const char *name);

}  // namespace replay
