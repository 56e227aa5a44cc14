// A connection whose every wait has an end.
#pragma once

#include <cstddef>
#include <cstdint>

#include "common/fault.h"

namespace haply {

using driver::Fault;

// Of CLOCK_MONOTONIC.
uint64_t monotonic_ns();

class Tcp {
 public:
  Tcp() = default;
  ~Tcp() { close(); }
  Tcp(const Tcp &) = delete;
  Tcp &operator=(const Tcp &) = delete;

  int32_t open(const char *host, int port, int milliseconds, Fault &fault);
  void close();
  // Closes after all that was sent has arrived: closing over unread bytes would throw it away.
  void finish(int milliseconds);

  bool send_all(const void *bytes, size_t size, int milliseconds) const;
  // How many bytes came, 0 when none did in time, -1 when the other side is gone.
  int receive(void *bytes, size_t size, int milliseconds) const;
  int descriptor() const { return socket_; }

 private:
  bool wait(short events, int milliseconds) const;

  int socket_ = -1;
};

}  // namespace haply
