// Zero force when a fatal signal ends the process.
#pragma once

#include <mvs/driver.h>

namespace mvs::core {

// Adds a started device to the list of the handler, or removes it.
void register_device(const mvs_driver_api &api, mvs_driver_device *device);
void unregister_device(mvs_driver_device *device);

// Installs handlers for fatal signals, or restores the previous ones.
void install_signal_handler(bool on);

}  // namespace mvs::core
