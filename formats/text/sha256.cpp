// SHA-256; names and section numbers are those of FIPS 180-4.
#include "formats/text/sha256.h"

#include <algorithm>
#include <bit>

namespace mvs::core {
namespace {

// Section 4.2.2: the cube roots of the first 64 primes.
constexpr uint32_t k256[64] = {
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

uint32_t word_at(const char *bytes) {
  uint32_t word = 0;
  for (int k = 0; k < 4; ++k) word = word << 8 | static_cast<unsigned char>(bytes[k]);
  return word;
}

// Section 4.1.2.
uint32_t sum0(uint32_t x) {
  return std::rotr(x, 2) ^ std::rotr(x, 13) ^ std::rotr(x, 22);
}
uint32_t sum1(uint32_t x) {
  return std::rotr(x, 6) ^ std::rotr(x, 11) ^ std::rotr(x, 25);
}
uint32_t sigma0(uint32_t x) {
  return std::rotr(x, 7) ^ std::rotr(x, 18) ^ x >> 3;
}
uint32_t sigma1(uint32_t x) {
  return std::rotr(x, 17) ^ std::rotr(x, 19) ^ x >> 10;
}

}  // namespace

// Section 6.2.2.
void Sha256::add_block(const char *block) {
  uint32_t w[64];
  for (int t = 0; t < 16; ++t) w[t] = word_at(block + 4 * t);
  for (int t = 16; t < 64; ++t) {
    w[t] = sigma1(w[t - 2]) + w[t - 7] + sigma0(w[t - 15]) + w[t - 16];
  }
  auto [a, b, c, d, e, f, g, h] = h_;
  for (int t = 0; t < 64; ++t) {
    const uint32_t t1 = h + sum1(e) + ((e & f) ^ (~e & g)) + k256[t] + w[t];
    const uint32_t t2 = sum0(a) + ((a & b) ^ (a & c) ^ (b & c));
    h = g;
    g = f;
    f = e;
    e = d + t1;
    d = c;
    c = b;
    b = a;
    a = t1 + t2;
  }
  const uint32_t change[8] = {a, b, c, d, e, f, g, h};
  for (int k = 0; k < 8; ++k) h_[k] += change[k];
}

void Sha256::add(std::string_view bytes) {
  const size_t waiting = bytes_ % begun_.size();
  bytes_ += bytes.size();
  if (waiting > 0) {
    const size_t taken = std::min(begun_.size() - waiting, bytes.size());
    std::copy_n(bytes.data(), taken, begun_.data() + waiting);
    bytes.remove_prefix(taken);
    if (waiting + taken < begun_.size()) return;
    add_block(begun_.data());
  }
  while (bytes.size() >= begun_.size()) {
    add_block(bytes.data());
    bytes.remove_prefix(begun_.size());
  }
  std::copy_n(bytes.data(), bytes.size(), begun_.data());
}

std::array<uint8_t, 32> Sha256::value() const {
  // section 5.1.1: a one bit, zeros, the length in bits
  Sha256 ended = *this;
  constexpr char padding[64] = {'\x80'};
  ended.add({padding, 1 + (119 - bytes_ % 64) % 64});
  char length[8];
  for (int k = 0; k < 8; ++k) length[k] = static_cast<char>(8 * bytes_ >> (56 - 8 * k));
  ended.add({length, 8});
  std::array<uint8_t, 32> digest;
  for (int k = 0; k < 32; ++k)
    digest[k] = static_cast<uint8_t>(ended.h_[k / 4] >> (24 - k % 4 * 8));
  return digest;
}

}  // namespace mvs::core
