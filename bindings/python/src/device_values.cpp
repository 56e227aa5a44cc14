#include "device_values.h"

#include <pybind11/numpy.h>

// One field of the C struct `s` into the keywords of its dataclass, under the same name.
#define FIELD(name) fields[#name] = s.name
#define VECTOR(name) fields[#name] = vector(s.name)

namespace mvs_python {
namespace {

py::object make(const char *type, const py::dict &fields) {
  return py::module_::import("mvs.haptics").attr(type)(**fields);
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
  // a driver may say anything
  const auto text = [](const char *bytes) {
    return py::reinterpret_steal<py::object>(PyUnicode_DecodeUTF8(
        bytes, static_cast<py::ssize_t>(std::char_traits<char>::length(bytes)), "replace"));
  };
  py::dict fields;
  fields["driver"] = text(s.driver);
  fields["model"] = text(s.model);
  fields["serial"] = text(s.serial);
  fields["firmware"] = text(s.firmware);
  FIELD(freedoms_in);
  FIELD(freedoms_out);
  FIELD(buttons);
  fields["clock"] = s.clock == MVS_CLOCK_VIRTUAL ? "virtual" : "real";
  fields["realtime"] = s.realtime != 0;
  VECTOR(workspace_min);
  VECTOR(workspace_max);
  FIELD(peak_force);
  FIELD(continuous_force);
  FIELD(max_stiffness);
  FIELD(max_damping);
  FIELD(max_speed);
  FIELD(rate);
  return make("Info", fields);
}

py::object device_limits_value(const mvs_device_limits &s) {
  py::dict fields;
  FIELD(force);
  FIELD(continuous_force);
  FIELD(thermal_s);
  FIELD(slew);
  FIELD(gate);
  FIELD(ramp_s);
  FIELD(speed);
  FIELD(stale_s);
  FIELD(fade_s);
  FIELD(stiffness);
  return make("Limits", fields);
}

py::object device_view_value(const mvs_device_view &s) {
  py::dict fields;
  VECTOR(origin);
  VECTOR(rotation);
  FIELD(scale);
  FIELD(force_scale);
  return make("View", fields);
}

py::object device_hand_value(const mvs_device_hand &s) {
  py::dict fields;
  fields["mode"] = number("HandMode", s.mode);
  fields["chord"] = id_or_none(s.chord);
  FIELD(button);
  FIELD(reach);
  FIELD(radius);
  FIELD(length);
  FIELD(stiffness);
  FIELD(max_force);
  FIELD(gain);
  return make("Hand", fields);
}

py::object device_report_value(const mvs_device_report &s) {
  py::dict fields;
  fields["events"] = number("Event", s.events);
  fields["tool"] = id_or_none(s.tool);
  fields["chord"] = id_or_none(s.chord);
  fields["near_chord"] = id_or_none(s.near_chord);
  FIELD(near_chord_distance);
  fields["near_node"] = node_or_none(s.near_node);
  FIELD(near_node_distance);
  fields["node"] = node_or_none(s.node);
  VECTOR(position);
  VECTOR(force);
  FIELD(stiffness);
  VECTOR(drag_to);
  return make("Report", fields);
}

py::object device_state_value(const mvs_device_state &s) {
  py::dict fields;
  fields["phase"] = number("Phase", s.phase);
  fields["cause"] = number("Cause", s.cause);
  FIELD(flags);
  fields["limited"] = number("Limited", s.limited);
  FIELD(buttons);
  FIELD(time);
  VECTOR(position);
  VECTOR(orientation);
  VECTOR(velocity);
  VECTOR(hand);
  VECTOR(force);
  FIELD(rate);
  FIELD(worst_period);
  FIELD(model_age);
  FIELD(energy);
  FIELD(heat);
  FIELD(ticks);
  FIELD(late);
  return make("State", fields);
}

}  // namespace mvs_python
