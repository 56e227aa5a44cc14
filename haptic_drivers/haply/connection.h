// From the options of an application to a service that has told what it has.
#pragma once

#include <string>

#include "messages.h"
#include "websocket.h"

namespace haply {

struct Options {
  // Refuses what makes no sense.
  explicit Options(const mvs_driver_host *host);

  std::string host, device, grip, preset, version;
  int port;
  double rate;  // Hz
  int patience_ms;
};

struct Connection {
  Version version;
  WebSocket socket;
  Inventory inventory;

  // Asks for the version and the devices.
  int32_t open(const Options &options, Fault &fault);
};

}  // namespace haply
