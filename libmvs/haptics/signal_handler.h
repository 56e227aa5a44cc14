// Zero force when the process dies of a signal.
#pragma once

#include <mvs/driver.h>

namespace mvs::core {

// Keeps in mind, or forgets, a started device.
void guard_from_crashes(const mvs_driver_api &api, mvs_driver_device *device);
void forget_from_crashes(mvs_driver_device *device);

// Handlers for fatal signals, or those that were there before.
void watch_for_crashes(bool on);

}  // namespace mvs::core
