// Fixture: a stand-in for spacenavd, the daemon of 3D mice, on a socket of its own.
#pragma once

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <doctest/doctest.h>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

using Packet = std::array<int32_t, 8>;

// Answers the requests of libspnav (FreeSpacenav/libspnav src/proto.h) and sends events for the
// test.
class FakeDaemon {
 public:
  enum Kind { kNew, kOld, kNoMouse };

  explicit FakeDaemon(Kind kind = kNew) : kind_(kind) {
    char folder[] = "/tmp/mvs_spacenav_XXXXXX";
    REQUIRE(mkdtemp(folder));
    folder_ = folder;
    sockaddr_un address = {};
    address.sun_family = AF_UNIX;
    std::strcpy(address.sun_path, path().c_str());
    listening_ = socket(AF_UNIX, SOCK_STREAM, 0);
    REQUIRE_EQ(bind(listening_, reinterpret_cast<sockaddr *>(&address), sizeof address), 0);
    REQUIRE_EQ(listen(listening_, 4), 0);
    thread_ = std::thread([this] { serve(); });
  }
  ~FakeDaemon() { stop(); }

  std::string path() const { return folder_ + "/socket"; }
  void stop() {
    if (!thread_.joinable()) return;
    stopping_ = true;
    thread_.join();
    for (const pollfd &waiting : sockets_) close(waiting.fd);
    unlink(path().c_str());
    rmdir(folder_.c_str());
  }
  void send(const void *bytes, size_t size) {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (size_t i = 1; i < sockets_.size(); ++i) ::send(sockets_[i].fd, bytes, size, MSG_NOSIGNAL);
  }
  void send(const Packet &packet) { send(packet.data(), sizeof packet); }
  void motion(const std::array<int32_t, 6> &axes) {
    send({0, axes[0], axes[1], axes[2], axes[3], axes[4], axes[5], 8});
  }

 private:
  void serve() {
    sockets_.push_back({listening_, POLLIN, 0});
    while (!stopping_) {
      if (poll(sockets_.data(), sockets_.size(), 5) <= 0) continue;
      const std::lock_guard<std::mutex> lock(mutex_);
      for (size_t i = sockets_.size(); i-- > 1;)
        if (sockets_[i].revents && !answer(sockets_[i].fd)) {
          close(sockets_[i].fd);
          sockets_.erase(sockets_.begin() + static_cast<std::ptrdiff_t>(i));
        }
      if (sockets_[0].revents)
        sockets_.push_back({accept(listening_, nullptr, nullptr), POLLIN, 0});
    }
  }
  bool answer(int client) const {
    Packet packet = {};
    const ssize_t got = recv(client, packet.data(), sizeof packet, 0);
    if (got <= 0) return false;
    if (kind_ == kOld) return true;  // takes every request for sensitivities
    if (got == 4) return ::send(client, packet.data(), 4, MSG_NOSIGNAL) == 4;
    return reply(client, packet);
  }
  bool reply(int client, Packet packet) const {
    const auto say = [&] { return ::send(client, packet.data(), sizeof packet, MSG_NOSIGNAL) > 0; };
    packet[7] = kind_ == kNoMouse ? -1 : 0;
    if (kind_ == kNoMouse) return say();
    if ((packet[0] & 0xffff) == 0x2003) packet[1] = 15;
    if ((packet[0] & 0xffff) != 0x2000) return say();
    // a name in more than one packet
    const std::string name = "3Dconnexion SpaceMouse Pro Wireless";
    std::memcpy(&packet[1], name.data(), 24);
    packet[7] = static_cast<int32_t>(name.size());
    if (!say()) return false;
    std::memset(&packet[1], 0, 24);
    std::memcpy(&packet[1], name.data() + 24, name.size() - 24);
    packet[7] = static_cast<int32_t>(name.size() - 24) | 0x10000;
    return say();
  }

  Kind kind_;
  std::string folder_;
  int listening_ = -1;
  std::vector<pollfd> sockets_;
  std::mutex mutex_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

inline constexpr uint64_t kMs = 1000000;  // ns
