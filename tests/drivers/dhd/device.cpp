// A stand-in for Force Dimension's libdrd.so: up to two devices whose end moves on a circle. Own
// code, written after the description of each function in the public Python package
// forcedimension-core.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <map>
#include <mutex>
#include <string>
#include <thread>

#include "stand_in.h"

#define DHDAPI extern "C" __attribute__((visibility("default")))

namespace {

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

World &world() {
  static World *const all = new World;
  return *all;
}

void take_environment(DhdStandIn &in) {
  const std::map<std::string, std::atomic<long> *> keys = {
      {"count", &in.count},          {"type", &in.type},
      {"unplug_at", &in.unplug_at},  {"nan_at", &in.nan_at},
      {"cause", &in.cause},          {"force_off_at", &in.force_off_at},
      {"reset", &in.reset},          {"supported", &in.supported},
      {"buttons", &in.buttons},      {"largest_mn", &in.largest_mn},
      {"open_error", &in.open_error}};
  const char *const given = std::getenv("DHD_STAND_IN");
  std::string rest = given ? given : "";
  while (!rest.empty()) {
    const std::string one = rest.substr(0, rest.find(','));
    rest.erase(0, one.size() + 1);
    const size_t equals = one.find('=');
    const auto key = keys.find(one.substr(0, equals));
    if (equals == std::string::npos || key == keys.end())
      std::fprintf(stderr, "DHD_STAND_IN: what is '%s'?\n", one.c_str());
    else
      *key->second = std::strtol(one.c_str() + equals + 1, nullptr, 0);
  }
}

DhdStandIn &told() {
  static DhdStandIn *const in = [] {
    auto *const made = new DhdStandIn;
    take_environment(*made);
    return made;
  }();
  return *in;
}

thread_local int last_error = 0;

int refuse(int error) {
  last_error = error;
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

bool is_type(std::initializer_list<long> types) {
  for (const long one : types)
    if (told().type == one) return true;
  return false;
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

// x towards the user, y to the right, z up: seen from the front of the device, a circle of 1000
// ticks.
void position(const Device &device, double *p) {
  const double angle = kTurn * double(device.tick);
  p[0] = device.tick == told().nan_at ? std::numeric_limits<double>::quiet_NaN() : 0.01;
  p[1] = kRadius * std::cos(angle);
  p[2] = kRadius * std::sin(angle);
}

// A new sample: 0; 1 for the previous one; -1 if the device does not answer.
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

// The end rotates about x along the circle.
void orientation(const Device &device, double *m) {
  const double c = std::cos(kTurn * double(device.tick)), s = std::sin(kTurn * double(device.tick));
  const double rows[9] = {1, 0, 0, 0, c, -s, 0, s, c};
  std::memcpy(m, rows, sizeof rows);
}

// 0, or 2 if that exceeds the motors' largest force.
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

}  // namespace

using Lock = std::lock_guard<std::recursive_mutex>;

extern "C" __attribute__((visibility("default"))) DhdStandIn *dhd_stand_in() {
  return &told();
}

// Functions without a simulation refuse, as a device without that feature does.
#define UNSIMULATED(type, name)          \
  DHDAPI type name() {                   \
    ++told().unsimulated;                \
    return static_cast<type>(refuse(6)); \
  }
#include "unsimulated.inc"

DHDAPI int dhdErrorGetLast() {
  return last_error;
}
DHDAPI const char *dhdErrorGetStr(int error) {
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
DHDAPI const char *dhdErrorGetLastStr() {
  return dhdErrorGetStr(last_error);
}
DHDAPI void dhdEnableSimulator(bool) {}
DHDAPI void dhdGetSDKVersion(int *major, int *minor, int *release, int *revision) {
  *major = 3;
  *minor = 17;
  *release = *revision = 0;
}
DHDAPI double dhdGetTime() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
DHDAPI void dhdSleep(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}
DHDAPI bool dhdKbHit() {
  return false;
}
DHDAPI char dhdKbGet() {
  return 0;
}
DHDAPI void drdWaitForTick(char) {}

DHDAPI int dhdGetDeviceCount() {
  return int(told().count);
}
DHDAPI int dhdGetAvailableCount() {
  const Lock lock(world().mutex);
  int available = int(told().count);
  for (const Device &device : world().devices) available -= device.open;
  return available;
}
DHDAPI int dhdSetDevice(char id) {
  return at(id) ? world().current = id, 0 : -1;
}
DHDAPI int dhdGetDeviceID() {
  return world().current;
}
DHDAPI int drdSetDevice(char id) {
  return dhdSetDevice(id);
}
DHDAPI int drdGetDeviceID() {
  return dhdGetDeviceID();
}

DHDAPI int dhdOpen() {
  return open_index(0);
}
DHDAPI int dhdOpenID(char index) {
  return open_index(index);
}
DHDAPI int drdOpen() {
  return open_index(0);
}
DHDAPI int drdOpenID(char index) {
  return open_index(index);
}
DHDAPI int dhdClose(char id) {
  return close_id(id);
}
DHDAPI int drdClose(char id) {
  return close_id(id);
}

DHDAPI int dhdGetSystemType(char id) {
  return at(id) ? int(told().type) : -1;
}
DHDAPI const char *dhdGetSystemName(char id) {
  return at(id) ? (active_wrist() ? "stand-in sigma.7" : "stand-in omega") : nullptr;
}
DHDAPI int dhdGetSerialNumber(unsigned short *serial, char id) {
  if (!at(id)) return -1;
  *serial = (unsigned short)(4000 + index_of(id));
  return 0;
}
DHDAPI int dhdGetVersion(double *version, char id) {
  if (!at(id)) return -1;
  *version = 3.14;
  return 0;
}
DHDAPI bool dhdHasBase(char) {
  return true;
}
DHDAPI bool dhdHasWrist(char) {
  return wrist();
}
DHDAPI bool dhdHasActiveWrist(char) {
  return active_wrist();
}
DHDAPI bool dhdHasGripper(char) {
  return gripper();
}
DHDAPI bool dhdHasActiveGripper(char) {
  return gripper();
}
DHDAPI bool dhdIsLeftHanded(char) {
  return told().left_handed != 0;
}
DHDAPI double dhdGetComFreq(char) {
  return 1.0;
}
DHDAPI int dhdGetComMode(char) {
  return 3;
}

DHDAPI int dhdGetStatus(int *status, char id) {
  const Lock lock(world().mutex);
  Device *const device = at(id);
  if (!device) return -1;
  std::memset(status, 0, 17 * sizeof *status);
  status[0] = status[1] = status[2] = !device->gone;
  status[3] = device->reset;
  status[5] = device->forces && device->next >= device->on_from;
  status[6] = !status[5];
  status[8] = wrist();
  status[14] = status[5] ? 0 : device->cause;
  return 0;
}

DHDAPI int dhdGetPosition(double *x, double *y, double *z, char id) {
  const Lock lock(world().mutex);
  double p[3] = {};
  const int code = sample(id, p);
  if (code < 0) return code;
  *x = p[0];
  *y = p[1];
  *z = p[2];
  return code;
}

DHDAPI int dhdGetOrientationFrame(double *matrix, char id) {
  const Lock lock(world().mutex);
  Device *const device = at(id);
  if (!device) return -1;
  orientation(*device, matrix);
  return 0;
}

DHDAPI int dhdGetPositionAndOrientationFrame(double *x, double *y, double *z, double *matrix,
                                             char id) {
  const Lock lock(world().mutex);
  const int code = dhdGetPosition(x, y, z, id);
  if (code >= 0) dhdGetOrientationFrame(matrix, id);
  return code;
}

DHDAPI int dhdGetLinearVelocity(double *x, double *y, double *z, char id) {
  const Lock lock(world().mutex);
  Device *const device = at(id);
  if (!device) return -1;
  const double angle = kTurn * double(device->tick), speed = kRadius * kTurn * 1000;
  *x = 0;
  *y = -speed * std::sin(angle);
  *z = speed * std::cos(angle);
  return 0;
}

// Half a radian, of a finger of 80 mm; left-handed devices have the opposite sign.
DHDAPI int dhdGetGripperAngleRad(double *angle, char id) {
  if (!at(id) || !gripper()) return refuse(6);
  *angle = told().left_handed ? -0.5 : 0.5;
  return 0;
}
DHDAPI int dhdGetGripperGap(double *gap, char id) {
  if (!at(id) || !gripper()) return refuse(6);
  *gap = 0.5 * 0.08;
  return 0;
}

DHDAPI unsigned dhdGetButtonMask(char id) {
  return at(id) ? unsigned(told().buttons) : 0;
}
DHDAPI int dhdGetButton(int index, char id) {
  return int(dhdGetButtonMask(id) >> index & 1);
}

DHDAPI int dhdEnableForce(unsigned char on, char id) {
  const Lock lock(world().mutex);
  if (!at(id)) return -1;
  told().enables[index_of(id)] += on;
  switch_forces(id, on != 0);
  return 0;
}
DHDAPI int dhdStop(char id) {
  const Lock lock(world().mutex);
  if (!at(id)) return -1;
  ++told().stops[index_of(id)];
  switch_forces(id, false);
  return 0;
}
DHDAPI int dhdSetForceAndTorqueAndGripperForce(double fx, double fy, double fz, double tx,
                                               double ty, double tz, double grip, char id) {
  const Lock lock(world().mutex);
  const double wanted[7] = {fx, fy, fz, tx, ty, tz, grip};
  return set_force(id, wanted);
}
DHDAPI int dhdSetForceAndTorque(double fx, double fy, double fz, double tx, double ty, double tz,
                                char id) {
  return dhdSetForceAndTorqueAndGripperForce(fx, fy, fz, tx, ty, tz, 0, id);
}
DHDAPI int dhdSetForceAndGripperForce(double fx, double fy, double fz, double grip, char id) {
  return dhdSetForceAndTorqueAndGripperForce(fx, fy, fz, 0, 0, 0, grip, id);
}
DHDAPI int dhdSetForce(double fx, double fy, double fz, char id) {
  return dhdSetForceAndTorqueAndGripperForce(fx, fy, fz, 0, 0, 0, 0, id);
}
DHDAPI int dhdGetForce(double *x, double *y, double *z, char id) {
  const Lock lock(world().mutex);
  Device *const device = at(id);
  if (!device) return -1;
  *x = device->force[0];
  *y = device->force[1];
  *z = device->force[2];
  return 0;
}
DHDAPI int dhdSetMaxForce(double most, char id) {
  const Lock lock(world().mutex);
  Device *const device = at(id);
  if (!device) return -1;
  device->max_force = most;
  told().max_force_mn[index_of(id)] = std::lround(most * 1000);
  return 0;
}
DHDAPI double dhdGetMaxForce(char id) {
  return at(id) ? at(id)->max_force : -1;
}

// Functions that a driver must not call.
DHDAPI int dhdEnableExpertMode() {
  return unsafe();
}
DHDAPI int dhdDisableExpertMode() {
  return 0;
}
DHDAPI int dhdSetVelocityThreshold(unsigned, char) {
  return unsafe();
}
DHDAPI int dhdSetWatchdog(unsigned char, char) {
  return unsafe();
}
DHDAPI int dhdSetTimeGuard(int, char) {
  return unsafe();
}

DHDAPI bool drdIsSupported(char) {
  return told().supported != 0;
}
DHDAPI bool drdIsInitialized(char id) {
  return at(id) && !at(id)->reset;
}
DHDAPI int drdAutoInit(char id) {
  const Lock lock(world().mutex);
  Device *const device = at(id);
  if (!device) return -1;
  ++told().moved;
  if (told().stuck) return refuse(7);
  device->reset = false;
  return 0;
}
DHDAPI int drdStop(bool, char) {
  return 0;
}
DHDAPI bool drdIsRunning(char) {
  return false;
}
DHDAPI bool drdIsMoving(char) {
  return false;
}
DHDAPI bool drdIsFiltering(char) {
  return false;
}
