#include "websocket.h"

#include <algorithm>
#include <cstring>

#include "accept.h"
#include "http.h"

namespace haply {
namespace {

enum : unsigned { kContinued = 0, kText = 1, kClose = 8, kPing = 9, kPong = 10 };

// A state of a few devices is about 5 kB.
constexpr size_t kLongestMessage = size_t{1} << 20;

int32_t broken(Fault &fault, const char *what) {
  return fault.set(MVS_DRIVER_E_FAULT, "the service broke the WebSocket protocol: %s", what);
}

int32_t gone(Fault &fault) {
  return fault.set(MVS_DRIVER_E_LOST,
                   "the Haply Inverse Service closed the connection: see its log in "
                   "/var/log/haply-inverse-service and open the device again");
}

}  // namespace

int32_t WebSocket::open(const char *host, int port, int milliseconds, Fault &fault) {
  int32_t result = tcp_.open(host, port, milliseconds, fault);
  if (result != MVS_DRIVER_OK) return result;
  unread_.clear();
  message_.clear();
  inside_ = false;
  mask_ = monotonic_ns();
  std::string nonce(16, '\0');
  for (char &byte : nonce) byte = static_cast<char>(next_mask());
  const std::string key = base64(nonce);
  const std::string request = std::string("GET / HTTP/1.1\r\nHost: ") + host + ":" +
                              std::to_string(port) +
                              "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                              "Sec-WebSocket-Key: " +
                              key + "\r\nSec-WebSocket-Version: 13\r\n\r\n";
  if (!tcp_.send_all(request.data(), request.size(), milliseconds)) return gone(fault);
  const uint64_t deadline = monotonic_ns() + static_cast<uint64_t>(milliseconds) * 1000000;
  size_t end = std::string::npos;
  while (end == std::string::npos && unread_.size() < 16384 && monotonic_ns() < deadline) {
    char bytes[2048];
    const int got = tcp_.receive(bytes, sizeof bytes, milliseconds);
    if (got <= 0) break;
    unread_.append(bytes, static_cast<size_t>(got));
    end = unread_.find("\r\n\r\n");
  }
  if (end == std::string::npos || unread_.compare(0, 12, "HTTP/1.1 101") != 0)
    return fault.set(MVS_DRIVER_E_FAULT, "%.80s:%d does not open a WebSocket: is that the service?",
                     host, port);
  const std::string head = unread_.substr(0, end + 4);
  unread_.erase(0, end + 4);
  if (header_of(head, "Sec-WebSocket-Accept") != accept_of(key))
    return broken(fault, "its Sec-WebSocket-Accept is not that of our key");
  return MVS_DRIVER_OK;
}

void WebSocket::close(int milliseconds) {
  if (tcp_.descriptor() < 0) return;
  constexpr char kNormal[] = {'\x03', '\xe8'};  // 1000
  send_frame(kClose, kNormal, sizeof kNormal, milliseconds);
  tcp_.finish(milliseconds);
}

// SplitMix64. Masks protect proxies against text chosen by a web page; here the driver writes all
// text, so that any mask is sufficient.
uint32_t WebSocket::next_mask() {
  uint64_t z = mask_ += 0x9e3779b97f4a7c15;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  return static_cast<uint32_t>((z ^ (z >> 27)) >> 32);
}

// Appends a frame that is complete in itself; nothing that we send is longer than 64 kB.
void WebSocket::encode(unsigned opcode, const char *bytes, size_t size, std::string &out) {
  out += static_cast<char>(0x80 | opcode);
  if (size < 126) {
    out += static_cast<char>(0x80 | size);
  } else {
    out += static_cast<char>(0x80 | 126);
    out += static_cast<char>(size >> 8);
    out += static_cast<char>(size);
  }
  const uint32_t mask = next_mask();
  char key[4];
  std::memcpy(key, &mask, sizeof key);
  out.append(key, sizeof key);
  for (size_t i = 0; i < size; ++i) out += static_cast<char>(bytes[i] ^ key[i % 4]);
}

std::string WebSocket::frame_of(const std::string &text) {
  std::string frame;
  encode(kText, text.data(), text.size(), frame);
  return frame;
}

bool WebSocket::send_text(const char *text, size_t size, int milliseconds) {
  return send_frame(kText, text, size, milliseconds);
}

bool WebSocket::send_frame(unsigned opcode, const char *bytes, size_t size, int milliseconds) {
  scratch_.clear();
  encode(opcode, bytes, size, scratch_);
  return tcp_.send_all(scratch_.data(), scratch_.size(), milliseconds);
}

// Reads at least once, and not after the deadline: pings without end must not keep a force back.
int32_t WebSocket::receive(std::string &text, int milliseconds, Fault &fault) {
  const uint64_t deadline = monotonic_ns() + static_cast<uint64_t>(milliseconds) * 1000000;
  for (bool waited = false;; waited = true) {
    Frame frame = {};
    int32_t result = 0;
    while ((result = decode(frame, fault)) == 1)
      if ((result = take(frame, text, fault)) != 0) break;
    if (result != 0) return result;
    const uint64_t now = monotonic_ns();
    if (waited && now >= deadline) return 0;
    char bytes[16384];
    const int got = tcp_.receive(bytes, sizeof bytes,
                                 now < deadline ? static_cast<int>((deadline - now) / 1000000) : 0);
    if (got < 0) return gone(fault);
    if (got == 0) return 0;
    unread_.append(bytes, static_cast<size_t>(got));
  }
}

// Decodes the first received frame: returns 1 if it is complete, 0 if not.
int32_t WebSocket::decode(Frame &frame, Fault &fault) const {
  if (unread_.size() < 2) return 0;
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(unread_[i]); };
  const unsigned opcode = byte(0) & 15u;
  if (byte(0) & 0x70u) return broken(fault, "a frame uses an extension that was not requested");
  if (byte(1) & 0x80u) return broken(fault, "a frame is masked");
  uint64_t size = byte(1) & 0x7fu;
  const size_t wide = size == 126 ? 2 : size == 127 ? 8 : 0;
  if (unread_.size() < 2 + wide) return 0;
  if (wide) size = 0;
  for (size_t i = 0; i < wide; ++i) size = size << 8 | byte(2 + i);
  const bool last = (byte(0) & 0x80u) != 0;
  if (opcode >= kClose && (!last || wide)) return broken(fault, "a control frame is too long");
  if (size > kLongestMessage || message_.size() + size > kLongestMessage)
    return broken(fault, "a message is longer than 1 MiB");
  if (unread_.size() < 2 + wide + size) return 0;
  frame = {opcode, last, 2 + wide, static_cast<size_t>(size)};
  return 1;
}

