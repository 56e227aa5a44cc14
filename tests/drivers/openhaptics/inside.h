// The stand-in's devices and errors, as its files share them.
#pragma once
#include <mutex>
#include <string>
#include <vector>

#include "stand_in.h"

#define HDAPI extern "C" __attribute__((visibility("default")))

namespace hd {

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

// One lock for all, as HDAPI has one state for all; recursive, since a callback calls back.
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
// Something that HDAPI forbids: counted, and an error.
void misuse(const char *what, unsigned code = 0x102);
Device *current();
// While told().hang is set; only for calls that stop or close.
void hang();
// The scheduler's tick, -1 outside its thread.
long scheduler_tick();

}  // namespace hd
