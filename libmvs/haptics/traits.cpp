// Checks of a driver's description of its device, and the limits that follow from it.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/error.h"
#include "base/option_checks.h"
#include "base/utf8.h"
#include "haptics/servo_types.h"

namespace mvs::core {
namespace {

// The weakest device of the table in haptic_drivers/hand/README.md (3D Systems Touch).
constexpr double weakest_force = 3.3, weakest_continuous = 0.88;  // N
constexpr double weakest_stiffness = 400, weakest_damping = 4;    // N/m, N s/m
// The weakest device with motors for torque (PHANTOM Premium 6DOF; commonly quoted, not measured).
constexpr double weakest_torque = 0.188;  // N m
constexpr double usual_turns = 20;        // rad/s, limit of the angular speed
constexpr double usual_rate = 1000;       // Hz
constexpr double usual_speed = 1;         // m/s
constexpr double max_force = 1000, max_extent = 10, max_stiffness = 1e6,
                 max_torque = 100;  // N, m, N/m, N m: of any device
constexpr double slowest_rate = 100, fastest_rate = 10000, fastest = 100;  // Hz, Hz, m/s

// Returns the fallback for 0.
double number(double given, double fallback, double most, const char *driver, const char *what) {
  MVS_MUST(given >= 0 && given <= most, MVS_E_DEVICE, driver,
           "the driver reports %s %g: it has to be 0 (unknown) to %g; do not use it", what, given,
           most);
  return given == 0 ? fallback : given;
}

void read_frame(const mvs_driver_info &given, const char *driver, DeviceTraits &traits) {
  if (std::all_of(given.frame, given.frame + 12, [](double f) { return f == 0; })) return;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) traits.turn(r, c) = given.frame[4 * r + c];
    traits.shift[r] = given.frame[4 * r + 3];
  }
  const Mat3 gram = traits.turn * traits.turn.transpose() - Mat3::Identity();
  const double determinant = traits.turn.row(0).cross(traits.turn.row(1)).dot(traits.turn.row(2));
  MVS_MUST(gram.norm() < 1e-6 && determinant > 0 && traits.shift.norm() <= max_extent, MVS_E_DEVICE,
           driver, "the driver reports a frame that is not a rotation and offset: do not use it");
  traits.turn_quaternion = Eigen::Quaterniond(traits.turn);
}

// Moves the workspace box to the frame of the device, with its centre at the origin.
void read_workspace(const mvs_driver_info &given, const char *driver, DeviceTraits &traits) {
  const Vec3 low = Vec3::Map(given.workspace_min), high = Vec3::Map(given.workspace_max);
  if (low.isZero(0) && high.isZero(0)) return;
  const Vec3 size = high - low;
  MVS_MUST((size.array() > 0).all() && (low.array() >= -max_extent).all() &&
               (high.array() <= max_extent).all(),
           MVS_E_DEVICE, driver,
           "the driver reports a workspace that is not a box within %g m: do not use it",
           max_extent);
  const Vec3 half = 0.5 * traits.turn.cwiseAbs() * size;
  traits.shift = -(traits.turn * (0.5 * (low + high)));
  std::copy(half.data(), half.data() + 3, traits.info.workspace_max);
  for (int k = 0; k < 3; ++k) traits.info.workspace_min[k] = -half[k];
  traits.has_workspace = true;
}

// Limits of torque; unknown ones are those of the force at the lever peak_torque / peak_force. They
// are checked also for a device without torque, which has limits of 0.
void read_torque(const mvs_driver_info &given, const char *driver, DeviceTraits &traits) {
  mvs_device_info &info = traits.info;
  const double peak =
      number(given.peak_torque, weakest_torque, max_torque, driver, "the peak torque");
  const double lever = std::min(peak / info.peak_force, max_extent);
  const double continuous = number(given.continuous_torque, lever * info.continuous_force,
                                   max_torque, driver, "the continuous torque");
  const double stiffness = number(given.max_angular_stiffness, lever * lever * info.max_stiffness,
                                  max_stiffness, driver, "the largest angular stiffness");
  const double damping = number(given.max_angular_damping, lever * lever * info.max_damping,
                                max_stiffness, driver, "the angular damping");
  traits.renders_torque = given.freedoms_out == 6 && given.freedoms_in == 6;
  if (!traits.renders_torque) return;
  info.peak_torque = peak;
  info.continuous_torque = std::min(peak, continuous);
  info.max_angular_stiffness = stiffness;
  info.max_angular_damping = damping;
}

