// Options of the simulated hand.
#pragma once

#include <optional>

#include "common/recording.h"
#include "devices.h"
#include "faults.h"
#include "oscillator.h"

namespace hand {

// Target position of the arm.
struct Script {
  driver::Vector target = {}, amplitude = {};  // m
  double frequency = 0;                        // Hz
  std::optional<driver::Recording> recording;  // replaces the other members
};

// Rotation of the hand about its wrist.
struct Rotation {
  Oscillator oscillator;                     // kg m2, N m/rad, N m s/rad
  driver::Vector from = {}, amplitude = {};  // rad: initial rotation vector, and of the swing
};

struct Settings {
  Device device;
  Oscillator oscillator;  // hand and device together
  Rotation rotation;
  Script script;
  driver::Vector from = {}, push = {};  // m, initial position; N, additional force
  bool measures_velocity = false;
  uint32_t buttons = 0;  // held permanently
  Faults faults;
};

// Reads the options; throws a Refusal with the invalid one.
Settings settings(const mvs_driver_host *host);

}  // namespace hand
