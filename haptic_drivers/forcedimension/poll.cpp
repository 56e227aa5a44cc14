// read(), write(), stop() and panic(): the calls at the device's rate.
#include <chrono>
#include <cmath>
#include <cstring>
#include <thread>

#include "common/rotation.h"
#include "device.h"

namespace forcedimension {
namespace {

constexpr int kStatusEvery = 10;                                           // reads
constexpr uint64_t kTimeout = uint64_t(MVS_DRIVER_PATIENCE_MS) * 1000000;  // ns

// Try-lock of mvs_driver_device::busy.
class Turn {
 public:
  explicit Turn(mvs_driver_device &device) : device_(device), mine_(!device.busy.exchange(true)) {}
  ~Turn() {
    if (mine_) device_.busy = false;
  }
  Turn(const Turn &) = delete;
  Turn &operator=(const Turn &) = delete;
  bool is_mine() const { return mine_; }

 private:
  mvs_driver_device &device_;
  bool mine_;
};

int read_pose(const mvs_driver_device &device, mvs_driver_state &state) {
  double *const p = state.position;
  if (!device.has_wrist) return dhd().get_position(&p[0], &p[1], &p[2], device.id);
  double frame[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const int code = dhd().get_pose(&p[0], &p[1], &p[2], &frame[0][0], device.id);
  if (code >= 0) driver::quaternion(frame, state.orientation);
  return code;
}

// DHD takes the gripper force at the finger: its lever is the gap over the angle.
void read_gripper(mvs_driver_device &device) {
  const double enough = 0.1;  // rad
  double angle = 0, gap = 0;
  if (dhd().get_gripper_angle(&angle, device.id) < 0) return;
  angle *= device.gripper_sign;
  device.state.gripper = angle < 0 ? 0 : angle;
  if (angle > enough && dhd().get_gripper_gap(&gap, device.id) >= 0)
    device.lever = std::abs(gap) / angle;
}

void read_status(mvs_driver_device &device) {
  if (device.grace > 0) --device.grace;
  if (device.until_status-- > 0) return;
  device.until_status = kStatusEvery;
  int status[kStatusCount] = {};
  if (dhd().get_status(status, device.id) >= 0) std::memcpy(device.status, status, sizeof status);
}

uint32_t flags(const mvs_driver_device &device, bool has_velocity) {
  const bool on = device.on && device.status[kForce];
  return (device.status[kReset] ? 0 : MVS_DRIVER_FLAG_CALIBRATED) |
         (has_velocity ? MVS_DRIVER_FLAG_VELOCITY : 0) | (on ? MVS_DRIVER_FLAG_FORCE_ON : 0) |
         (device.saturated ? MVS_DRIVER_FLAG_SATURATED : 0);
}

int32_t say(mvs_driver_device &device, int32_t code, const char *what) {
  device.sentence.assign(what);  // open() reserved its memory
  return code;
}

// Stores a successful sample.
void take(mvs_driver_device &device, int code, const mvs_driver_state &pose) {
  mvs_driver_state &state = device.state;
  double *const v = state.velocity;
  const bool has_velocity = dhd().get_velocity(&v[0], &v[1], &v[2], device.id) >= 0;
  std::memcpy(state.position, pose.position, sizeof state.position);
  std::memcpy(state.orientation, pose.orientation, sizeof state.orientation);
  if (device.has_gripper) read_gripper(device);
  state.buttons = dhd().get_button_mask(device.id);
  state.flags = flags(device, has_velocity);
  const bool off = device.on && !device.stopped && device.grace == 0 && !device.status[kForce];
  state.cause = off ? cause_of(device.status[kForceOffCause]) : uint32_t(MVS_CAUSE_NONE);
  if (code == kTimeGuard) return;  // the previous sample
  state.time_ns = device.now_ns;
  ++state.sequence;
}

// Short failures keep the previous sample; a device is lost after 100 ms without an answer.
bool is_lost(const mvs_driver_device &device) {
  return device.now_ns - device.good_ns > kTimeout;
}

int32_t read_mine(mvs_driver_device &device) {
  mvs_driver_state pose = {};
  pose.orientation[0] = 1;
  const int code = read_pose(device, pose);
  read_status(device);
  if (code >= 0) {
    device.good_ns = device.now_ns;
    take(device, code, pose);
  } else {
    device.until_status = 0;
  }
  if (is_lost(device) || (code < 0 && !device.status[kConnected]))
    return say(device, MVS_DRIVER_E_LOST,
               "the device does not answer any more: check cable and power, then open it again");
  return MVS_DRIVER_OK;
}

int set(const mvs_driver_device &device, const mvs_driver_force &force) {
  const double *const f = force.force, *const t = force.torque;
  const double grip = device.lever > 0 ? device.gripper_sign * force.gripper / device.lever : 0;
  return dhd().set_force(f[0], f[1], f[2], t[0], t[1], t[2], grip, device.id);
}

// Motors off: zero force, then the brakes, with which an arm sinks slowly.
int switch_off(mvs_driver_device &device) {
  const int code = set(device, {});
  const int stopped = dhd().stop(device.id);
  return code < 0 ? code : stopped;
}

// Acts only on a change: forces that the device switched off stay off until `on` was 0 and is 1
// again.
void switch_to(mvs_driver_device &device, bool on) {
  if (device.on == on) return;
  if (on)
    dhd().enable_force(1, device.id);
  else
    switch_off(device);
  device.on = on;
  device.grace = kGrace;
  device.until_status = 0;
}

int32_t write_mine(mvs_driver_device &device, const mvs_driver_force &force) {
  const bool on = force.on && !device.stopped;
  switch_to(device, on);
  if (!on) return MVS_DRIVER_OK;
  const int code =
      set(device,
          driver::is_finite(force) && std::isfinite(force.gripper) ? force : mvs_driver_force{});
  device.saturated = code == kMotorSaturated;
  // a lasting failure is detected by read()
  return MVS_DRIVER_OK;
}

}  // namespace

int32_t read(mvs_driver_device *device, uint64_t now_ns, mvs_driver_state *out) {
  if (device->good_ns == 0) device->good_ns = now_ns;
  device->now_ns = now_ns;
  int32_t result = MVS_DRIVER_OK;
  {
    const Turn turn(*device);
    if (turn.is_mine()) result = read_mine(*device);
  }
  driver::give(device->state, out);
  return result;
}

int32_t write(mvs_driver_device *device, const mvs_driver_force *force) {
  const Turn turn(*device);
  return turn.is_mine() ? write_mine(*device, driver::take(force)) : int32_t(MVS_DRIVER_OK);
}

// Waits for a call of another thread, up to the time limit.
int32_t stop(mvs_driver_device *device) {
  device->stopped = true;
  for (unsigned i = 0; i < MVS_DRIVER_PATIENCE_MS; ++i) {
    const Turn turn(*device);
    if (turn.is_mine()) {
      switch_off(*device);
      return MVS_DRIVER_OK;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return MVS_DRIVER_OK;
}

// A signal that interrupted a call of DHD must not call it again; DHD's watchdog, which is on, then
// switches the forces off.
void panic(mvs_driver_device *device) {
  device->stopped = true;
  const Turn turn(*device);
  if (turn.is_mine()) set(*device, {});
}

}  // namespace forcedimension
