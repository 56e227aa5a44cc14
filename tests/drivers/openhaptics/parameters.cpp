// Parameters of the stand-in's devices: read and set by a program.
#include <cmath>
#include <cstring>
#include <limits>

#include "inside.h"

namespace hd {
namespace {

constexpr double kTurn = 2 * 3.14159265358979323846 / 1000;  // rad a tick
constexpr double kRadius = 30;                               // mm

// State may be read and forces set within a frame only.
Device *in_frame(const char *what) {
  Device *const device = current();
  if (!device) return nullptr;
  if (device->in_frame) return device;
  misuse(what);
  return nullptr;
}

// Seen from the front of the device, a circle of 30 mm in 1000 ticks, 10 mm towards the user; the
// stylus rotates with it. The second device is 5 mm higher.
void position(const Device &device, double *out) {
  const double angle = kTurn * double(device.tick);
  const bool second = &device != world().devices;
  out[0] = kRadius * std::cos(angle);
  out[1] = kRadius * std::sin(angle) + (second ? 5 : 0);
  out[2] = 10;
  if (!world().reads_numbers) out[0] = out[1] = out[2] = 0;
  if (device.tick == told().nan_at) out[0] = std::numeric_limits<double>::quiet_NaN();
}

void velocity(const Device &device, double *out) {
  const double angle = kTurn * double(device.tick), speed = kRadius * kTurn * 1000;
  out[0] = -speed * std::sin(angle);
  out[1] = speed * std::cos(angle);
  out[2] = 0;
}

void transform(const Device &device, double *m) {
  const double c = std::cos(kTurn * double(device.tick)), s = std::sin(kTurn * double(device.tick));
  const double columns[16] = {c, s, 0, 0, -s, c, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  std::memcpy(m, columns, sizeof columns);
  position(device, m + 12);
}

bool state(unsigned parameter, double *out) {
  Device *const device = in_frame("state outside a frame");
  if (!device) return true;
  if (parameter == 0x2050) position(*device, out);
  if (parameter == 0x2051) velocity(*device, out);
  if (parameter == 0x2052) transform(*device, out);
  if (parameter == 0x2605)
    for (int i = 0; i < 3; ++i) out[i] = double(told().temperature) / 100;
  if (parameter == 0x2700) std::memcpy(out, device->force, 3 * sizeof *out);
  if (parameter == 0x2701) std::memcpy(out, device->force + 3, 3 * sizeof *out);
  return true;
}

// Reads a constant parameter of a device; false: no such parameter.
bool property(unsigned parameter, double *out) {
  const double workspace[6] = {-80, -60, -35, 80, 60, 35};
  switch (parameter) {
    case 0x2551:
      std::memcpy(out, workspace, sizeof workspace);
      return true;
    case 0x2602:
      *out = 0.5;
      return true;
    case 0x2603:
      *out = kMaxForce;
      return true;
    case 0x2604:
      *out = 0.88;
      return true;
    case 0x2606:
      *out = 1000;
      return true;
    case 0x2609:
      *out = 0.003;
      return true;
    case 0x2622:
      *out = 188;
      return told().freedoms_out == 6;
    default:
      return false;
  }
}

}  // namespace
}  // namespace hd

using namespace hd;
using Lock = std::lock_guard<std::recursive_mutex>;

static void set_capability(unsigned capability, bool on) {
  const Lock lock(world().mutex);
  Device *const device = current();
  if (!device) return;
  if (capability < 0x4000 || capability > 0x4004) return raise(0x100, world().current);
  const unsigned bit = 1u << (capability - 0x4000);
  device->enabled = on ? device->enabled | bit : device->enabled & ~bit;
  told().enabled[world().current] = device->enabled;
}
HDAPI void hdEnable(unsigned capability) {
  set_capability(capability, true);
}
HDAPI void hdDisable(unsigned capability) {
  set_capability(capability, false);
}
HDAPI unsigned char hdIsEnabled(unsigned capability) {
  const Lock lock(world().mutex);
  Device *const device = current();
  return device && (device->enabled >> (capability - 0x4000) & 1);
}

HDAPI void hdGetBooleanv(unsigned parameter, unsigned char *out) {
  const Lock lock(world().mutex);
  if (parameter != 0x2002) return raise(0x100, world().current);
  if (in_frame("switch outside a frame")) *out = told().parked != 0;
}

HDAPI void hdGetIntegerv(unsigned parameter, int *out) {
  const Lock lock(world().mutex);
  switch (parameter) {
    case 0x2000:
      if (in_frame("buttons outside a frame")) *out = int(told().buttons);
      return;
    case 0x2553:
      *out = 6;
      return;
    case 0x2554:
      *out = int(told().freedoms_out);
      return;
    case 0x2555:
      *out = int(told().style);
      return;
    case 0x2600:
      *out = 1000;
      return;
    default:
      raise(0x100, world().current);
  }
}

HDAPI void hdGetDoublev(unsigned parameter, double *out) {
  const Lock lock(world().mutex);
  if (!current()) return;
  const bool is_state = (parameter >= 0x2050 && parameter <= 0x2052) || parameter == 0x2605 ||
                        parameter == 0x2700 || parameter == 0x2701;
  if (!(is_state ? state(parameter, out) : property(parameter, out))) raise(0x100, world().current);
}

HDAPI void hdGetFloatv(unsigned parameter, float *out) {
  double values[16] = {};
  hdGetDoublev(parameter, values);
  const int count = parameter == 0x2052 ? 16 : parameter == 0x2551 ? 6 : parameter < 0x2100 ? 3 : 1;
  for (int i = 0; i < count; ++i) out[i] = float(values[i]);
}

HDAPI void hdGetLongv(unsigned parameter, long *out) {
  const Lock lock(world().mutex);
  if (parameter != 0x2010) return raise(0x100, world().current);
  if (in_frame("encoders outside a frame"))
    for (int i = 0; i < 6; ++i) out[i] = current()->tick;
}

HDAPI const char *hdGetString(unsigned parameter) {
  const Lock lock(world().mutex);
  switch (parameter) {
    case 0x2500:
      return "3.4.0";
    case 0x2501:
      return "Stand-in Touch";
    case 0x2502:
      return "2026.11.22";
    case 0x2503:
      return "libmvs";
    case 0x2504:
      return world().current == 1 ? "STAND-IN-2" : "STAND-IN-1";
    case 0x2505:
      return "1.0";
    default:
      return raise(0x100, world().current), nullptr;
  }
}

HDAPI void hdSetDoublev(unsigned parameter, const double *values) {
  const Lock lock(world().mutex);
  Device *const device = in_frame("force outside a frame");
  if (!device) return;
  const bool torque = parameter == 0x2701;
  if (parameter != 0x2700 && !(torque && told().freedoms_out == 6))
    return raise(0x100, world().current);
  for (int i = 0; i < 3; ++i) {
    if (!std::isfinite(values[i])) return misuse("a force that is no number", 0x101);
    device->force[(torque ? 3 : 0) + i] = values[i];
  }
}
HDAPI void hdSetFloatv(unsigned parameter, const float *values) {
  const double doubles[3] = {values[0], values[1], values[2]};
  hdSetDoublev(parameter, doubles);
}
HDAPI void hdSetBooleanv(unsigned, const unsigned char *) {
  raise(0x100, world().current);
}
HDAPI void hdSetIntegerv(unsigned, const int *) {
  raise(0x100, world().current);
}
HDAPI void hdSetLongv(unsigned, const long *) {
  raise(0x100, world().current);
}

HDAPI unsigned hdCheckCalibration() {
  const Lock lock(world().mutex);
  Device *const device = current();
  return device ? device->calibration : 0x5002;
}
HDAPI unsigned hdCheckCalibrationStyle() {
  return unsigned(told().style);
}
HDAPI void hdUpdateCalibration(unsigned style) {
  const Lock lock(world().mutex);
  Device *const device = current();
  if (!device) return;
  if (!(unsigned(told().style) & style)) return misuse("a style that it does not have", 0x101);
  if (device->calibration == 0x5001) device->calibration = 0x5000;
}
HDAPI void hdUpdateCalibrationMessage(unsigned) {}
HDAPI void hdScaleGimbalAngles(double, double, double, double *) {}
HDAPI unsigned char hdDeploymentLicense(const char *, const char *, const char *) {
  return 1;
}
