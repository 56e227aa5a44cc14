// mvs.Device, and what mvs.haptics asks drivers.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <tuple>
#include <vector>

#include "device.h"
#include "device_values.h"

namespace mvs_python {
namespace {

using Number = std::optional<double>;
using Texts = std::vector<std::pair<std::string, std::string>>;
using Findings = std::vector<std::tuple<int32_t, std::string, std::string>>;

// Drivers say what they like: no byte of it may fail to become a text.
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
  desc.rate = rate.value_or(0);
  return std::make_unique<Device>(desc);
}

// What one of the mvs_device_get_* fills.
template <typename Struct>
Struct got(Device &self, mvs_result (*get)(const mvs_device *, Struct *)) {
  Struct found{};
  found.struct_size = sizeof found;
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
                Number stiffness) {
  mvs_device_limits limits{};
  limits.force = force.value_or(0);
  limits.continuous_force = continuous_force.value_or(0);
  limits.thermal_s = thermal_s.value_or(0);
  limits.slew = slew.value_or(0);
  limits.gate = gate.value_or(0);
  limits.ramp_s = ramp_s.value_or(0);
  limits.speed = speed.value_or(0);
  limits.stale_s = stale_s.value_or(0);
  limits.fade_s = fade_s.value_or(0);
  limits.stiffness = stiffness.value_or(0);
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
  static constexpr const char *names[] = {"look", "grasp", "ball", "rod", "feel", "drag"};
  for (uint32_t k = 0; k < std::size(names); ++k) {
    if (name == names[k]) return k;
  }
  refuse(MVS_E_ARGUMENT, "mode",
         "mode: \"look\", \"grasp\", \"ball\", \"rod\", \"feel\" or \"drag\" is needed, not \"" +
             name + "\"");
}

void set_hand(Device &self, const std::string &mode, std::optional<mvs_id> chord, uint32_t button,
              Number reach, Number radius, Number length, Number stiffness, Number max_force,
              Number gain) {
  mvs_device_hand hand{};
  hand.mode = mode_of(mode);
  hand.chord = chord.value_or(0);
  hand.button = button;
  hand.reach = reach.value_or(0);
  hand.radius = radius.value_or(0);
  hand.length = length.value_or(0);
  hand.stiffness = stiffness.value_or(0);
  hand.max_force = max_force.value_or(0);
  hand.gain = gain.value_or(0);
  put(self, hand, &mvs_device_set_hand);
}

void bind_settings(py::class_<Device> &type) {
  const py::object none = py::none();
  type.def("set_limits", &set_limits, py::kw_only(), py::arg("force") = none,
           py::arg("continuous_force") = none, py::arg("thermal_s") = none, py::arg("slew") = none,
           py::arg("gate") = none, py::arg("ramp_s") = none, py::arg("speed") = none,
           py::arg("stale_s") = none, py::arg("fade_s") = none, py::arg("stiffness") = none,
           "Sets what the user allows; what is not given takes its default, and nothing exceeds "
           "the device's own limits.\n\nforce: N [peak force]\ncontinuous_force: N, on average "
           "[the device's]\nthermal_s: s, over which it is averaged [10]\nslew: N/s [100 times "
           "force]\ngate: N, the force has to be below it for forces to begin [0.2]\nramp_s: s, in "
           "which they come up [1]\nspeed: m/s, above it forces latch off [the device's, at most "
           "1]\nstale_s: s, a tissue model older than it fades [0.1]\nfade_s: s, in which it does "
           "[0.05]\nstiffness: N/m, the most that the hand feels [the device's]");
  type.def("set_view", &set_view, py::kw_only(), py::arg("origin") = std::array<double, 3>{},
           py::arg("rotation") = std::array<double, 4>{1, 0, 0, 0}, py::arg("scale") = 1.0,
           py::arg("force_scale") = 1.0,
           "Lays the device's workspace over the scene: p = origin + scale * rotation * p_device; "
           "a force in the scene is felt times force_scale.\n\norigin: m\nrotation: quaternion w x "
           "y z of any length\nscale: 0.01 to 100\nforce_scale: 0.001 to 1000");
  type.def("set_hand", &set_hand, py::arg("mode"), py::kw_only(), py::arg("chord") = none,
           py::arg("button") = 0, py::arg("reach") = none, py::arg("radius") = none,
           py::arg("length") = none, py::arg("stiffness") = none, py::arg("max_force") = none,
           py::arg("gain") = none,
           "Gives the hand a tool; what it holds is let go at the next sync.\n\nmode: \"look\"; "
           "\"grasp\": the button takes the nearest node; \"ball\", \"rod\": push; \"feel\": the "
           "tension of a chord; \"drag\": the button takes a chord's leaflet end\nchord: id, to "
           "feel or drag [the nearest when the button goes down]\nbutton: that grasps, 0 the "
           "first\nreach: m, in the scene [5e-3]\nradius: m, of ball or rod [2e-3]\nlength: m, of "
           "the rod [40e-3]\nstiffness: N/m, of the spring between hand and tool [200]\nmax_force: "
           "N, of that spring [5]\ngain: of a felt chord's tension [1]");
}

void bind_views(py::class_<Device> &type) {
  type.def_property_readonly(
      "info", [](Device &self) { return device_info_value(got(self, &mvs_device_get_info)); },
      "What the device is (mvs.haptics.Info).");
  type.def_property_readonly(
      "limits", [](Device &self) { return device_limits_value(got(self, &mvs_device_get_limits)); },
      "What the user allows (mvs.haptics.Limits).");
  type.def_property_readonly(
      "view", [](Device &self) { return device_view_value(got(self, &mvs_device_get_view)); },
      "How the workspace lies in the scene (mvs.haptics.View).");
  type.def_property_readonly(
      "hand", [](Device &self) { return device_hand_value(got(self, &mvs_device_get_hand)); },
      "The hand's tool (mvs.haptics.Hand).");
  type.def_property_readonly(
      "state", [](Device &self) { return device_state_value(self.state()); },
      "The servo as it is now (mvs.haptics.State); from any thread.");
  type.def("trace", &Device::trace,
           "The ticks of the servo since the last call, oldest first: a structured array of time "
           "(s), position (m), orientation (w x y z), force (N), servo_s (s, 0 on a virtual "
           "clock), gripper (rad), buttons, limited (mvs.haptics.Limited), in the frame of the "
           "device. The library keeps the last 8192.");
  type.def_property_readonly("lost", &Device::lost, "Ticks that trace() came too late for.");
}

void bind_work(py::class_<Device> &type) {
  type.def(
      "start", [](Device &self) { self.call(&mvs_device_start); },
      "Starts the servo: places are told, forces stay off until arm().");
  type.def(
      "stop", [](Device &self) { self.call(&mvs_device_stop); },
      "Stops it: zero force, motors off.");
  type.def(
      "arm", [](Device &self) { self.call(&mvs_device_arm); },
      "Lets forces begin, by gate and ramp, also after they latched off; DeviceError says which "
      "cause is not over.");
  type.def("cut", &Device::cut, "Forces off now (Cause.SOFTWARE); from any thread.");
  type.def(
      "advance",
      [](Device &self, double seconds) {
        self.call([&](mvs_device *device) { return mvs_device_advance(device, seconds); });
      },
      py::arg("seconds"), "On a virtual clock: runs the servo for a time, at its rate.");
  type.def(
      "sync", [](Device &self, Simulator &sim) { return device_report_value(self.sync(sim)); },
      py::arg("sim"),
      "Hand to valve, valve to hand, before each Simulator.step; what the hand points at and did "
      "(mvs.haptics.Report). StateError without a valve.");
  type.def("close", &Device::close, "Stops and frees the device.");
  type.def("__enter__", [](const py::object &self) { return self; });
  type.def("__exit__", [](Device &self, const py::args &) { self.close(); });
}

}  // namespace

