// Converts structs of devices to the dataclasses of mvs.haptics.
#pragma once

#include <mvs/device.h>

#include "errors.h"

namespace mvs_python {

py::object device_info_value(const mvs_device_info &info);
py::object device_limits_value(const mvs_device_limits &limits);
py::object device_view_value(const mvs_device_view &view);
py::object device_hand_value(const mvs_device_hand &hand);
py::object device_report_value(const mvs_device_report &report);
py::object device_state_value(const mvs_device_state &state);

}  // namespace mvs_python
