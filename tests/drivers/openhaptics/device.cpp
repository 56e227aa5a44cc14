// A stand-in for OpenHaptics' libHD.so: two devices whose stylus moves on a circle. Own code,
// written after the vendor's public guide; it is stricter than the vendor's library, so that
// mistakes show. parameters.cpp has the parameters of a frame.
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "inside.h"
#include "tests/drivers/stand_in_environment.h"

namespace hd {
namespace {

constexpr unsigned kNone = 0xFFFFFFFF;

void take_script(HdStandIn &in) {
  take_environment("HD_STAND_IN", {{"period_ns", &in.period_ns},
                                   {"unplug_at", &in.unplug_at},
                                   {"nan_at", &in.nan_at},
                                   {"silent_at", &in.silent_at},
                                   {"fail_at", &in.fail_at},
                                   {"fail_code", &in.fail_code},
                                   {"init_code", &in.init_code},
                                   {"init_times", &in.init_times},
                                   {"calibration", &in.calibration},
                                   {"style", &in.style},
                                   {"freedoms_out", &in.freedoms_out},
                                   {"temperature", &in.temperature},
                                   {"parked", &in.parked},
                                   {"buttons", &in.buttons}});
}

Device *at(unsigned handle) {
  if (handle < unsigned(HdStandIn::kDevices) && world().devices[handle].open)
    return &world().devices[handle];
  raise(0x104, handle);
  return nullptr;
}

// The motors' state at the end of a frame.
void commit(unsigned handle, Device &device) {
  const bool on = device.enabled & 1;
  double norm = 0;
  for (int i = 0; i < 3; ++i) norm += device.force[i] * device.force[i];
  norm = std::sqrt(norm);
  double scale = on ? 1 : 0;
  if (norm > kMaxForce && (device.enabled & 2))
    scale *= kMaxForce / norm;
  else if (on && norm > kMaxForce)
    raise(0x201, handle);
  HdStandIn &in = told();
  const long frame = in.frames[handle];
  for (int i = 0; i < 6; ++i)
    in.forces[handle][frame % HdStandIn::kKept][i] = device.force[i] * scale;
  ++in.frames[handle];
}

}  // namespace

HdStandIn &told() {
  static HdStandIn *const in = [] {
    auto *const made = new HdStandIn;
    take_script(*made);
    return made;
  }();
  return *in;
}

World &world() {
  static World *const all = new World;
  return *all;
}

void raise(unsigned code, unsigned device) {
  world().errors.push_back({code, int(code), device});
}

void misuse(const char *what, unsigned code) {
  ++told().misuses;
  told().misuse = what;
  raise(code, world().current);
}

Device *current() {
  return at(world().current);
}

}  // namespace hd

using namespace hd;
using Lock = std::lock_guard<std::recursive_mutex>;

extern "C" __attribute__((visibility("default"))) HdStandIn *hd_stand_in() {
  return &told();
}

HDAPI unsigned hdInitDevice(const char *name) {
  const Lock lock(world().mutex);
  const std::string wanted = name ? name : "Default Device";
  const unsigned handle = wanted == "Default Device" ? 0 : wanted == "Phantom2" ? 1 : kNone;
  if (handle == kNone) return raise(0x303, kNone), kNone;
  if (told().init_times > 0) {
    --told().init_times;
    return raise(unsigned(told().init_code), handle), kNone;
  }
  Device &device = world().devices[handle];
  if (device.gone && told().unplug_at >= 0) return raise(0x302, handle), kNone;
  if (device.open) return raise(0x301, handle), handle;
  // as the vendor's library reads its configuration: in the locale of the program
  world().reads_numbers = std::strtod("0.5", nullptr) > 0.4;
  device = Device();
  device.open = true;
  device.calibration = unsigned(told().calibration);
  told().open[handle] = 1;
  world().current = handle;
  return handle;
}

HDAPI void hdDisableDevice(unsigned handle) {
  hang();
  const Lock lock(world().mutex);
  if (handle < unsigned(HdStandIn::kDevices)) {
    world().devices[handle].open = false;
    told().open[handle] = 0;
    told().enabled[handle] = 0;
  } else {
    raise(0x104, handle);
  }
}

HDAPI void hdMakeCurrentDevice(unsigned handle) {
  const Lock lock(world().mutex);
  if (at(handle)) world().current = handle;
}

HDAPI unsigned hdGetCurrentDevice() {
  const Lock lock(world().mutex);
  return world().current;
}

HDAPI void hdBeginFrame(unsigned handle) {
  const Lock lock(world().mutex);
  Device *const device = at(handle);
  if (!device) return;
  if (device->in_frame) return misuse("a frame in a frame", 0x400);
  device->in_frame = true;
  world().current = handle;
  const long tick = scheduler_tick();
  if (tick < 0) return;
  device->tick = tick;
  if (told().unplug_at >= 0 && tick >= told().unplug_at) device->gone = true;
  if (device->gone) raise(0x302, handle);
  if (tick == told().fail_at && handle == unsigned(told().fail_device))
    raise(unsigned(told().fail_code), unsigned(told().fail_of));
}

HDAPI void hdEndFrame(unsigned handle) {
  const Lock lock(world().mutex);
  Device *const device = at(handle);
  if (!device) return;
  if (!device->in_frame) return misuse("the end of no frame", 0x401);
  device->in_frame = false;
  if (scheduler_tick() >= 0) commit(handle, *device);
}

HDAPI ErrorInfo hdGetError() {
  const Lock lock(world().mutex);
  if (world().errors.empty()) return {0, 0, 0};
  const ErrorInfo error = world().errors.back();
  world().errors.pop_back();
  return error;
}

HDAPI const char *hdGetErrorString(unsigned code) {
  switch (code) {
    case 0x200:
      return "HD_WARM_MOTORS";
    case 0x300:
      return "HD_DEVICE_FAULT";
    case 0x301:
      return "HD_DEVICE_ALREADY_INITIATED";
    case 0x302:
      return "HD_COMM_ERROR";
    case 0x303:
      return "HD_COMM_CONFIG_ERROR";
    case 0x600:
      return "HD_INVALID_LICENSE";
    default:
      return "HD_ERROR";
  }
}
