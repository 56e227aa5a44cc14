// Sized structs across the boundary: older and newer callers than this library.
#pragma once

#include <algorithm>
#include <cstring>
#include <string>

#include "api/exception_boundary.h"
#include "base/option_checks.h"

namespace mvs::core {

// No struct of this interface is larger; a size above it was never set.
inline constexpr uint32_t struct_size_limit = 4096;

// The struct_size of a struct, checked for sense.
inline uint32_t checked_struct_size(const void *given, const char *what) {
  must_point(given, what);
  uint32_t size = 0;
  std::memcpy(&size, given, sizeof size);
  MVS_MUST(size >= 8 && size <= struct_size_limit && size % 4 == 0, MVS_E_ARGUMENT, what,
           "%s.struct_size is %u: set it to sizeof the struct", what, size);
  return size;
}

// Reads an input struct. What an older caller does not have counts as zero; what a newer one has
// must be zero, since this library cannot honour it.
template <typename Struct>
Struct read_struct(const Struct *given, const char *what) {
  const uint32_t size = checked_struct_size(given, what);
  const char *bytes = reinterpret_cast<const char *>(given);
  for (size_t k = sizeof(Struct); k < size; ++k) {
    MVS_MUST(bytes[k] == 0, MVS_E_VERSION, what,
             "%s has a field at byte %zu that this version of libmvs does not know: update libmvs, "
             "or leave the field zero",
             what, k);
  }
  Struct known = {};
  std::memcpy(&known, bytes, std::min<size_t>(size, sizeof(Struct)));
  known.struct_size = sizeof(Struct);
  return known;
}

// The same where null means all defaults.
template <typename Struct>
Struct read_struct_or_default(const Struct *given, const char *what) {
  return given ? read_struct(given, what) : Struct{};
}

// Fills an output struct as far as the caller's reaches; what only a newer caller knows becomes 0.
// The caller's struct_size stays.
template <typename Struct>
void write_struct(Struct *to, const Struct &value, const char *what) {
  const uint32_t size = checked_struct_size(to, what);
  char *bytes = reinterpret_cast<char *>(to);
  const char *from = reinterpret_cast<const char *>(&value);
  const size_t common = std::min<size_t>(size, sizeof(Struct));
  std::memcpy(bytes + sizeof size, from + sizeof size, common - sizeof size);
  std::memset(bytes + common, 0, size - common);
}

// Reads element `index` of a caller's array whose elements are `stride` bytes apart, by the same
// rules: bytes beyond the caller's element count as zero, bytes beyond this library's must be zero.
template <typename Struct>
Struct read_element(const Struct *list, uint32_t index, uint32_t stride, const char *what) {
  MVS_MUST(stride >= 8 && stride <= struct_size_limit && stride % 4 == 0, MVS_E_ARGUMENT, what,
           "the stride of %s is %u: set it to sizeof its struct", what, stride);
  const char *bytes = reinterpret_cast<const char *>(list) + size_t{index} * stride;
  for (size_t k = sizeof(Struct); k < stride; ++k) {
    MVS_MUST(bytes[k] == 0, MVS_E_VERSION, what,
             "%s[%u] has a field at byte %zu that this version of libmvs does not know: update "
             "libmvs, or leave the field zero",
             what, index, k);
  }
  Struct known = {};
  std::memcpy(&known, bytes, std::min<size_t>(stride, sizeof(Struct)));
  return known;
}

// Fills element `index` of a caller's array whose elements are `stride` bytes apart.
template <typename Struct>
void write_element(Struct *list, uint64_t index, uint32_t stride, const Struct &value) {
  char *bytes = reinterpret_cast<char *>(list) + index * stride;
  const size_t common = std::min<size_t>(stride, sizeof(Struct));
  std::memcpy(bytes, &value, common);
  std::memset(bytes + common, 0, stride - common);
}

// Hands the bytes that make() gives to the caller's memory, as far as it reaches, and their true
// number to *size.
template <typename Make>
void write_bytes(void *data, uint64_t capacity, uint64_t *size, Make make) {
  must_point(size, "size");
  if (capacity > 0) must_point(data, "data");
  const std::string bytes = make();
  if (capacity > 0) std::memcpy(data, bytes.data(), std::min<uint64_t>(capacity, bytes.size()));
  *size = bytes.size();
}

}  // namespace mvs::core
