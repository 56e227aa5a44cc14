// TCP client whose waits all have a timeout.
#pragma once

#include <cstddef>
#include <cstdint>

#include "common/fault.h"

namespace haply {

using driver::Fault;

// Time of CLOCK_MONOTONIC.
uint64_t monotonic_ns();

class Tcp {
 public:
  Tcp() = default;
  ~Tcp() { close(); }
  Tcp(const Tcp &) = delete;
  Tcp &operator=(const Tcp &) = delete;

  int32_t open(const char *host, int port, int milliseconds, Fault &fault);
  void close();
  // Closes after the peer has received all sent bytes: close() with unread input would discard
  // them.
  void finish(int milliseconds);

  bool send_all(const void *bytes, size_t size, int milliseconds) const;
  // Returns the number of received bytes, 0 on timeout, -1 if the peer closed the connection.
  int receive(void *bytes, size_t size, int milliseconds) const;
  int descriptor() const { return socket_; }

 private:
  bool wait(short events, int milliseconds) const;

  int socket_ = -1;
};

}  // namespace haply
