// The functions that the stand-in for libdrd.so exports.
#include <chrono>
#include <cmath>
#include <cstring>
#include <thread>

#include "inside.h"

using namespace dhd;

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
  return last_error();
}
DHDAPI const char *dhdErrorGetStr(int error) {
  return error_text(error);
}
DHDAPI const char *dhdErrorGetLastStr() {
  return dhdErrorGetStr(last_error());
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