// Copies a text of a driver, which may lack its terminating zero.
void copy_name(const char *from, char (&to)[64]) {
  copy_text(to, {from, strnlen(from, sizeof to - 1)});
}

}  // namespace

DeviceTraits read_traits(const mvs_driver_info &given, const char *driver) {
  DeviceTraits traits;
  mvs_device_info &info = traits.info;
  const auto freedoms = [&](uint32_t n) { return n == 0 || n == 3 || n == 6; };
  MVS_MUST(freedoms(given.freedoms_in) && given.freedoms_in > 0 && freedoms(given.freedoms_out) &&
               given.buttons <= 32,
           MVS_E_DEVICE, driver,
           "the driver reports %u freedoms in, %u out and %u buttons: no device has these",
           given.freedoms_in, given.freedoms_out, given.buttons);
  info.freedoms_in = given.freedoms_in;
  info.freedoms_out = given.freedoms_out;
  info.buttons = given.buttons;
  info.peak_force = number(given.peak_force, weakest_force, max_force, driver, "the peak force");
  info.continuous_force = std::min(
      info.peak_force, number(given.continuous_force, std::min(weakest_continuous, info.peak_force),
                              max_force, driver, "the continuous force"));
  info.max_stiffness = number(given.max_stiffness, weakest_stiffness, max_stiffness, driver,
                              "the largest stiffness");
  info.max_damping =
      number(given.max_damping, weakest_damping, max_stiffness, driver, "the damping");
  info.max_speed = number(given.max_speed, usual_speed, fastest, driver, "the largest speed");
  info.rate = number(given.rate, usual_rate, fastest_rate, driver, "the rate");
  MVS_MUST(info.rate >= slowest_rate, MVS_E_DEVICE, driver,
           "the driver's rate is %g Hz: below %g Hz no force can be stable", info.rate,
           slowest_rate);
  read_torque(given, driver, traits);
  traits.has_deadman = given.has_deadman != 0;
  copy_name(driver, info.driver);
  copy_name(given.model, info.model);
  copy_name(given.serial, info.serial);
  copy_name(given.firmware, info.firmware);
  read_frame(given, driver, traits);
  read_workspace(given, driver, traits);
  return traits;
}

mvs_device_limits resolve_limits(const mvs_device_limits &given, const mvs_device_info &info) {
  must_be_zero(given.reserved, "limits.reserved");
  mvs_device_limits out = given;
  const auto at_most = [&](double wanted, double device, const char *what) {
    return std::min(or_default(wanted, device, 1e-6, max_stiffness, what), device);
  };
  out.force = at_most(given.force, info.peak_force, "limits.force");
  out.continuous_force = std::min(
      out.force, at_most(given.continuous_force, info.continuous_force, "limits.continuous_force"));
  out.stiffness = at_most(given.stiffness, info.max_stiffness, "limits.stiffness");
  out.thermal_s = or_default(given.thermal_s, 10, 0.1, 1000, "limits.thermal_s");
  out.slew = or_default(given.slew, default_slew * out.force, 1e-3, 1e6, "limits.slew");
  out.gate = or_default(given.gate, 0.2, 1e-3, max_force, "limits.gate");
  out.ramp_s = or_default(given.ramp_s, 1, 0.01, 10, "limits.ramp_s");
  out.speed =
      or_default(given.speed, std::min(info.max_speed, usual_speed), 1e-3, fastest, "limits.speed");
  out.stale_s = or_default(given.stale_s, 0.1, 0.005, 10, "limits.stale_s");
  out.fade_s = or_default(given.fade_s, 0.05, 1e-3, 1, "limits.fade_s");
  out.torque = at_most(given.torque, info.peak_torque, "limits.torque");
  out.continuous_torque = std::min(
      out.torque,
      at_most(given.continuous_torque, info.continuous_torque, "limits.continuous_torque"));
  out.torque_slew =
      or_default(given.torque_slew, default_slew * out.torque, 1e-6, 1e6, "limits.torque_slew");
  out.angular_stiffness =
      at_most(given.angular_stiffness, info.max_angular_stiffness, "limits.angular_stiffness");
  out.angular_speed =
      or_default(given.angular_speed, usual_turns, 0.1, fastest, "limits.angular_speed");
  if (info.peak_torque == 0) out.torque_slew = out.angular_speed = 0;
  return out;
}

}  // namespace mvs::core
