// A 3D mouse as a device of libmvs: a pose and buttons, no force.
#include <mvs/driver.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <memory>
#include <new>
#include <string>

#include "daemon.h"
#include "fault.h"
#include "puck.h"

using namespace spacenav;

struct mvs_driver_device {
  explicit mvs_driver_device(const Speeds &at_most) : speeds(at_most), puck(at_most) {}

  Daemon daemon;
  Speeds speeds;
  Puck puck;
  Fault fault;
  std::string model;
  int32_t button_count = 2;
  uint32_t buttons = 0;
  uint64_t last_ns = 0, sequence = 0;
  bool plugged = true;
};

namespace {

// The one name of what spacenavd has plugged in: it mixes all mice into one.
constexpr char kName[] = "spacenav";

// A pause between two reads longer than this is no time in which the puck was held: a program that
// was stopped does not find its instrument at the wall.
constexpr double kLongestStep = 0.05;

// Drops what the host has not read for so long that it would keep us here.
constexpr int kPacketsARead = 4096;

thread_local Fault unopened;

// What is filled is no more than the host has room for.
template <typename T>
void hand_over(T filled, T *wanted) {
  filled.struct_size = std::min(wanted->struct_size, static_cast<uint32_t>(sizeof filled));
  std::memcpy(wanted, &filled, filled.struct_size);
}

const char *option(const mvs_driver_host *host, const char *key) {
  return host->option ? host->option(host->host, key) : nullptr;
}

int32_t positive(const mvs_driver_host *host, const char *key, double &value) {
  const char *text = option(host, key);
  if (!text) return MVS_DRIVER_OK;
  double given = 0;
  const char *end = text + std::strlen(text);
  const auto read = std::from_chars(text, end, given);
  if (read.ec != std::errc() || read.ptr != end || !(given > 0 && given <= 10))
    return unopened.set(MVS_DRIVER_E_OPTION,
                        "option %s is '%.80s': give a number above 0, at most 10", key, text);
  value = given;
  return MVS_DRIVER_OK;
}

int32_t list(const mvs_driver_host *host, mvs_driver_found found, void *user) {
  Daemon daemon;
  std::string model;
  int32_t buttons = 0;
  const int32_t result = daemon.open(option(host, "socket"), unopened);
  if (result == MVS_DRIVER_E_LIBRARY) return MVS_DRIVER_OK;  // no daemon, no device
  if (result != MVS_DRIVER_OK) return result;
  if (daemon.device(model, buttons)) found(user, kName, model.c_str());
  if (daemon.protocol() == 0) found(user, kName, "3D mouse (if one is plugged in)");
  return MVS_DRIVER_OK;
}

int32_t doctor(const mvs_driver_host *host, mvs_driver_finding finding, void *user) {
  Daemon daemon;
  std::string model;
  int32_t buttons = 0;
  const int32_t result = daemon.open(option(host, "socket"), unopened);
  if (result != MVS_DRIVER_OK) {
    finding(user, 0, "daemon spacenavd", unopened.sentence);
    return MVS_DRIVER_OK;
  }
  finding(user, 1, "daemon spacenavd", ("it answers at " + daemon.path()).c_str());
  if (daemon.protocol() == 0) {
    finding(user, -1, "3D mouse",
            "this spacenavd is older than 1.0 and does not tell of devices: "
            "if nothing moves, see /var/log/spnavd.log");
  } else if (daemon.device(model, buttons)) {
    finding(user, 1, "3D mouse", (model + ", " + std::to_string(buttons) + " buttons").c_str());
  } else {
    finding(user, 0, "3D mouse",
            "spacenavd has found none: plug it in, and see "
            "/var/log/spnavd.log if it still does not");
  }
  return MVS_DRIVER_OK;
}

int32_t open_device(const mvs_driver_host *host, const char *name, mvs_driver_device **device) {
  *device = nullptr;
  if (name && std::strcmp(name, kName) != 0)
    return unopened.set(MVS_DRIVER_E_ABSENT, "there is no 3D mouse '%.80s': it is called %s", name,
                        kName);
  Speeds speeds;
  int32_t result = positive(host, "speed", speeds.move);
  if (result == MVS_DRIVER_OK) result = positive(host, "turn", speeds.turn);
  if (result != MVS_DRIVER_OK) return result;
  auto opened = std::make_unique<mvs_driver_device>(speeds);
  result = opened->daemon.open(option(host, "socket"), unopened);
  if (result != MVS_DRIVER_OK) return result;
  const bool found = opened->daemon.device(opened->model, opened->button_count);
  if (!found && opened->daemon.protocol() > 0)
    return unopened.set(MVS_DRIVER_E_ABSENT, "spacenavd at %s has no 3D mouse: plug one in",
                        opened->daemon.path().c_str());
  if (!found) opened->model = "3D mouse";
  *device = opened.release();
  return MVS_DRIVER_OK;
}

int32_t info(mvs_driver_device *device, mvs_driver_info *wanted) {
  mvs_driver_info told = {};
  told.freedoms_in = 6;
  told.buttons = static_cast<uint32_t>(device->button_count);
  std::fill_n(told.workspace_min, 3, -kReach);
  std::fill_n(told.workspace_max, 3, kReach);
  told.max_speed = device->speeds.move;
  told.rate = 250;  // twice that of the mice: nothing is felt here, only seen
  device->model.copy(told.model, sizeof told.model - 1);
  hand_over(told, wanted);
  return MVS_DRIVER_OK;
}

void take(mvs_driver_device &device, const Packet &packet) {
  const uint32_t number = static_cast<uint32_t>(packet.data[0]);
  const uint32_t bit = number < 32 ? 1u << number : 0;
  constexpr int32_t kNone[6] = {};
  switch (packet.type) {
    case kMotion:
      device.puck.deflect(packet.data);
      break;
    case kPress:
      device.buttons |= bit;
      break;
    case kRelease:
      device.buttons &= ~bit;
      break;
    case kDevice:
      device.plugged = number == 0;
      device.puck.deflect(kNone);
      device.buttons = 0;
      break;
    default:
      break;  // of a later spacenavd
  }
}

// Takes what spacenavd told since the last read.
int32_t listen(mvs_driver_device &device) {
  Packet packet;
  for (int i = 0; i < kPacketsARead; ++i) {
    const int32_t got = device.daemon.next(packet, device.fault);
    if (got < 0) return got;
    if (got == 0) break;
    take(device, packet);
  }
  if (device.plugged) return MVS_DRIVER_OK;
  return device.fault.set(MVS_DRIVER_E_LOST, "%s was unplugged: plug it in again",
                          device.model.c_str());
}

int32_t read(mvs_driver_device *device, uint64_t now_ns, mvs_driver_state *wanted) {
  const double seconds = device->sequence == 0 || now_ns < device->last_ns
                             ? 0
                             : static_cast<double>(now_ns - device->last_ns) * 1e-9;
  device->puck.step(std::min(seconds, kLongestStep));
  device->last_ns = now_ns;
  const int32_t result = listen(*device);
  if (result != MVS_DRIVER_OK) return result;
  mvs_driver_state state = {};
  state.flags = MVS_DRIVER_CALIBRATED | MVS_DRIVER_VELOCITY;
  state.time_ns = now_ns;
  state.sequence = ++device->sequence;
  std::copy_n(device->puck.position(), 3, state.position);
  std::copy_n(device->puck.orientation(), 4, state.orientation);
  std::copy_n(device->puck.velocity(), 3, state.velocity);
  state.buttons = device->buttons;
  hand_over(state, wanted);
  return MVS_DRIVER_OK;
}

int32_t calibrate(mvs_driver_device *device) {
  device->puck.centre();
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
  return device ? device->fault.sentence : unopened.sentence;
}

// Nothing is thrown at the host; what may be thrown here is that there is no memory.
template <auto function, typename... Arguments>
int32_t guarded(Arguments... arguments) {
  try {
    return function(arguments...);
  } catch (const std::exception &failure) {
    return unopened.set(MVS_DRIVER_E_INTERNAL, "%s", failure.what());
  }
}

const char *const kOptions[] = {
    "socket: the socket of spacenavd [$SPNAV_SOCKET, /etc/spnavrc, /var/run/spnav.sock]",
    "speed: m/s at full deflection [0.05]", "turn: rad/s at full deflection [1.5]", nullptr};

}  // namespace

int32_t mvs_driver_negotiate(const mvs_driver_host *host, mvs_driver_api *api) {
  if (host->oldest > MVS_DRIVER_VERSION || host->newest < MVS_DRIVER_VERSION)
    return MVS_DRIVER_E_VERSION;
  mvs_driver_api ours = {};
  ours.version = MVS_DRIVER_VERSION;
  ours.name = "spacenav";
  ours.about = "3D mice of 3Dconnexion (SpaceNavigator, SpaceMouse, ...), by spacenavd; no force";
  ours.options = kOptions;
  ours.list = guarded<list, const mvs_driver_host *, mvs_driver_found, void *>;
  ours.doctor = guarded<doctor, const mvs_driver_host *, mvs_driver_finding, void *>;
  ours.open = guarded<open_device, const mvs_driver_host *, const char *, mvs_driver_device **>;
  ours.info = info;
  ours.calibrate = calibrate;
  ours.start = start;
  ours.read = read;
  ours.write = write;
  ours.stop = stop;
  ours.close = close_device;
  ours.error = error;
  hand_over(ours, api);
  return MVS_DRIVER_OK;
}
