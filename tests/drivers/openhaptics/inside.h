// The stand-in's devices and errors, shared by its files.
#pragma once
#include <mutex>
#include <string>
#include <vector>

#include "stand_in.h"

#define HDAPI extern "C" __attribute__((visibility("default")))

namespace hd {

constexpr double kMaxForce = 3.3;  // N

struct ErrorInfo {
  unsigned code;
  int internal;
  unsigned device;
};

struct Device {
  bool open = false, in_frame = false, gone = false;
  unsigned enabled = 0;
  long tick = 0;  // of its sample
  double force[6] = {};
  unsigned calibration = 0x5000;
};

// One lock, as HDAPI has one state; recursive, since a callback calls back.
struct World {
  std::recursive_mutex mutex;
  Device devices[HdStandIn::kDevices];
  unsigned current = 0xFFFFFFFF;
  std::vector<ErrorInfo> errors;
  bool reads_numbers = true;  // false: it was opened under a decimal comma
};
World &world();
HdStandIn &told();

void raise(unsigned code, unsigned device);
// A call that HDAPI forbids: counted, and an error.
void misuse(const char *what, unsigned code = 0x102);
Device *current();
// Blocks while told().hang is set; only for calls that stop or close.
void hang();
// The scheduler's tick, -1 outside its thread.
long scheduler_tick();

}  // namespace hd
