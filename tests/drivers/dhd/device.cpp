// A stand-in for Force Dimension's libdrd.so: up to two devices whose end moves on a circle. Own
// code, written after the description of each function in the public Python package
// forcedimension-core. functions.cpp exports the vendor's functions.
#include <cmath>
#include <cstring>
#include <initializer_list>
#include <limits>

#include "inside.h"
#include "tests/drivers/stand_in_environment.h"

namespace dhd {
namespace {

thread_local int latest_error = 0;

void take_script(DhdStandIn &in) {
  take_environment("DHD_STAND_IN", {{"count", &in.count},
                                    {"type", &in.type},
                                    {"unplug_at", &in.unplug_at},
                                    {"nan_at", &in.nan_at},
                                    {"cause", &in.cause},
                                    {"force_off_at", &in.force_off_at},
                                    {"reset", &in.reset},
                                    {"supported", &in.supported},
                                    {"buttons", &in.buttons},
                                    {"largest_mn", &in.largest_mn},
                                    {"open_error", &in.open_error}});
}

bool is_type(std::initializer_list<long> types) {
  for (const long one : types)
    if (told().type == one) return true;
  return false;
}

// x towards the user, y to the right, z up: seen from the front of the device, a circle of 1000
// ticks.
void position(const Device &device, double *p) {
  const double angle = kTurn * double(device.tick);
  p[0] = device.tick == told().nan_at ? std::numeric_limits<double>::quiet_NaN() : 0.01;
  p[1] = kRadius * std::cos(angle);
  p[2] = kRadius * std::sin(angle);
}

}  // namespace

World &world() {
  static World *const all = new World;
  return *all;
}

DhdStandIn &told() {
  static DhdStandIn *const in = [] {
    auto *const made = new DhdStandIn;
    take_script(*made);
    return made;
  }();
  return *in;
}

int refuse(int error) {
  latest_error = error;
  return -1;
}

int index_of(char id) {
  return (id < 0 ? world().current : id) - kFirstId;
}

Device *at(char id) {
  const int index = index_of(id);
  if (index >= 0 && index < DhdStandIn::kDevices && world().devices[index].open)
    return &world().devices[index];
  refuse(15);
  return nullptr;
}

bool wrist() {
  return is_type({34, 35, 36, 37, 104, 105, 108, 109});
}
bool active_wrist() {
  return is_type({104, 105, 108, 109});
}
bool gripper() {
  return is_type({35, 37, 104, 105, 108, 109});
}

int sample(char id, double *p) {
  Device *const device = at(id);
  if (!device) return -1;
  DhdStandIn &in = told();
  const long tick = device->next++;
  in.ticks[index_of(id)] = device->next;
  if (in.unplug_at >= 0 && tick >= in.unplug_at) {
    device->gone = true;
    device->forces = false;
    device->cause = 5;
  }
  if (device->gone) return refuse(2);
  if (in.deaf_at >= 0 && tick >= in.deaf_at && tick < in.deaf_at + in.deaf_for) return refuse(2);
  if (tick == in.force_off_at) {
    device->forces = false;
    device->cause = int(in.cause);
  }
  const bool guarded = tick == in.guard_at;
  if (!guarded) device->tick = tick;
  position(*device, p);
  return guarded ? 1 : 0;
}

void orientation(const Device &device, double *m) {
  const double c = std::cos(kTurn * double(device.tick)), s = std::sin(kTurn * double(device.tick));
  const double rows[9] = {1, 0, 0, 0, c, -s, 0, s, c};
  std::memcpy(m, rows, sizeof rows);
}

int set_force(char id, const double *wanted) {
  Device *const device = at(id);
  if (!device) return -1;
  if (device->gone) return refuse(2);
  DhdStandIn &in = told();
  const int index = index_of(id);
  double norm = 0;
  for (int i = 0; i < 7; ++i) {
    if (!std::isfinite(wanted[i])) return ++in.unsafe, refuse(21);
    if (i < 3) norm += wanted[i] * wanted[i];
  }
  norm = std::sqrt(norm);
  double most = double(in.largest_mn) / 1000;
  if (device->max_force >= 0 && device->max_force < most) most = device->max_force;
  const bool saturated = norm > most;
  const double scale = device->forces ? (saturated ? most / norm : 1) : 0;
  const long write = in.writes[index]++;
  for (int i = 0; i < 7; ++i) {
    device->force[i] = wanted[i] * scale;
    in.forces[index][write % DhdStandIn::kKept][i] = device->force[i];
  }
  return saturated ? 2 : 0;
}

void switch_forces(char id, bool on) {
  Device *const device = at(id);
  if (!device) return;
  device->forces = on;
  device->on_from = device->next + told().slow;
  if (!on) device->cause = 4;
  told().on[index_of(id)] = on;
}

int open_index(int index) {
  const std::lock_guard lock(world().mutex);
  if (told().open_error) return refuse(int(told().open_error));
  if (index < 0 || index >= told().count || index >= DhdStandIn::kDevices) return refuse(5);
  Device &device = world().devices[index];
  if (!device.open) device = Device();
  if (told().unplug_at < 0) device.gone = false;
  device.open = true;
  device.reset = told().reset != 0;
  world().current = char(kFirstId + index);
  return world().current;
}

int close_id(char id) {
  const std::lock_guard lock(world().mutex);
  Device *const device = at(id);
  if (!device) return -1;
  told().on[index_of(id)] = 0;
  *device = Device();
  return 0;
}

int unsafe() {
  ++told().unsafe;
  return 0;
}

int last_error() {
  return latest_error;
}

const char *error_text(int error) {
  switch (error) {
    case 0:
      return "no error";
    case 2:
      return "communication error";
    case 5:
      return "no device found";
    case 6:
      return "not available";
    case 20:
      return "device in use";
    default:
      return "error";
  }
}

}  // namespace dhd
