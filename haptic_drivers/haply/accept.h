// Sec-WebSocket-Accept of RFC 6455, section 1.3: base64(SHA-1(key + a fixed text)). SHA-1 (FIPS
// 180-4) is used for this purpose only.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>

namespace haply {

inline std::string base64(const std::string &bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t three = 0;
    for (size_t k = 0; k < 3; ++k)
      three = three << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (size_t k = 0; k < 4; ++k)
      out += i + k <= bytes.size() ? kDigits[three >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

inline void sha1_block(const std::string &bytes, size_t at, std::array<uint32_t, 5> &hash) {
  uint32_t w[80];
  for (size_t t = 0; t < 80; ++t) {
    w[t] = 0;
    if (t >= 16) w[t] = std::rotl(w[t - 3] ^ w[t - 8] ^ w[t - 14] ^ w[t - 16], 1);
    for (size_t k = 0; t < 16 && k < 4; ++k)
      w[t] = w[t] << 8 | static_cast<unsigned char>(bytes[at + 4 * t + k]);
  }
  auto [a, b, c, d, e] = hash;
  for (size_t t = 0; t < 80; ++t) {
    uint32_t f = b ^ c ^ d, k = t < 40 ? 0x6ed9eba1 : 0xca62c1d6;
    if (t < 20) f = (b & c) | (~b & d), k = 0x5a827999;
    if (t >= 40 && t < 60) f = (b & c) | (b & d) | (c & d), k = 0x8f1bbcdc;
    const uint32_t next = std::rotl(a, 5) + f + e + k + w[t];
    e = d, d = c, c = std::rotl(b, 30), b = a, a = next;
  }
  hash = {hash[0] + a, hash[1] + b, hash[2] + c, hash[3] + d, hash[4] + e};
}

inline std::string sha1(std::string bytes) {
  std::array<uint32_t, 5> hash = {0x67452301, 0xefcdab89, 0x98badcfe, 0x10325476, 0xc3d2e1f0};
  const uint64_t bits = 8 * uint64_t{bytes.size()};
  bytes += '\x80';
  while (bytes.size() % 64 != 56) bytes += '\0';
  for (int shift = 56; shift >= 0; shift -= 8) bytes += static_cast<char>(bits >> shift);
  for (size_t at = 0; at < bytes.size(); at += 64) sha1_block(bytes, at, hash);
  std::string out;
  for (const uint32_t word : hash)
    for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(word >> shift);
  return out;
}

inline std::string accept_of(const std::string &key) {
  return base64(sha1(key + "258EAFA5-E914-47DA-95CA-C5AB0DC85B11"));
}

}  // namespace haply
