// One HTTP request to the service, which shares the port of its WebSocket.
#pragma once

#include <string>

#include "common/fault.h"

namespace haply {

using driver::Fault;

// Reads the body of `path`, e.g. "/version".
int32_t http_get(const char *host, int port, const char *path, std::string &body, Fault &fault);

// Returns the value of a header of `head`, whose lines end with CR LF; empty if absent.
std::string header_of(const std::string &head, const std::string &name);

}  // namespace haply
