// Fixtures: answers of the service of a Haply, and options of the driver.
#pragma once

#include "haply_service.h"
#include "plugin.h"

inline std::string steady_haply(int, const std::string &) {
  return ws_frame(haply_state(0.03125));
}

// Long time-outs: only tests of lateness set shorter ones.
inline std::map<std::string, std::string> haply_options(
    const HaplyService &service, std::map<std::string, std::string> more = {}) {
  more.insert({{"host", "127.0.0.1"}, {"port", service.port()}, {"patience", "2000"}});
  return more;
}