// 1 when a text is complete, 0 to go on.
int32_t WebSocket::take(const Frame &frame, std::string &text, Fault &fault) {
  int32_t result = 0;
  if (frame.opcode >= kClose) {
    result = control(frame, fault);
  } else if (frame.opcode > kText) {
    result = broken(fault, "a frame is not text");
  } else if ((frame.opcode == kContinued) != inside_) {
    result = broken(fault, "the frames of a message are not in order");
  } else {
    message_.append(unread_, frame.begin, frame.size);
    inside_ = !frame.last;
    result = frame.last ? 1 : 0;
  }
  unread_.erase(0, frame.begin + frame.size);
  if (result == 1) {
    text.swap(message_);
    message_.clear();
  }
  return result;
}

int32_t WebSocket::control(const Frame &frame, Fault &fault) {
  const std::string bytes = unread_.substr(frame.begin, frame.size);
  if (frame.opcode == kPing)
    return send_frame(kPong, bytes.data(), bytes.size(), 100) ? 0 : gone(fault);
  if (frame.opcode == kPong) return 0;
  if (frame.opcode != kClose) return broken(fault, "an unknown kind of frame");
  send_frame(kClose, bytes.data(), std::min<size_t>(bytes.size(), 2), 100);
  return gone(fault);
}

}  // namespace haply
