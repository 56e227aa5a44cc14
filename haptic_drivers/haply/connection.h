// Connection to the Inverse Service: options, version, WebSocket, inventory.
#pragma once

#include <string>

#include "messages.h"
#include "websocket.h"

namespace haply {

struct Options {
  // Throws a Refusal for an invalid option.
  explicit Options(const mvs_driver_host *host);

  std::string host, device, grip, preset, version;
  int port;
  double rate;  // Hz
  int timeout_ms;
};

struct Connection {
  Version version;
  WebSocket socket;
  Inventory inventory;

  // Connects, and reads the version and the devices.
  int32_t open(const Options &options, Fault &fault);
};

}  // namespace haply
