// mvs.Device, and the driver queries of mvs.haptics.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <tuple>
#include <vector>

#include "bodies.h"
#include "device.h"
#include "device_values.h"

namespace mvs_python {
namespace {

using namespace py::literals;

using Number = std::optional<double>;
using Texts = std::vector<std::pair<std::string, std::string>>;
using Findings = std::vector<std::tuple<int32_t, std::string, std::string>>;

// Decodes text of a driver; replaces bytes that are not UTF-8.
std::string utf8(const char *text) {
  const py::gil_scoped_acquire held;
  const auto decoded = py::reinterpret_steal<py::str>(PyUnicode_DecodeUTF8(
      text, static_cast<py::ssize_t>(std::char_traits<char>::length(text)), "replace"));
  return decoded.cast<std::string>();
}

Texts drivers() {
  Texts found;
  uint32_t count = 0;
  must(mvs_get_driver_count(&count));
  for (uint32_t k = 0; k < count; ++k) {
    const char *name = nullptr, *path = nullptr;
    must(mvs_get_driver(k, &name, &path));
    found.emplace_back(utf8(name), utf8(path));
  }
  return found;
}

Texts devices(const std::string &driver, const std::string &options) {
  Texts found;
  release_and([&] {
    return mvs_device_list(
        driver.c_str(), options.c_str(),
        [](void *to, const char *name, const char *model) {
          static_cast<Texts *>(to)->emplace_back(utf8(name), utf8(model));
        },
        &found);
  });
  return found;
}

Findings doctor(const std::optional<std::string> &driver, const std::string &options) {
  Findings found;
  release_and([&] {
    return mvs_device_doctor(
        driver ? driver->c_str() : nullptr, options.empty() ? nullptr : options.c_str(),
        [](void *to, int32_t verdict, const char *check, const char *sentence) {
          static_cast<Findings *>(to)->emplace_back(verdict, utf8(check), utf8(sentence));
        },
        &found);
  });
  return found;
}

std::unique_ptr<Device> open(const std::filesystem::path &driver,
                             const std::optional<std::string> &device, const py::object &options,
                             const std::string &clock, Number rate) {
  if (clock != "real" && clock != "virtual") {
    refuse(MVS_E_ARGUMENT, "clock",
           "clock: \"real\" or \"virtual\" is needed, not \"" + clock + "\"");
  }
  const auto lines =
      py::module_::import("mvs.haptics").attr("option_lines")(options).cast<std::string>();
  const std::string name = driver.string();
  mvs_device_desc desc{};
  desc.clock = clock == "virtual" ? MVS_CLOCK_VIRTUAL : MVS_CLOCK_REAL;
  desc.driver = name.c_str();
  desc.device = device ? device->c_str() : nullptr;
  desc.options = lines.c_str();
  desc.rate = given_or_default(rate, "rate");
  return std::make_unique<Device>(desc);
}

// The struct that one of the mvs_device_get_* functions fills.
template <typename Struct>
Struct got(Device &self, mvs_result (*get)(const mvs_device *, Struct *)) {
  auto found = sized<Struct>();
  self.call([&](mvs_device *device) { return get(device, &found); });
  return found;
}

template <typename Struct>
void put(Device &self, Struct given, mvs_result (*set)(mvs_device *, const Struct *)) {
  given.struct_size = sizeof given;
  self.call([&](mvs_device *device) { return set(device, &given); });
}

void set_limits(Device &self, Number force, Number continuous_force, Number thermal_s, Number slew,
                Number gate, Number ramp_s, Number speed, Number stale_s, Number fade_s,
                Number stiffness, Number torque, Number continuous_torque, Number torque_slew,
                Number angular_stiffness, Number angular_speed) {
  mvs_device_limits limits{};
  limits.force = given_or_default(force, "force");
  limits.continuous_force = given_or_default(continuous_force, "continuous_force");
  limits.thermal_s = given_or_default(thermal_s, "thermal_s");
  limits.slew = given_or_default(slew, "slew");
  limits.gate = given_or_default(gate, "gate");
  limits.ramp_s = given_or_default(ramp_s, "ramp_s");
  limits.speed = given_or_default(speed, "speed");
  limits.stale_s = given_or_default(stale_s, "stale_s");
  limits.fade_s = given_or_default(fade_s, "fade_s");
  limits.stiffness = given_or_default(stiffness, "stiffness");
  limits.torque = given_or_default(torque, "torque");
  limits.continuous_torque = given_or_default(continuous_torque, "continuous_torque");
  limits.torque_slew = given_or_default(torque_slew, "torque_slew");
  limits.angular_stiffness = given_or_default(angular_stiffness, "angular_stiffness");
  limits.angular_speed = given_or_default(angular_speed, "angular_speed");
  put(self, limits, &mvs_device_set_limits);
}

void set_view(Device &self, const std::array<double, 3> &origin,
              const std::array<double, 4> &rotation, double scale, double force_scale) {
  mvs_device_view view{};
  std::copy(origin.begin(), origin.end(), view.origin);
  std::copy(rotation.begin(), rotation.end(), view.rotation);
  view.scale = scale;
  view.force_scale = force_scale;
  put(self, view, &mvs_device_set_view);
}

uint32_t mode_of(const std::string &name) {
  static constexpr const char *names[] = {"look", "grasp", "ball", "rod", "feel", "drag", "convex"};
  for (uint32_t k = 0; k < std::size(names); ++k) {
    if (name == names[k]) return k;
  }
  refuse(MVS_E_ARGUMENT, "mode",
         "mode: \"look\", \"grasp\", \"ball\", \"rod\", \"feel\", \"drag\" or \"convex\" is "
         "needed, not \"" +
             name + "\"");
}

void set_hand(Device &self, const std::string &mode, std::optional<mvs_id> chord, uint32_t button,
              Number reach, Number radius, Number length, Number stiffness, Number max_force,
              Number gain, const std::vector<py::dict> &given) {
  const Bodies bodies(given);
  mvs_device_hand hand{};
  hand.bodies = bodies.descs.data();
  hand.body_count = static_cast<uint32_t>(bodies.descs.size());
  hand.body_stride = sizeof(mvs_body_desc);
  hand.mode = mode_of(mode);
  hand.chord = chord.value_or(0);
  hand.button = button;
  hand.reach = given_or_default(reach, "reach");
  hand.radius = given_or_default(radius, "radius");
  hand.length = given_or_default(length, "length");
  hand.stiffness = given_or_default(stiffness, "stiffness");
  hand.max_force = given_or_default(max_force, "max_force");
  hand.gain = given_or_default(gain, "gain");
  put(self, hand, &mvs_device_set_hand);
}

void bind_settings(py::class_<Device> &type) {
  const py::object none = py::none();
  type.def("set_limits", &set_limits, py::kw_only(), "force"_a = none, "continuous_force"_a = none,
           "thermal_s"_a = none, "slew"_a = none, "gate"_a = none, "ramp_s"_a = none,
           "speed"_a = none, "stale_s"_a = none, "fade_s"_a = none, "stiffness"_a = none,
           "torque"_a = none, "continuous_torque"_a = none, "torque_slew"_a = none,
           "angular_stiffness"_a = none, "angular_speed"_a = none,
           "Sets the limits of the user; omitted ones take their defaults, and no limit exceeds "
           "that of the device.\n\nforce: N [peak force]\ncontinuous_force: N, mean force [the "
           "device's]\nthermal_s: s, averaging time of the mean force [10]\nslew: N/s [100 times "
           "force]\ngate: N, forces start only below it [0.2]\nramp_s: s, duration of the ramp at "
           "the start [1]\nspeed: m/s, above which forces latch off [the device's, at most "
           "1]\nstale_s: s, age at which the tissue model fades [0.1]\nfade_s: s, duration of the "
           "fade [0.05]\nstiffness: N/m, upper limit of the rendered stiffness [the "
           "device's]\ntorque: N m [peak "
           "torque, 0 without motors for it]\ncontinuous_torque: N m, mean torque [the "
           "device's]\ntorque_slew: "
           "N m/s [100 times torque]\nangular_stiffness: N m/rad [the device's]\nangular_speed: "
           "rad/s, above "
           "which forces latch off, of devices with motors for torque [20]");
  type.def("set_view", &set_view, py::kw_only(), "origin"_a = std::array<double, 3>{},
           "rotation"_a = std::array<double, 4>{1, 0, 0, 0}, "scale"_a = 1.0, "force_scale"_a = 1.0,
           "Maps the device's workspace to the scene: p = origin + scale * rotation * p_device; "
           "forces of the scene are multiplied by force_scale.\n\norigin: m\nrotation: quaternion "
           "w x y z of any length\nscale: 0.01 to 100\nforce_scale: 0.001 to 1000");
  type.def(
      "set_hand", &set_hand, "mode"_a, py::kw_only(), "chord"_a = none, "button"_a = 0,
      "reach"_a = none, "radius"_a = none, "length"_a = none, "stiffness"_a = none,
      "max_force"_a = none, "gain"_a = none, "bodies"_a = py::tuple(),
      "Gives the hand a tool; the next sync releases the node that it holds.\n\nmode: \"look\"; "
      "\"grasp\": the button takes the nearest node; \"ball\", \"rod\": push; \"feel\": the "
      "tension of a chord; \"drag\": the button takes a chord's leaflet end; \"convex\": pushes "
      "with "
      "`bodies`, which turn with the stylus\nchord: id of the "
      "chord to feel or drag [the nearest when the button is pressed]\nbutton: index of the "
      "grasping button\nreach: m, in the scene, of the button [5e-3]\nradius: m, of a ball or rod "
      "[2e-3]\nlength: m, of a rod [40e-3]\nstiffness: N/m, of the spring between hand and tool "
      "[200]\nmax_force: N, of that spring [5]\ngain: factor on the tension of a felt chord "
      "[1]\nbodies: of \"convex\", as Simulator.add_tool has them");
}

void bind_views(py::class_<Device> &type) {
  type.def_property_readonly(
      "info", [](Device &self) { return device_info_value(got(self, &mvs_device_get_info)); },
      "Properties of the device (mvs.haptics.Info).");
  type.def_property_readonly(
      "limits", [](Device &self) { return device_limits_value(got(self, &mvs_device_get_limits)); },
      "Limits of the user (mvs.haptics.Limits).");
  type.def_property_readonly(
      "view", [](Device &self) { return device_view_value(got(self, &mvs_device_get_view)); },
      "Map from the workspace to the scene (mvs.haptics.View).");
  type.def_property_readonly(
      "hand", [](Device &self) { return device_hand_value(got(self, &mvs_device_get_hand)); },
      "The hand's tool (mvs.haptics.Hand).");
  type.def_property_readonly(
      "state", [](Device &self) { return device_state_value(self.state()); },
      "Present state of the servo (mvs.haptics.State); allowed in any thread.");
  type.def("trace", &Device::trace,
           "The ticks of the servo since the last call, oldest first: a structured array of time "
           "(s), position (m), orientation (w x y z), force (N), servo_s (s, 0 on a virtual "
           "clock), gripper (rad), buttons, limited (mvs.haptics.Limited), in the frame of the "
           "device. The library keeps the last 8192.");
  type.def_property_readonly("lost", &Device::lost,
                             "Number of ticks that were overwritten before trace() read them.");
}

// Advances in parts, between which Ctrl-C stops. An invalid time is refused by the first part.
void advance(Device &self, double seconds) {
  constexpr double part = 0.25, most = 3600;  // s; the limit of mvs_device_advance
  std::exception_ptr raised;
  self.call([&](mvs_device *device) {
    SignalWatch watch;
    double left = seconds;
    mvs_result result = MVS_OK;
    while (seconds <= most && left > part && result == MVS_OK && !watch.interrupted(raised)) {
      result = mvs_device_advance(device, part);
      left -= part;
    }
    return result == MVS_OK && !raised ? mvs_device_advance(device, left) : result;
  });
  if (raised) std::rethrow_exception(raised);
}

void bind_work(py::class_<Device> &type) {
  type.def(
      "start", [](Device &self) { self.call(&mvs_device_start); },
      "Starts the servo: it reports positions; forces stay off until arm().");
  type.def(
      "stop", [](Device &self) { self.call(&mvs_device_stop); },
      "Stops the servo: zero force, motors off.");
  type.def(
      "arm", [](Device &self) { self.call(&mvs_device_arm); },
      "Enables forces, through gate and ramp, also after they latched off; DeviceError names a "
      "cause that persists.");
  type.def("cut", &Device::cut,
           "Switches forces off at once (Cause.SOFTWARE); allowed in any thread.");
  type.def("advance", &advance, "seconds"_a,
           "Advances a virtual clock: runs the servo for a time, at its rate. Ctrl-C stops it.");
  type.def(
      "sync", [](Device &self, Simulator &sim) { return device_report_value(self.sync(sim)); },
      "sim"_a,
      "Exchanges hand and valve; call it before each Simulator.step. Returns mvs.haptics.Report: "
      "the targets and the actions of the hand. StateError without a valve.");
  type.def("close", &Device::close, "Stops and frees the device.");
  type.def("__enter__", [](const py::object &self) { return self; });
  type.def("__exit__", [](Device &self, const py::args &) { self.close(); });
}

}  // namespace

void bind_device(py::module_ &module) {
  PYBIND11_NUMPY_DTYPE(mvs_device_sample, time, position, orientation, force, servo_s, gripper,
                       buttons, limited, torque);
  py::class_<Device> type(
      module, "Device",
      "An open haptic device; its motors are off until start() and arm().\n\nCalls release the "
      "interpreter; threads that share a device wait for each other. Closed at the end of a with "
      "block.\n\ndriver: a name of mvs.haptics.drivers(), or an absolute path\ndevice: a name of "
      "mvs.haptics.list [the first]\noptions: a dictionary of options of the driver\nclock: "
      "\"real\": of the device, or a thread at its rate; \"virtual\": advanced by advance(), for "
      "tests\nrate: Hz, of a polled device, 100 to 10000 [its default, or 1000]\nIoError: no such "
      "driver. VersionError: the driver has another interface version. ArgumentError: invalid "
      "option. DeviceError: any other error, in the words of the driver.");
  type.def(py::init(&open), "driver"_a, "device"_a = py::none(), py::kw_only(),
           "options"_a = py::none(), "clock"_a = "real", "rate"_a = py::none());
  bind_settings(type);
  bind_views(type);
  bind_work(type);
  module.def("drivers", &drivers, "Names and paths of the installed drivers.");
  module.def("devices", &devices, "driver"_a, "options"_a,
             "Names and models of the devices that a driver finds.");
  module.def("doctor", &doctor, "driver"_a, "options"_a,
             "Verdicts, checks and sentences of the checks of a driver.");
}

}  // namespace mvs_python
