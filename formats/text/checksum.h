// The checksum of files: the 128-bit hash of base/hash.h as hexadecimal digits. FORMAT.md defines
// it.
#pragma once

#include <string>
#include <string_view>

#include "base/error.h"
#include "base/hash.h"

namespace mvs::core {

// Returns 32 hexadecimal digits.
inline std::string hash_digits(const std::array<uint64_t, 2> &hash) {
  return format("%016llx%016llx", static_cast<unsigned long long>(hash[0]),
                static_cast<unsigned long long>(hash[1]));
}

inline std::string checksum_digits(std::string_view bytes) {
  Hash hash;
  hash.add(bytes);
  return hash_digits(hash.value());
}

}  // namespace mvs::core
