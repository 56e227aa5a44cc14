// One question to the service's HTTP side, which is at the same port as its WebSocket.
#pragma once

#include <string>

#include "common/fault.h"

namespace haply {

using driver::Fault;

// The body of `path`, e.g. "/version".
int32_t http_get(const char *host, int port, const char *path, std::string &body, Fault &fault);

// The value of a header of `head`, whose lines end with CR LF; empty if it is not there.
std::string header_of(const std::string &head, const std::string &name);

}  // namespace haply
