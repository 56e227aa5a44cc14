// Driver for Haply Inverse3, Inverse3x and Minverse, by way of the vendor's service.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "common/fault.h"
#include "connection.h"
#include "exchange.h"

using namespace haply;

struct mvs_driver_device {
  explicit mvs_driver_device(const mvs_driver_host *host) : options(host), exchange(options) {}

  Options options;
  Inverse inverse;
  Grip grip;
  const char *sentence = "";
  Exchange exchange;  // last member: its thread ends first
};

namespace {

const char *model_of(const Inverse &inverse) {
  if (inverse.type == "minverse") return "Haply Minverse";
  return inverse.type == "inverse3x" ? "Haply Inverse3x" : "Haply Inverse3";
}

int32_t list(const mvs_driver_host *host, mvs_driver_found found, void *user) {
  return driver::guarded([&] {
    const Options options(host);
    Connection connection;
    Fault fault;
    const int32_t result = connection.open(options, fault);
    connection.socket.close(options.timeout_ms);
    if (result == MVS_DRIVER_E_LIBRARY) return;  // no service, no device
    driver::must(result, fault);
    for (const Inverse &inverse : connection.inventory.inverses)
      found(user, inverse.id.c_str(), model_of(inverse));
  });
}

void examine(const Inverse &inverse, mvs_driver_finding finding, void *user) {
  const std::string name = model_of(inverse) + (" " + inverse.id);
  finding(user, 1, "device", (name + ", firmware " + inverse.firmware).c_str());
  finding(user, inverse.powered, "power",
          inverse.powered ? "its power supply is on"
                          : "it has no power: without its power supply it gives no force");
  finding(user, inverse.calibrated, "calibration",
          inverse.calibrated ? "it is calibrated"
                             : "put the grip on its rest and wait until the light is steady");
  if (inverse.in_use) finding(user, -1, "in use", "another program drives it: end that first");
  if (!inverse.basis.empty() && inverse.basis != "XYZ")
    finding(user, 0, "basis", "its axes are not XYZ: set the basis of the session back");
}

void examine(const Inventory &inventory, mvs_driver_finding finding, void *user) {
  if (inventory.inverses.empty())
    finding(user, 0, "device", "the service has found no device: plug it in and check Haply Hub");
  for (const Inverse &inverse : inventory.inverses) examine(inverse, finding, user);
  if (inventory.grips.empty())
    finding(user, -1, "grip", "no VerseGrip: there is a position, but no orientation, no button");
  for (const Grip &grip : inventory.grips)
    finding(user, grip.connected ? 1 : -1, "grip",
            (grip.kind + " " + grip.id + (grip.connected ? " is there" : " sleeps: press a button"))
                .c_str());
}

int32_t doctor(const mvs_driver_host *host, mvs_driver_finding finding, void *user) {
  return driver::guarded([&] {
    const Options options(host);
    Connection connection;
    Fault fault;
    const int32_t result = connection.open(options, fault);
    connection.socket.close(options.timeout_ms);
    constexpr char kService[] = "Haply Inverse Service";
    if (result != MVS_DRIVER_OK) return finding(user, 0, kService, fault.sentence);
    const Version &version = connection.version;
    finding(user, 1, kService,
            ("version " + std::to_string(version.major) + "." + std::to_string(version.minor) +
             " answers at " + options.host + ":" + std::to_string(options.port))
                .c_str());
    examine(connection.inventory, finding, user);
  });
}

// Returns the item with this id; the first for an empty id.
template <typename T>
const T *chosen(const std::vector<T> &all, const std::string &id) {
  for (const T &one : all)
    if (id.empty() || one.id == id) return &one;
  return nullptr;
}

void choose(mvs_driver_device &device) {
  const Inventory &inventory = device.exchange.connection.inventory;
  const std::string &id = device.options.device, &grip_id = device.options.grip;
  const Inverse *inverse = chosen(inventory.inverses, id);
  if (!inverse)
    driver::refuse(MVS_DRIVER_E_ABSENT,
                   "the Haply Inverse Service has " + std::to_string(inventory.inverses.size()) +
                       " devices, and none is " + (id.empty() ? "an Inverse3" : "'" + id + "'") +
                       ": plug it in, or name one that the driver lists");
  if (!inverse->basis.empty() && inverse->basis != "XYZ")
    driver::refuse(MVS_DRIVER_E_UNSUPPORTED, "the axes of device " + inverse->id + " are " +
                                                 inverse->basis + ": set the basis back to XYZ");
  const Grip *grip = grip_id == "none" ? nullptr : chosen(inventory.grips, grip_id);
  if (!grip && !grip_id.empty() && grip_id != "none")
    driver::refuse(MVS_DRIVER_E_ABSENT, "the Haply Inverse Service has no grip '" + grip_id + "'");
  device.inverse = *inverse;
  if (grip) device.grip = *grip;
}

void request_real_time(const mvs_driver_host *host, Exchange &exchange) {
  if (exchange.request_real_time() == 0 || !host->log) return;
  host->log(host->host,
            "haply: its thread runs without real-time priority: on a busy machine states come late "
            "(ulimit -r, /etc/security/limits.d)");
}

int32_t open_device(const mvs_driver_host *host, const char *name, mvs_driver_device **out) {
  return driver::guarded([&] {
    *out = nullptr;
    auto device = std::make_unique<mvs_driver_device>(host);
    Options &options = device->options;
    Exchange &exchange = device->exchange;
    Fault fault;
    if (name) options.device = name;
    driver::must(exchange.connection.open(options, fault), fault);
    if (!exchange.connection.version.at_least(3, 5)) options.preset.clear();
    choose(*device);
    driver::must(exchange.open(device->inverse, device->grip, fault), fault);
    request_real_time(host, exchange);
    *out = device.release();
  });
}

int32_t info(mvs_driver_device *device, mvs_driver_info *wanted) {
  mvs_driver_info own = {};
  const bool has_grip = !device->grip.id.empty();
  own.freedoms_in = has_grip ? 6 : 3;
  own.freedoms_out = 3;
  own.buttons = has_grip ? device->grip.buttons : 0;
  // the sphere of the cursor in Haply's tutorial 06, around the origin of the preset
  if (device->options.preset == "arm_front_centered") {
    const double reach = device->inverse.type == "minverse" ? 0.04 : 0.1;
    std::fill_n(own.workspace_min, 3, -reach);
    std::fill_n(own.workspace_max, 3, reach);
  }
  own.rate = 1000;
  // from x right, y forward, z up (docs.haply.co, Basis Permutation)
  constexpr double kFrame[12] = {1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0};
  std::copy_n(kFrame, 12, own.frame);
  std::string(model_of(device->inverse)).copy(own.model, sizeof own.model - 1);
  const std::string &serial = device->inverse.serial;
  (serial.empty() ? device->inverse.id : serial).copy(own.serial, sizeof own.serial - 1);
  device->inverse.firmware.copy(own.firmware, sizeof own.firmware - 1);
  driver::give(own, wanted);
  return MVS_DRIVER_OK;
}

int32_t say(mvs_driver_device &device, int32_t code, const char *sentence) {
  device.sentence = sentence;
  return code;
}

// Returns MVS_DRIVER_OK while the exchange thread runs.
int32_t alive(mvs_driver_device &device) {
  const int32_t failure = device.exchange.failure();
  return failure == MVS_DRIVER_OK ? failure : say(device, failure, device.exchange.why());
}

int32_t calibrate(mvs_driver_device *device) {
  const int32_t result = alive(*device);
  if (result != MVS_DRIVER_OK || device->exchange.latest().hand.calibrated) return result;
  return say(*device, MVS_DRIVER_E_CALIBRATION,
             "put the grip on its rest and wait until the light is steady");
}

int32_t start(mvs_driver_device *device) {
  const int32_t result = alive(*device);
  if (result == MVS_DRIVER_OK) {
    device->exchange.put({});
    device->exchange.allow(true);
  }
  return result;
}

int32_t read(mvs_driver_device *device, uint64_t now_ns, mvs_driver_state *wanted) {
  const int32_t result = alive(*device);
  if (result != MVS_DRIVER_OK) return result;
  const Sample &sample = device->exchange.latest();
  const Hand &hand = sample.hand;
  const uint64_t here = monotonic_ns();
  const uint64_t age = here > sample.arrived_ns ? here - sample.arrived_ns : 0;
  if (age > static_cast<uint64_t>(device->options.timeout_ms) * 1000000)
    return say(*device, MVS_DRIVER_E_LOST,
               "no state came in time: the service is silent, or this machine too busy");
  mvs_driver_state state = {};
  if (hand.calibrated) state.flags |= MVS_DRIVER_FLAG_CALIBRATED;
  if (hand.has_velocity) state.flags |= MVS_DRIVER_FLAG_VELOCITY;
  if (sample.force_on) state.flags |= MVS_DRIVER_FLAG_FORCE_ON;
  state.time_ns = now_ns > age ? now_ns - age : 0;
  state.sequence = sample.sequence;
  std::copy_n(hand.position, 3, state.position);
  std::copy_n(hand.velocity, 3, state.velocity);
  std::copy_n(hand.orientation, 4, state.orientation);
  state.buttons = hand.buttons;
  driver::give(state, wanted);
  return MVS_DRIVER_OK;
}

int32_t write(mvs_driver_device *device, const mvs_driver_force *wanted) {
  const mvs_driver_force given = driver::take(wanted);
  Force force = {{given.force[0], given.force[1], given.force[2]}, given.on != 0};
  const bool finite = std::all_of(force.newton, force.newton + 3,
                                  [](double newton) { return std::isfinite(newton); });
  if (!finite) force = {};  // JSON has no NaN
  device->exchange.put(force);
  const int32_t result = alive(*device);
  if (result != MVS_DRIVER_OK || finite) return result;
  return say(*device, MVS_DRIVER_E_INTERNAL, "a force is not a number: zero was written");
}

int32_t stop(mvs_driver_device *device) {
  device->exchange.allow(false);
  return MVS_DRIVER_OK;
}

void panic(mvs_driver_device *device) {
  device->exchange.panic();
}

void close_device(mvs_driver_device *device) {
  delete device;
}

const char *error(const mvs_driver_device *device) {
  return device ? device->sentence : driver::last_sentence;
}

const char *const kOptions[] = {
    "host: where the Haply Inverse Service is [localhost]",
    "port: its port [10001]",
    "device: the id of the Inverse3, as open() names it [the first one]",
    "grip: the id of the VerseGrip, or none [the first one]",
    "preset: where the origin is, from service 3.5 on; none leaves it [arm_front_centered]",
    "rate: how often a second force and state are exchanged [2000]",
    "version: that of the service, instead of asking it [asked]",
    "patience: ms after which a silent service is lost [100]",
    nullptr};

}  // namespace

int32_t mvs_driver_negotiate(const mvs_driver_host *host, mvs_driver_api *api) {
  mvs_driver_api ours = {};
  ours.version = MVS_DRIVER_VERSION;
  ours.name = "haply";
  ours.about = "Haply Inverse3, Inverse3x and Minverse with a VerseGrip, by the Inverse Service";
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
  ours.panic = panic;
  ours.close = close_device;
  ours.error = error;
  return driver::negotiate(host, api, ours);
}
