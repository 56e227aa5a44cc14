// What the application wants simulated.
#pragma once

#include <optional>

#include "common/recording.h"
#include "devices.h"
#include "faults.h"
#include "oscillator.h"

namespace hand {

// Where the arm leads the hand.
struct Script {
  driver::Vector target = {}, amplitude = {};  // m
  double frequency = 0;                        // Hz
  std::optional<driver::Recording> recording;  // instead of both
};

struct Settings {
  Device device;
  Oscillator oscillator;  // hand and device together
  Script script;
  driver::Vector from = {}, push = {};  // m: where it begins; N: beside the arm and the device
  bool tells_velocity = false;
  uint32_t buttons = 0;  // held for ever
  Faults faults;
};

// From the options; throws a Refusal that says which makes no sense.
Settings settings(const mvs_driver_host *host);

}  // namespace hand