void bind_device(py::module_ &module) {
  PYBIND11_NUMPY_DTYPE(mvs_device_sample, time, position, orientation, force, servo_s, gripper,
                       buttons, limited);
  py::class_<Device> type(
      module, "Device",
      "An open haptic device; its motors are off until start() and arm().\n\nCalls release the "
      "interpreter; threads that share a device wait for each other. Closed at the end of a with "
      "block.\n\ndriver: a name of mvs.haptics.drivers(), or an absolute path\ndevice: as "
      "mvs.haptics.list names it [the first]\noptions: of the driver, a dictionary\nclock: "
      "\"real\": the device's own, or a thread at its rate; \"virtual\": advance() turns it, for "
      "tests\nrate: Hz, of a polled device, 100 to 10000 [its own, or 1000]\nIoError: there is no "
      "such driver. VersionError: it speaks another version. ArgumentError: an option makes no "
      "sense. DeviceError: the driver's own sentence for what else is wrong.");
  type.def(py::init(&open), py::arg("driver"), py::arg("device") = py::none(), py::kw_only(),
           py::arg("options") = py::none(), py::arg("clock") = "real",
           py::arg("rate") = py::none());
  bind_settings(type);
  bind_views(type);
  bind_work(type);
  module.def("drivers", &drivers, "Names and paths of the installed drivers.");
  module.def("devices", &devices, py::arg("driver"), py::arg("options"),
             "Names and models of the devices that a driver finds.");
  module.def("doctor", &doctor, py::arg("driver"), py::arg("options"),
             "Verdicts, checks and sentences of a driver's doctor.");
}

}  // namespace mvs_python
