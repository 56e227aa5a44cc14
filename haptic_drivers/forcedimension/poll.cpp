// read() and write(), stop() and panic(): what happens at the device's rate, and what ends it.
#include <chrono>
#include <cmath>
#include <cstring>
#include <thread>

#include "device.h"

namespace forcedimension {
namespace {

constexpr int kStatusEvery = 10;                                            // reads
constexpr uint64_t kPatience = uint64_t(MVS_DRIVER_PATIENCE_MS) * 1000000;  // ns

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

// The rotation of a matrix by rows as a quaternion w x y z, the largest of the four first, so that
// nothing small divides. Not a number stays not a number.
void quaternion(const double m[3][3], double *q) {
  const double squares[4] = {m[0][0] + m[1][1] + m[2][2], m[0][0] - m[1][1] - m[2][2],
                             m[1][1] - m[0][0] - m[2][2], m[2][2] - m[0][0] - m[1][1]};
  int k = 0;
  for (int i = 1; i < 4; ++i)
    if (squares[i] > squares[k]) k = i;
  const double twice = std::sqrt(1 + squares[k]), half = 0.5 / twice;
  const double x = m[2][1] - m[1][2], y = m[0][2] - m[2][0], z = m[1][0] - m[0][1];
  const double xy = m[0][1] + m[1][0], xz = m[0][2] + m[2][0], yz = m[1][2] + m[2][1];
  const double rows[4][4] = {{0, x, y, z}, {x, 0, xy, xz}, {y, xy, 0, yz}, {z, xz, yz, 0}};
  for (int i = 0; i < 4; ++i) q[i] = i == k ? 0.5 * twice : rows[k][i] * half;
}

int read_pose(const mvs_driver_device &device, mvs_driver_state &state) {
  double *const p = state.position;
  if (!device.has_wrist) return dhd().get_position(&p[0], &p[1], &p[2], device.id);
  double frame[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const int code = dhd().get_pose(&p[0], &p[1], &p[2], &frame[0][0], device.id);
  if (code >= 0) quaternion(frame, state.orientation);
  return code;
}

// The gripper's force is one at the finger: its lever is what opens a gap for an angle.
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
  device.sentence.assign(what);  // open() made room for it
  return code;
}

// A sample that was answered for.
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
  if (code == kTimeGuard) return;  // the sample before
  state.time_ns = device.now_ns;
  ++state.sequence;
}

// A cable that crackles is not a loss yet: the sample before stands until then.
bool is_lost(const mvs_driver_device &device) {
  return device.now_ns - device.good_ns > kPatience;
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

bool is_finite(const mvs_driver_force &force) {
  for (int i = 0; i < 3; ++i)
    if (!std::isfinite(force.force[i]) || !std::isfinite(force.torque[i])) return false;
  return std::isfinite(force.gripper);
}

int set(const mvs_driver_device &device, const mvs_driver_force &force) {
  const double *const f = force.force, *const t = force.torque;
  const double grip = device.lever > 0 ? device.gripper_sign * force.gripper / device.lever : 0;
  return dhd().set_force(f[0], f[1], f[2], t[0], t[1], t[2], grip, device.id);
}

// Motors off: no force, then the brakes, with which an arm sinks rather than falls.
int switch_off(mvs_driver_device &device) {
  const int code = set(device, {});
  const int stopped = dhd().stop(device.id);
  return code < 0 ? code : stopped;
}

// Only when the wish changes: forces that the device took off by itself stay off until they were
// given up, and wanted again.
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
  const int code = set(device, is_finite(force) ? force : mvs_driver_force{});
  device.saturated = code == kMotorSaturated;
  // one that fails for long fails to be read, too
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

// Waits for the call that another thread may be in, not for one that never comes back.
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

// A signal that came while DHD was at work may not call it; its watchdog, which is on, is then what
// takes the forces off.
void panic(mvs_driver_device *device) {
  device->stopped = true;
  const Turn turn(*device);
  if (turn.is_mine()) set(*device, {});
}

}  // namespace forcedimension
