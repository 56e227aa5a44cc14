// Driver for the pointer of a program's window: position and buttons, no force.
#include <algorithm>
#include <cstring>
#include <memory>
#include <string>

#include "channel.h"
#include "common/options.h"
#include "follower.h"

using namespace mouse;
using driver::Fault;

struct mvs_driver_device {
  explicit mvs_driver_device(double time) : follower(time) {}

  Channel channel;
  Follower follower;
  Fault fault;
  double target[3] = {};
  uint32_t buttons = 0;
  uint64_t last_ns = 0, sequence = 0;
  bool placed = false;  // the hand has started at the first position of the pointer
};

namespace {

constexpr char kName[] = "pointer";
constexpr char kModel[] = "pointer of a window";

// m, half the edge of the box of the hand, about the reach of a stylus without moving the arm.
constexpr double kReach = 0.05;

const char *const kNoWindow =
    "no program has named the pointer of its window: start the example phantom of the sources of "
    "libmvs, or give the option pointer, the name of the shared memory into which your program "
    "writes its pointer (haptic_drivers/mouse/pointer.h there)";

// Returns the name of the shared memory; refuses a call without a window.
std::string window_of(const mvs_driver_host *host) {
  const auto named = driver::Options(host).text("pointer");
  if (!named) driver::refuse(MVS_DRIVER_E_ABSENT, kNoWindow);
  return *named;
}

int32_t list(const mvs_driver_host *host, mvs_driver_found found, void *user) {
  return driver::guarded([&] {
    Channel channel;
    Fault fault;
    driver::must(channel.open(window_of(host), fault), fault);
    found(user, kName, kModel);
  });
}

int32_t doctor(const mvs_driver_host *host, mvs_driver_finding finding, void *user) {
  const int32_t code = list(
      host, [](void *, const char *, const char *) {}, nullptr);
  if (code == MVS_DRIVER_OK)
    finding(user, 1, "window", "its pointer is there");
  else
    finding(user, driver::Options(host).given("pointer") ? 0 : 2, "window", driver::last_sentence);
  return MVS_DRIVER_OK;
}

int32_t open_device(const mvs_driver_host *host, const char *name, mvs_driver_device **device) {
  return driver::guarded([&] {
    *device = nullptr;
    const double time = driver::Options(host).number("smooth", kTime, 0.001, 1);
    const std::string window = window_of(host);
    if (name && std::strcmp(name, kName) != 0)
      driver::refuse(MVS_DRIVER_E_ABSENT, std::string("there is no device '") + name +
                                              "': the one of this driver is called " + kName);
    auto opened = std::make_unique<mvs_driver_device>(time);
    driver::must(opened->channel.open(window, opened->fault), opened->fault);
    *device = opened.release();
  });
}

int32_t info(mvs_driver_device *, mvs_driver_info *wanted) {
  mvs_driver_info own = {};
  own.freedoms_in = 3;
  own.buttons = 3;
  std::fill_n(own.workspace_min, 3, -kReach);
  std::fill_n(own.workspace_max, 3, kReach);
  own.max_speed = 2 * kFastest;
  own.rate = 1000;
  std::memcpy(own.model, kModel, sizeof kModel);
  driver::give(own, wanted);
  return MVS_DRIVER_OK;
}

// Takes the target of the window. In the middle of a write the last one stays.
void follow(mvs_driver_device &device, double seconds) {
  double at[3];
  uint32_t buttons = 0;
  if (mouse_pointer_read(&device.channel.pointer(), at, &buttons)) {
    bool finite = true;
    for (const double x : at) finite = finite && std::isfinite(x);
    for (int k = 0; finite && k < 3; ++k) device.target[k] = std::clamp(at[k], -kReach, kReach);
    device.buttons = buttons & 7;
    if (!device.placed) device.follower.place(device.target);
    device.placed = true;
  }
  device.follower.step(device.target, seconds);
}

int32_t read(mvs_driver_device *device, uint64_t now_ns, mvs_driver_state *wanted) {
  if (mouse_pointer_ended(&device->channel.pointer()))
    return device->fault.set(MVS_DRIVER_E_LOST, "the window of the pointer was closed");
  const bool anew = device->sequence == 0 || now_ns > device->last_ns;
  if (anew) {
    const uint64_t passed = device->sequence == 0 ? 0 : now_ns - device->last_ns;
    device->last_ns = now_ns;
    ++device->sequence;
    follow(*device, static_cast<double>(passed) * 1e-9);
  }
  mvs_driver_state state = {};
  state.flags = MVS_DRIVER_FLAG_CALIBRATED | MVS_DRIVER_FLAG_VELOCITY;
  state.time_ns = device->last_ns;
  state.sequence = device->sequence;
  state.orientation[0] = 1;
  std::copy_n(device->follower.position(), 3, state.position);
  std::copy_n(device->follower.velocity(), 3, state.velocity);
  state.buttons = device->buttons;
  driver::give(state, wanted);
  return MVS_DRIVER_OK;
}

// There are no motors.
int32_t start(mvs_driver_device *) {
  return MVS_DRIVER_OK;
}
int32_t write(mvs_driver_device *, const mvs_driver_force *) {
  return MVS_DRIVER_OK;
}
int32_t stop(mvs_driver_device *) {
  return MVS_DRIVER_OK;
}

void close_device(mvs_driver_device *device) {
  delete device;
}

const char *error(const mvs_driver_device *device) {
  return device ? device->fault.sentence : driver::last_sentence;
}

const char *const kOptions[] = {
    "pointer: shared memory of the window (haptic_drivers/mouse/pointer.h), set by its program",
    "smooth: s, time constant of the motion of the hand [0.02]", nullptr};

}  // namespace

int32_t mvs_driver_negotiate(const mvs_driver_host *host, mvs_driver_api *api) {
  mvs_driver_api ours = {};
  ours.version = MVS_DRIVER_VERSION;
  ours.name = "mouse";
  ours.about = "the pointer of a program's window, with the wheel for depth; no force";
  ours.options = kOptions;
  ours.list = list;
  ours.doctor = doctor;
  ours.open = open_device;
  ours.info = info;
  ours.start = start;
  ours.read = read;
  ours.write = write;
  ours.stop = stop;
  ours.close = close_device;
  ours.error = error;
  return driver::negotiate(host, api, ours);
}
