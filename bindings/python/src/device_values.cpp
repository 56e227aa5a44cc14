#include "device_values.h"

#include <pybind11/numpy.h>

// One field of the C struct `s` as a keyword of its dataclass.
#define FIELD(name) py::arg(#name) = s.name
#define VECTOR(name) py::arg(#name) = vector(s.name)

namespace mvs_python {
namespace {

using namespace py::literals;

template <typename... Fields>
py::object make_haptic(const char *type, Fields &&...fields) {
  return py::module_::import("mvs.haptics").attr(type)(std::forward<Fields>(fields)...);
}

py::object number(const char *type, uint32_t value) {
  return py::module_::import("mvs.haptics").attr(type)(value);
}

template <size_t size>
py::array_t<double> vector(const double (&values)[size]) {
  return py::array_t<double>(size, values);
}

py::object id_or_none(mvs_id id) {
  return id == 0 ? py::object(py::none()) : py::int_(id);
}

py::object node_or_none(uint32_t node) {
  return node == UINT32_MAX ? py::object(py::none()) : py::int_(node);
}

}  // namespace

py::object device_info_value(const mvs_device_info &s) {
  // text of a driver may have any bytes
  const auto text = [](const char *bytes) {
    return py::reinterpret_steal<py::object>(PyUnicode_DecodeUTF8(
        bytes, static_cast<py::ssize_t>(std::char_traits<char>::length(bytes)), "replace"));
  };
  return make_haptic(
      "Info", "driver"_a = text(s.driver), "model"_a = text(s.model), "serial"_a = text(s.serial),
      "firmware"_a = text(s.firmware), FIELD(freedoms_in), FIELD(freedoms_out), FIELD(buttons),
      "clock"_a = s.clock == MVS_CLOCK_VIRTUAL ? "virtual" : "real", "realtime"_a = s.realtime != 0,
      VECTOR(workspace_min), VECTOR(workspace_max), FIELD(peak_force), FIELD(continuous_force),
      FIELD(max_stiffness), FIELD(max_damping), FIELD(max_speed), FIELD(rate), FIELD(peak_torque),
      FIELD(continuous_torque), FIELD(max_angular_stiffness), FIELD(max_angular_damping));
}

py::object device_limits_value(const mvs_device_limits &s) {
  return make_haptic("Limits", FIELD(force), FIELD(continuous_force), FIELD(thermal_s), FIELD(slew),
                     FIELD(gate), FIELD(ramp_s), FIELD(speed), FIELD(stale_s), FIELD(fade_s),
                     FIELD(stiffness), FIELD(torque), FIELD(continuous_torque), FIELD(torque_slew),
                     FIELD(angular_stiffness), FIELD(angular_speed));
}

py::object device_view_value(const mvs_device_view &s) {
  return make_haptic("View", VECTOR(origin), VECTOR(rotation), FIELD(scale), FIELD(force_scale));
}

py::object device_hand_value(const mvs_device_hand &s) {
  return make_haptic("Hand", "mode"_a = number("HandMode", s.mode), "chord"_a = id_or_none(s.chord),
                     FIELD(button), FIELD(reach), FIELD(radius), FIELD(length), FIELD(stiffness),
                     FIELD(max_force), FIELD(gain), FIELD(body_count));
}

py::object device_report_value(const mvs_device_report &s) {
  return make_haptic("Report", "events"_a = number("Event", s.events),
                     "tool"_a = id_or_none(s.tool), "chord"_a = id_or_none(s.chord),
                     "near_chord"_a = id_or_none(s.near_chord), FIELD(near_chord_distance),
                     "near_node"_a = node_or_none(s.near_node), FIELD(near_node_distance),
                     "node"_a = node_or_none(s.node), VECTOR(position), VECTOR(force),
                     FIELD(stiffness), VECTOR(drag_to), VECTOR(torque), FIELD(angular_stiffness));
}

py::object device_state_value(const mvs_device_state &s) {
  return make_haptic("State", "phase"_a = number("Phase", s.phase),
                     "cause"_a = number("Cause", s.cause), FIELD(flags),
                     "limited"_a = number("Limited", s.limited), FIELD(buttons), FIELD(time),
                     VECTOR(position), VECTOR(orientation), VECTOR(velocity), VECTOR(hand),
                     VECTOR(force), FIELD(rate), FIELD(worst_period), FIELD(model_age),
                     FIELD(energy), FIELD(heat), FIELD(ticks), FIELD(late), FIELD(bad_samples),
                     "sample_faults"_a = number("SampleFault", s.sample_faults), VECTOR(torque));
}

}  // namespace mvs_python
