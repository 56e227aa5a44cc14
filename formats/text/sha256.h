// SHA-256 (FIPS 180-4): the checksum of files that another library parses.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace mvs::core {

class Sha256 {
 public:
  void add(std::string_view bytes);
  // Returns the digest of all added bytes.
  std::array<uint8_t, 32> value() const;

 private:
  void add_block(const char *block);

  std::array<uint32_t, 8> h_ = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<char, 64> begun_ = {};  // the incomplete last block
  uint64_t bytes_ = 0;               // added so far
};

}  // namespace mvs::core
