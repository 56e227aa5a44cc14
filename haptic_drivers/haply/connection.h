// From the options of an application to a service that has told what it has.
#pragma once

#include <string>

#include "messages.h"
#include "websocket.h"

namespace haply {

struct Options {
  std::string host = "localhost", device, grip, preset = "arm_front_centered", version;
  int port = 10001;
  double rate = 2000;  // Hz
  int patience_ms = MVS_DRIVER_PATIENCE_MS;
};
int32_t read_options(const mvs_driver_host *host, Options &options, Fault &fault);

struct Connection {
  Version version;
  WebSocket socket;
  Inventory inventory;

  // Asks for the version and the devices.
  int32_t open(const Options &options, Fault &fault);
};

}  // namespace haply
