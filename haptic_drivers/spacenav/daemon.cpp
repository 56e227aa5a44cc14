// Connection, protocol negotiation and packets.
#include "daemon.h"

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <vector>

namespace spacenav {
namespace {

// Tag of queries and answers in the upper half of packet.type; as the float that protocol 0
// expects, it is NaN.
constexpr int32_t kTag = 0x7faa0000;
constexpr int32_t kChangeProtocol = kTag | 0x5500;
constexpr int32_t kNewestProtocol = 1;
constexpr int32_t kDeviceName = kTag | 0x2000;
constexpr int32_t kDeviceButtons = kTag | 0x2003;

// The timeout of libspnav; only open() queries.
constexpr int kAnswerMs = 300;

// Bytes of a string per packet.
constexpr int32_t kTextBytes = 24;

// Returns the socket in the configuration of spacenavd, or "".
std::string configured_socket() {
  std::ifstream file("/etc/spnavrc");
  for (std::string line; std::getline(file, line);) {
    const size_t key = line.find_first_not_of(" \t");
    if (key == std::string::npos || line.compare(key, 6, "socket") != 0) continue;
    const size_t equals = line.find('=', key);
    if (equals == std::string::npos) continue;
    const size_t begin = line.find_first_not_of(" \t", equals + 1);
    if (begin == std::string::npos) continue;
    return line.substr(begin, line.find_last_not_of(" \t\r") - begin + 1);
  }
  return {};
}

std::vector<std::string> usual_sockets() {
  std::vector<std::string> paths;
  if (const char *named = std::getenv("SPNAV_SOCKET")) paths.emplace_back(named);
  if (std::string named = configured_socket(); !named.empty()) paths.push_back(std::move(named));
  paths.emplace_back("/var/run/spnav.sock");
  return paths;
}

int32_t refusal(int number, const std::string &path, Fault &fault) {
  if (number == EACCES || number == EPERM)
    return fault.set(MVS_DRIVER_E_PERMISSION,
                     "this user may not open %s: see the rights of that file, which spacenavd made",
                     path.c_str());
  return fault.set(
      MVS_DRIVER_E_LIBRARY,
      "spacenavd does not answer at %s (%s): install and start it "
      "(apt-get install spacenavd; systemctl start spacenavd), or name its socket with "
      "the option socket",
      path.c_str(), std::strerror(number));
}

}  // namespace

int32_t Daemon::open(const char *path, Fault &fault) {
  int32_t result = MVS_DRIVER_E_LIBRARY;
  for (const std::string &candidate : path ? std::vector<std::string>{path} : usual_sockets()) {
    result = connect_to(candidate, fault);
    if (result == MVS_DRIVER_OK) break;
  }
  return result == MVS_DRIVER_OK ? agree(fault) : result;
}

int32_t Daemon::connect_to(const std::string &path, Fault &fault) {
  close();
  path_ = path;
  sockaddr_un address = {};
  address.sun_family = AF_UNIX;
  if (path.empty() || path.size() >= sizeof address.sun_path)
    return fault.set(MVS_DRIVER_E_OPTION, "'%.200s' cannot be the path of a socket: %zu bytes",
                     path.c_str(), path.size());
  std::memcpy(address.sun_path, path.c_str(), path.size());
  socket_ = socket(AF_UNIX, SOCK_STREAM, 0);
  if (socket_ < 0 ||
      connect(socket_, reinterpret_cast<const sockaddr *>(&address), sizeof address) != 0) {
    const int number = errno;
    close();
    return refusal(number, path, fault);
  }
  return MVS_DRIVER_OK;
}

// Protocol 1 supports queries and reports disconnection. A spacenavd before 1.0 takes the request
// as a sensitivity of NaN; the second message sets it to 1.
int32_t Daemon::agree(Fault &fault) {
  const int32_t request = kChangeProtocol | kNewestProtocol;
  if (!send_all(&request, sizeof request))
    return fault.set(MVS_DRIVER_E_LOST, "spacenavd at %s closed the connection at once",
                     path_.c_str());
  int32_t answer = 0;
  protocol_ = 0;
  if (readable(kAnswerMs) &&
      recv(socket_, &answer, sizeof answer, MSG_PEEK) == ssize_t{sizeof answer} &&
      (answer & ~0xff) == kChangeProtocol) {
    protocol_ = answer & 0xff;
    if (recv(socket_, &answer, sizeof answer, 0) == ssize_t{sizeof answer}) return MVS_DRIVER_OK;
  }
  const float sensitivity = 1;
  if (send_all(&sensitivity, sizeof sensitivity)) return MVS_DRIVER_OK;
  return fault.set(MVS_DRIVER_E_LOST, "spacenavd at %s closed the connection", path_.c_str());
}

void Daemon::close() {
  if (socket_ >= 0) ::close(socket_);
  socket_ = -1;
  begin_ = end_ = 0;
}

bool Daemon::device(std::string &name, int32_t &buttons) {
  Packet packet = {};
  name.clear();
  buttons = 2;
  if (!ask(kDeviceName, packet) || packet.data[6] < 0) return false;
  for (int32_t left = packet.data[6] & 0xffff;; left -= kTextBytes) {
    const auto *text = reinterpret_cast<const char *>(packet.data);
    name.append(text, static_cast<size_t>(std::clamp(left, 0, kTextBytes)));
    if (left <= kTextBytes || !await(kDeviceName, packet)) break;
  }
  if (ask(kDeviceButtons, packet) && packet.data[6] == 0)
    buttons = std::clamp(packet.data[0], 0, 32);
  return true;
}

bool Daemon::ask(int32_t question, Packet &answer) {
  const Packet packet = {question, {}};
  return send_all(&packet, sizeof packet) && await(question, answer);
}

// Events received meanwhile are older than open(), and dropped.
bool Daemon::await(int32_t question, Packet &answer) {
  Fault ignored;
  for (;;) {
    const int32_t got = next(answer, ignored);
    if (got < 0 || (got == 0 && !readable(kAnswerMs))) return false;
    if (got == 1 && answer.type == question) return true;
  }
}

int32_t Daemon::next(Packet &packet, Fault &fault) {
  if (end_ - begin_ < sizeof packet) {
    std::memmove(buffer_, buffer_ + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
    const ssize_t got = recv(socket_, buffer_ + end_, sizeof buffer_ - end_, MSG_DONTWAIT);
    if (got == 0 || (got < 0 && errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR))
      return fault.set(MVS_DRIVER_E_LOST,
                       "spacenavd at %s is gone: start it (systemctl start spacenavd) and open the "
                       "device again",
                       path_.c_str());
    if (got > 0) end_ += static_cast<size_t>(got);
  }
  if (end_ - begin_ < sizeof packet) return 0;
  std::memcpy(&packet, buffer_ + begin_, sizeof packet);
  begin_ += sizeof packet;
  return 1;
}

bool Daemon::send_all(const void *bytes, size_t size) const {
  return send(socket_, bytes, size, MSG_NOSIGNAL) == static_cast<ssize_t>(size);
}

bool Daemon::readable(int milliseconds) const {
  pollfd waiting = {socket_, POLLIN, 0};
  return poll(&waiting, 1, milliseconds) > 0;
}

}  // namespace spacenav
