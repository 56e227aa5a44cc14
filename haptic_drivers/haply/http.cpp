// Minimal HTTP/1.1 client.
#include "http.h"

#include <strings.h>
#include <charconv>
#include <cstdlib>

#include "tcp.h"

namespace haply {
namespace {

constexpr int kHttpTimeoutMs = 1000;
constexpr size_t kLongestAnswer = size_t{1} << 20;

// Decodes chunked transfer coding (RFC 9112, section 7.1); an incomplete chunk ends the body.
std::string unchunked(const std::string &chunks) {
  std::string body;
  for (size_t at = 0; at < chunks.size();) {
    const size_t line = chunks.find("\r\n", at);
    size_t size = 0;
    if (line == std::string::npos) break;
    std::from_chars(chunks.data() + at, chunks.data() + line, size, 16);
    if (size == 0 || size > chunks.size() - (line + 2)) break;
    body.append(chunks, line + 2, size);
    at = line + 2 + size + 2;
  }
  return body;
}

// Receives until the service closes the connection, as requested, or the body is complete.
bool receive_all(const Tcp &tcp, std::string &answer, size_t &body) {
  const uint64_t deadline = monotonic_ns() + uint64_t{kHttpTimeoutMs} * 1000000;
  body = std::string::npos;
  size_t complete = kLongestAnswer;
  while (monotonic_ns() < deadline && answer.size() < complete) {
    char bytes[4096];
    const int got = tcp.receive(bytes, sizeof bytes, kHttpTimeoutMs);
    if (got <= 0) break;  // closed, or timed out
    answer.append(bytes, static_cast<size_t>(got));
    if (body != std::string::npos || (body = answer.find("\r\n\r\n")) == std::string::npos)
      continue;
    body += 4;
    const std::string length = header_of(answer.substr(0, body), "Content-Length");
    if (!length.empty()) complete = body + std::strtoul(length.c_str(), nullptr, 10);
  }
  return body != std::string::npos;
}

}  // namespace

std::string header_of(const std::string &head, const std::string &name) {
  for (size_t line = head.find("\r\n"); line != std::string::npos; line = head.find("\r\n", line)) {
    line += 2;
    if (strncasecmp(head.c_str() + line, name.c_str(), name.size()) != 0 ||
        head.compare(line + name.size(), 1, ":") != 0)
      continue;
    const size_t begin = head.find_first_not_of(" \t", line + name.size() + 1);
    const size_t end = head.find("\r\n", line);
    if (begin == std::string::npos || end == std::string::npos || begin >= end) return {};
    return head.substr(begin, head.find_last_not_of(" \t", end - 1) + 1 - begin);
  }
  return {};
}

int32_t http_get(const char *host, int port, const char *path, std::string &body, Fault &fault) {
  Tcp tcp;
  const int32_t result = tcp.open(host, port, kHttpTimeoutMs, fault);
  if (result != MVS_DRIVER_OK) return result;
  const std::string request = std::string("GET ") + path + " HTTP/1.1\r\nHost: " + host + ":" +
                              std::to_string(port) +
                              "\r\nAccept: application/json\r\nConnection: close\r\n\r\n";
  std::string answer;
  size_t begin = 0;
  if (!tcp.send_all(request.data(), request.size(), kHttpTimeoutMs) ||
      !receive_all(tcp, answer, begin))
    return fault.set(MVS_DRIVER_E_LOST, "%.80s:%d does not answer to GET %s: is that the service?",
                     host, port, path);
  const size_t status = answer.find(' ');
  if (answer.compare(0, 5, "HTTP/") != 0 || answer.compare(status + 1, 3, "200") != 0)
    return fault.set(MVS_DRIVER_E_FAULT, "%.80s:%d answers '%.60s' to GET %s: is that the service?",
                     host, port, answer.substr(0, answer.find("\r\n")).c_str(), path);
  const bool chunked =
      strcasecmp(header_of(answer.substr(0, begin), "Transfer-Encoding").c_str(), "chunked") == 0;
  body = chunked ? unchunked(answer.substr(begin)) : answer.substr(begin);
  return MVS_DRIVER_OK;
}

}  // namespace haply
