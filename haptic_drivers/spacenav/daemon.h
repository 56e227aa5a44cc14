// Client of spacenavd's socket: packets of eight 32-bit integers in native byte order, for events
// and answers (FreeSpacenav/libspnav src/proto.h).
#pragma once

#include <cstddef>
#include <string>

#include "common/fault.h"

namespace spacenav {

using driver::Fault;

struct Packet {
  int32_t type;
  int32_t data[7];
};
static_assert(sizeof(Packet) == 32);

// Events of spacenavd: packet.type.
enum Event : int32_t {
  kMotion = 0,   // data: x y z rx ry rz, ms since the last one
  kPress = 1,    // data[0]: the button
  kRelease = 2,  // likewise
  kDevice = 3    // data[0]: 0 plugged in, 1 unplugged; from protocol 1 on
};

class Daemon {
 public:
  Daemon() = default;
  ~Daemon() { close(); }
  Daemon(const Daemon &) = delete;
  Daemon &operator=(const Daemon &) = delete;

  // Connects to the socket `path`; if it is null, to those of libspnav: $SPNAV_SOCKET, the line
  // "socket =" of /etc/spnavrc, /var/run/spnav.sock.
  int32_t open(const char *path, Fault &fault);
  void close();
  // The negotiated protocol version: 0 for a spacenavd before 1.0, which answers no queries.
  int protocol() const { return protocol_; }
  const std::string &path() const { return path_; }

  // Returns whether a device is connected, with its name and buttons; false for protocol 0.
  bool device(std::string &name, int32_t &buttons);

  // Takes the next packet without waiting: 1 for a packet, 0 without one, or MVS_DRIVER_E_LOST.
  int32_t next(Packet &packet, Fault &fault);

 private:
  int32_t connect_to(const std::string &path, Fault &fault);
  int32_t agree(Fault &fault);
  bool ask(int32_t question, Packet &answer);
  bool await(int32_t question, Packet &answer);
  bool send_all(const void *bytes, size_t size) const;
  bool readable(int milliseconds) const;

  int socket_ = -1;
  int protocol_ = 0;
  std::string path_;
  alignas(Packet) char buffer_[64 * sizeof(Packet)];
  size_t begin_ = 0, end_ = 0;
};

}  // namespace spacenav
