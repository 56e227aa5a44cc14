// Non-blocking sockets with poll().
#include "tcp.h"

#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <memory>
#include <string>

namespace haply {
namespace {

uint64_t deadline_in(int milliseconds) {
  return monotonic_ns() + static_cast<uint64_t>(std::max(milliseconds, 0)) * 1000000;
}

int left_until(uint64_t deadline) {
  const uint64_t now = monotonic_ns();
  return now >= deadline ? 0 : static_cast<int>((deadline - now + 999999) / 1000000);
}

}  // namespace

uint64_t monotonic_ns() {
  timespec now = {};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<uint64_t>(now.tv_sec) * 1000000000 + static_cast<uint64_t>(now.tv_nsec);
}

int32_t Tcp::open(const char *host, int port, int milliseconds, Fault &fault) {
  close();
  addrinfo wanted = {}, *found = nullptr;
  wanted.ai_socktype = SOCK_STREAM;
  const int unknown = getaddrinfo(host, std::to_string(port).c_str(), &wanted, &found);
  if (unknown != 0)
    return fault.set(MVS_DRIVER_E_OPTION, "option host '%.80s': %s", host, gai_strerror(unknown));
  const std::unique_ptr<addrinfo, void (*)(addrinfo *)> addresses(found, freeaddrinfo);
  int number = 0;
  // "localhost" is ::1 and 127.0.0.1; the service may listen on one of them only
  for (const addrinfo *one = found; one; one = one->ai_next) {
    socket_ = socket(one->ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    int refused = 0;
    socklen_t size = sizeof refused;
    if (connect(socket_, one->ai_addr, one->ai_addrlen) != 0) refused = errno;
    if (refused == EINPROGRESS && wait(POLLOUT, milliseconds))
      getsockopt(socket_, SOL_SOCKET, SO_ERROR, &refused, &size);
    if (refused == 0) break;
    number = refused;
    close();
  }
  if (socket_ < 0)
    return fault.set(MVS_DRIVER_E_LIBRARY,
                     "the Haply Inverse Service does not answer at %.80s:%d (%s): install it with "
                     "the Haply Hub and start it (systemctl start haply-inverse-service), or give "
                     "the options host and port",
                     host, port, std::strerror(number));
  // disables Nagle's algorithm: a force must not wait for the acknowledgement of the last one
  const int at_once = 1;
  setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &at_once, sizeof at_once);
  return MVS_DRIVER_OK;
}

void Tcp::close() {
  if (socket_ >= 0) ::close(socket_);
  socket_ = -1;
}

void Tcp::finish(int milliseconds) {
  if (socket_ < 0) return;
  shutdown(socket_, SHUT_WR);
  const uint64_t deadline = deadline_in(milliseconds);
  char unread[4096];
  while (left_until(deadline) > 0 && receive(unread, sizeof unread, left_until(deadline)) > 0) {
  }
  close();
}

bool Tcp::send_all(const void *bytes, size_t size, int milliseconds) const {
  const auto *next = static_cast<const char *>(bytes);
  const uint64_t deadline = deadline_in(milliseconds);
  while (size > 0) {
    const ssize_t sent = send(socket_, next, size, MSG_NOSIGNAL);
    if (sent > 0) {
      next += sent;
      size -= static_cast<size_t>(sent);
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      if (!wait(POLLOUT, left_until(deadline))) return false;
    } else if (errno != EINTR) {
      return false;
    }
  }
  return true;
}

int Tcp::receive(void *bytes, size_t size, int milliseconds) const {
  for (int attempt = 0; attempt < 2; ++attempt) {
    const ssize_t got = recv(socket_, bytes, size, 0);
    if (got > 0) return static_cast<int>(got);
    if (got == 0 || (errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR)) return -1;
    if (attempt == 0 && !wait(POLLIN, milliseconds)) return 0;
  }
  return 0;
}

bool Tcp::wait(short events, int milliseconds) const {
  pollfd waiting = {socket_, events, 0};
  return poll(&waiting, 1, milliseconds) > 0;
}

}  // namespace haply
