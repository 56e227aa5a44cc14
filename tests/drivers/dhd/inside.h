// The stand-in's devices, shared by its files.
#pragma once
#include <mutex>

#include "stand_in.h"

#define DHDAPI extern "C" __attribute__((visibility("default")))

namespace dhd {

constexpr double kTurn = 2 * 3.14159265358979323846 / 1000;  // rad a tick
constexpr double kRadius = 0.03;                             // m
constexpr int kFirstId = 2;  // of the first device: differs from its index

struct Device {
  bool open = false, forces = false, gone = false, reset = false;
  int cause = 0;
  long next = 0, tick = -1;  // of the sample
  long on_from = 0;
  double max_force = -1;
  double force[7] = {};
};

struct World {
  std::recursive_mutex mutex;
  Device devices[DhdStandIn::kDevices];
  char current = kFirstId;
  bool expert = false;
};

using Lock = std::lock_guard<std::recursive_mutex>;

World &world();
DhdStandIn &told();
int refuse(int error);
int index_of(char id);
Device *at(char id);
bool wrist();
bool active_wrist();
bool gripper();
// A new sample: 0; 1 for the previous one; -1 if the device does not answer.
int sample(char id, double *p);
// The end rotates about x along the circle.
void orientation(const Device &device, double *m);
// 0, or 2 if that exceeds the motors' largest force.
int set_force(char id, const double *wanted);
void switch_forces(char id, bool on);
int open_index(int index);
int close_id(char id);
int unsafe();
int last_error();
const char *error_text(int error);

}  // namespace dhd
