// A stand-in for the Haply Inverse Service: one port for HTTP and WebSocket, one state for each
// message. Frames have the shapes of docs.haply.co (WebSocket Protocol, 3.5) and of the crate haply
// 1.3.1.
#pragma once

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "../../haptic_drivers/haply/accept.h"
#include "plugin.h"

// A frame of a server, which is not masked.
inline std::string ws_frame(const std::string &text, unsigned first = 0x81) {
  std::string out(1, static_cast<char>(first));
  const size_t size = text.size();
  const int wide = size < 126 ? 0 : size < 65536 ? 2 : 8;
  out += static_cast<char>(wide == 0 ? size : wide == 2 ? 126 : 127);
  for (int i = wide; i-- > 0;) out += static_cast<char>(size >> (8 * i));
  return out + text;
}

inline std::string haply_state(double x, const char *more = "") {
  return R"({"session_id":7,"inverse3":[{"device_id":"049D","state":{"cursor_position":{"x":)" +
         std::to_string(x) +
         R"(,"y":-0.12,"z":0.15},"cursor_velocity":{"x":0.5,"y":0.0,"z":-0.25},)" +
         R"("mode":"idle","transform":{}},"status":{"calibrated":true,"in_use":false,)" +
         R"("power_supply":true,"ready":true,"started":true}}],"verse_grip":[],)" +
         R"("wireless_verse_grip":[{"device_id":"1102","state":{"battery_level":0.158,)" +
         R"("buttons":{"a":true,"b":false,"c":true},"hall":16,"orientation":)" +
         R"({"x":0.0,"y":0.0,"z":-0.6,"w":0.8}},"status":{"awake":true}}])" + more + "}";
}

inline std::string haply_inventory() {
  return R"({"session_id":7,"inverse3":[{"device_id":"049D","config":{"type":"inverse3",)"
         R"("port":"COM12","device_info":{"major_version":7,"minor_version":4,"id":"049D",)"
         R"("device_type":4,"uuid":"5A9F"},"extended_device_id":"ED78730C81735607",)"
         R"("extended_firmware_version":"8C20FDC8","handedness":"right","preset":"defaults",)"
         R"("basis":{"permutation":"XYZ"}},"state":{"cursor_position":{"x":0.0,"y":-0.12,"z":0.15}},)"
         R"("status":{"calibrated":true,"in_use":false,"power_supply":true}}],"verse_grip":[],)"
         R"("wireless_verse_grip":[{"device_id":"1102","config":{"type":"wireless_verse_grip"},)"
         R"("state":{"buttons":{"a":false,"b":false,"c":false},"orientation":{"x":0,"y":0,"z":0,)"
         R"("w":1}},"status":{"connected":true,"awake":true,"ready":true}}]})";
}

class HaplyService {
 public:
  // The bytes that answer the n-th text of a connection; empty: silence.
  using Reply = std::function<std::string(int n, const std::string &text)>;

