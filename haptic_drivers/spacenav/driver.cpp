// Driver for 3D mice: pose and buttons, no force.
#include <algorithm>
#include <cstring>
#include <memory>
#include <string>

#include "common/fault.h"
#include "common/options.h"
#include "daemon.h"
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

// The only device name: spacenavd merges all mice.
constexpr char kName[] = "spacenav";

// s, largest time step of the integration, so that a suspended program does not move its instrument
// to the wall.
constexpr double kLongestStep = 0.05;

// Limit of packets per read().
constexpr int kPacketsARead = 4096;

const char *socket_of(const std::optional<std::string> &named) {
  return named ? named->c_str() : nullptr;
}

int32_t list(const mvs_driver_host *host, mvs_driver_found found, void *user) {
  return driver::guarded([&] {
    Daemon daemon;
    Fault fault;
    std::string model;
    int32_t buttons = 0;
    const auto named = driver::Options(host).text("socket");
    const int32_t result = daemon.open(socket_of(named), fault);
    if (result == MVS_DRIVER_E_LIBRARY) return;  // no daemon, no device
    driver::must(result, fault);
    if (daemon.device(model, buttons)) found(user, kName, model.c_str());
    if (daemon.protocol() == 0) found(user, kName, "3D mouse (if one is plugged in)");
  });
}

int32_t doctor(const mvs_driver_host *host, mvs_driver_finding finding, void *user) {
  return driver::guarded([&] {
    Daemon daemon;
    Fault fault;
    std::string model;
    int32_t buttons = 0;
    const auto named = driver::Options(host).text("socket");
    if (daemon.open(socket_of(named), fault) != MVS_DRIVER_OK)
      return finding(user, 0, "daemon spacenavd", fault.sentence);
    finding(user, 1, "daemon spacenavd", ("it answers at " + daemon.path()).c_str());
    if (daemon.protocol() == 0)
      return finding(user, -1, "3D mouse",
                     "this spacenavd is older than 1.0 and does not tell of devices: if nothing "
                     "moves, see /var/log/spnavd.log");
    if (!daemon.device(model, buttons))
      return finding(user, 0, "3D mouse",
                     "spacenavd has found no mouse: plug it in, and see /var/log/spnavd.log if it "
                     "still does not");
    finding(user, 1, "3D mouse", (model + ", " + std::to_string(buttons) + " buttons").c_str());
  });
}

int32_t open_device(const mvs_driver_host *host, const char *name, mvs_driver_device **device) {
  return driver::guarded([&] {
    *device = nullptr;
    if (name && std::strcmp(name, kName) != 0)
      driver::refuse(MVS_DRIVER_E_ABSENT,
                     std::string("there is no 3D mouse '") + name + "': it is called " + kName);
    const driver::Options options(host);
    Speeds speeds;
    speeds.move = options.number("speed", speeds.move, 0.001, 1);
    speeds.turn = options.number("turn", speeds.turn, 0.01, 10);
    auto opened = std::make_unique<mvs_driver_device>(speeds);
    Daemon &daemon = opened->daemon;
    const auto named = options.text("socket");
    driver::must(daemon.open(socket_of(named), opened->fault), opened->fault);
    const bool found = daemon.device(opened->model, opened->button_count);
    if (!found && daemon.protocol() > 0)
      driver::refuse(MVS_DRIVER_E_ABSENT,
                     "spacenavd at " + daemon.path() + " has no 3D mouse: plug one in");
    if (!found) opened->model = "3D mouse";
    *device = opened.release();
  });
}

int32_t info(mvs_driver_device *device, mvs_driver_info *wanted) {
  mvs_driver_info own = {};
  own.freedoms_in = 6;
  own.buttons = static_cast<uint32_t>(device->button_count);
  std::fill_n(own.workspace_min, 3, -kReach);
  std::fill_n(own.workspace_max, 3, kReach);
  own.max_speed = device->speeds.move;
  own.rate = 250;  // twice the rate of the mice
  device->model.copy(own.model, sizeof own.model - 1);
  driver::give(own, wanted);
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
      break;  // an event of a later spacenavd
  }
}

// Handles the events since the last read.
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
  const bool anew = device->sequence == 0 || now_ns != device->last_ns;
  device->last_ns = now_ns;
  const int32_t result = listen(*device);
  if (result != MVS_DRIVER_OK) return result;
  mvs_driver_state state = {};
  state.flags = MVS_DRIVER_FLAG_CALIBRATED | MVS_DRIVER_FLAG_VELOCITY;
  state.time_ns = now_ns;
  state.sequence = device->sequence += anew ? 1 : 0;
  std::copy_n(device->puck.position(), 3, state.position);
  std::copy_n(device->puck.orientation(), 4, state.orientation);
  std::copy_n(device->puck.velocity(), 3, state.velocity);
  state.buttons = device->buttons;
  driver::give(state, wanted);
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
  return device ? device->fault.sentence : driver::last_sentence;
}

const char *const kOptions[] = {
    "socket: the socket of spacenavd [$SPNAV_SOCKET, /etc/spnavrc, /var/run/spnav.sock]",
    "speed: m/s at full deflection [0.05]", "turn: rad/s at full deflection [1.5]", nullptr};

}  // namespace

int32_t mvs_driver_negotiate(const mvs_driver_host *host, mvs_driver_api *api) {
  mvs_driver_api ours = {};
  ours.version = MVS_DRIVER_VERSION;
  ours.name = "spacenav";
  ours.about = "3D mice of 3Dconnexion (SpaceNavigator, SpaceMouse, ...), by spacenavd; no force";
  ours.options = kOptions;
  ours.list = list;
  ours.doctor = doctor;
  ours.open = open_device;
  ours.info = info;
  ours.calibrate = calibrate;
  ours.start = start;
  ours.read = read;
  ours.write = write;
  ours.stop = stop;
  ours.close = close_device;
  ours.error = error;
  return driver::negotiate(host, api, ours);
}
