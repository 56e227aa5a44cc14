// The client side of RFC 6455, of it what talks to a service on this machine: no extension, no
// subprotocol, no TLS.
#pragma once

#include <string>

#include "tcp.h"

namespace haply {

class WebSocket {
 public:
  int32_t open(const char *host, int port, int milliseconds, Fault &fault);
  // Says goodbye, and waits until what was sent has arrived.
  void close(int milliseconds);

  // A text that is sent: masked, as all that a client sends.
  std::string frame_of(const std::string &text);
  bool send_text(const char *text, size_t size, int milliseconds);
  // The next text: 1 when there is one, 0 when none came in time, else a code. Answers pings.
  int32_t receive(std::string &text, int milliseconds, Fault &fault);
  int descriptor() const { return tcp_.descriptor(); }

 private:
  struct Frame {
    unsigned opcode;
    bool last;
    size_t begin, size;
  };

  int32_t decode(Frame &frame, Fault &fault) const;
  int32_t take(const Frame &frame, std::string &text, Fault &fault);
  int32_t control(const Frame &frame, Fault &fault);
  void encode(unsigned opcode, const char *bytes, size_t size, std::string &out);
  bool send_frame(unsigned opcode, const char *bytes, size_t size, int milliseconds);
  uint32_t next_mask();

  Tcp tcp_;
  std::string unread_, message_, scratch_;
  bool inside_ = false;  // of a message in several frames
  uint64_t mask_ = 0;
};

}  // namespace haply
