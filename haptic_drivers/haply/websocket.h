// WebSocket client (RFC 6455) for a local service: no extensions, subprotocols or TLS.
#pragma once

#include <string>

#include "tcp.h"

namespace haply {

class WebSocket {
 public:
  int32_t open(const char *host, int port, int milliseconds, Fault &fault);
  // Sends a close frame, and waits until the peer has received all bytes.
  void close(int milliseconds);

  // Returns the masked text frame of a client.
  std::string frame_of(const std::string &text);
  bool send_text(const char *text, size_t size, int milliseconds);
  // Receives the next text: 1 on success, 0 on timeout, otherwise an error code. Answers pings.
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
  bool inside_ = false;  // inside a message of several frames
  uint64_t mask_ = 0;
};

}  // namespace haply