  explicit HaplyService(Reply reply, std::string version = "3.5.0.0",
                        std::string inventory = haply_inventory())
      : reply_(std::move(reply)), version_(std::move(version)), inventory_(std::move(inventory)) {
    sockaddr_in address = {};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    listening_ = socket(AF_INET, SOCK_STREAM, 0);
    REQUIRE_EQ(bind(listening_, reinterpret_cast<sockaddr *>(&address), size), 0);
    REQUIRE_EQ(listen(listening_, 16), 0);
    getsockname(listening_, reinterpret_cast<sockaddr *>(&address), &size);
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] { serve(); });
  }
  ~HaplyService() { stop(); }

  std::string port() const { return std::to_string(port_); }
  void stop() {
    if (!thread_.joinable()) return;
    stopping_ = true;
    thread_.join();
    close(listening_);
  }
  // All texts that clients sent, without the WebSocket's opening.
  std::vector<std::string> texts() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return texts_;
  }
  std::string last() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return texts_.empty() ? "" : texts_.back();
  }
  std::string closed_with() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return close_;
  }
  std::string pong() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return pong_;
  }

  // The answer to GET /version, if not the default one.
  std::string http;

 private:
  void serve() {
    std::vector<std::thread> clients;
    while (!stopping_) {
      pollfd waiting = {listening_, POLLIN, 0};
      if (poll(&waiting, 1, 5) <= 0) continue;
      const int client = accept(listening_, nullptr, nullptr);
      clients.emplace_back([this, client] {
        talk(client);
        close(client);
      });
    }
    for (std::thread &client : clients) client.join();
  }

  // Returns false when the client has left or the test has ended.
  bool more(int client, std::string &bytes) const {
    while (!stopping_) {
      pollfd waiting = {client, POLLIN, 0};
      if (poll(&waiting, 1, 5) <= 0) continue;
      char got[4096];
      const ssize_t size = recv(client, got, sizeof got, 0);
      if (size > 0) bytes.append(got, static_cast<size_t>(size));
      return size > 0;
    }
    return false;
  }
  static void say(int client, const std::string &bytes) {
    send(client, bytes.data(), bytes.size(), MSG_NOSIGNAL);
  }

  void talk(int client) {
    std::string head;
    while (head.find("\r\n\r\n") == std::string::npos)
      if (!more(client, head)) return;
    const size_t key = head.find("Sec-WebSocket-Key: ");
    if (key == std::string::npos) return say(client, http.empty() ? answer() : http);
    const std::string nonce = head.substr(key + 19, head.find("\r\n", key) - key - 19);
    say(client,
        "HTTP/1.1 101 Switching Protocols\r\nupgrade: websocket\r\nconnection: Upgrade\r\n"
        "sec-websocket-accept: " +
            haply::accept_of(nonce) + "\r\n\r\n" + ws_frame(inventory_));
    converse(client, head.substr(head.find("\r\n\r\n") + 4));
  }
  std::string answer() const {
    const std::string body = R"({"build_time":"2026-05-01T00:00:00Z","git_tag":")" + version_ +
                             R"(","project_name":"haply-inverse-service","project_version":")" +
                             version_ + "\"}";
    return "HTTP/1.1 200 OK\r\nContent-Type: application/json\r\nContent-Length: " +
           std::to_string(body.size()) + "\r\n\r\n" + body;
  }

  void converse(int client, std::string bytes) {
    for (int n = 0;;) {
      unsigned opcode = 0;
      std::string text;
      while (!unframe(bytes, opcode, text))
        if (!more(client, bytes)) return;
      {
        const std::lock_guard<std::mutex> lock(mutex_);
        if (opcode == 1) texts_.push_back(text);
        if (opcode == 8) close_ = text;
        if (opcode == 10) pong_ = text;
      }
      if (opcode == 8) return say(client, ws_frame(text, 0x88));
      if (opcode == 1) say(client, reply_(n++, text));
    }
  }
  // The first frame of a client, which must be masked.
  static bool unframe(std::string &bytes, unsigned &opcode, std::string &text) {
    const auto byte = [&](size_t i) { return static_cast<unsigned char>(bytes[i]); };
    if (bytes.size() < 2) return false;
    const size_t wide = (byte(1) & 127u) == 126 ? 2 : 0;
    if (bytes.size() < 2 + wide + 4) return false;
    const size_t size = wide ? byte(2) * 256u + byte(3) : byte(1) & 127u;
    if (bytes.size() < 6 + wide + size) return false;
    opcode = byte(1) & 128u ? byte(0) & 15u : 99;
    text = bytes.substr(6 + wide, size);
    for (size_t i = 0; i < size; ++i)
      text[i] = static_cast<char>(text[i] ^ bytes[2 + wide + i % 4]);
    bytes.erase(0, 6 + wide + size);
    return true;
  }

  Reply reply_;
  std::string version_, inventory_;
  int listening_ = -1, port_ = 0;
  mutable std::mutex mutex_;
  std::vector<std::string> texts_;
  std::string close_, pong_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

// Events of another thread are waited for, not timed: a busy machine only takes longer.
inline bool eventually(const std::function<bool()> &true_at_last) {
  for (int i = 0; i < 10000; ++i) {
    if (true_at_last()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}
