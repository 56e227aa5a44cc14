// Sized structs and strided arrays of the C interface: reads and writes structs of callers that
// were compiled with older or newer headers than this library.
#pragma once

#include <algorithm>
#include <cstring>
#include <string>

#include "api/exception_boundary.h"
#include "base/option_checks.h"

namespace mvs::core {

// Bytes. No struct is larger: a size above it is uninitialised memory.
inline constexpr uint32_t struct_size_limit = 4096;

// Returns the struct_size of a struct; throws MVS_E_ARGUMENT if no struct can have this size.
inline uint32_t checked_struct_size(const void *given, const char *what) {
  must_point(given, what);
  uint32_t size = 0;
  std::memcpy(&size, given, sizeof size);
  MVS_MUST(size >= 8 && size <= struct_size_limit && size % 4 == 0, MVS_E_ARGUMENT, what,
           "%s.struct_size is %u: set it to sizeof the struct", what, size);
  return size;
}

// Reads an input struct. Fields that an older caller lacks are zero. Fields that only a newer
// caller has must be zero, because this library does not implement them.
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

// The same; a null pointer selects all defaults.
template <typename Struct>
Struct read_struct_or_default(const Struct *given, const char *what) {
  return given ? read_struct(given, what) : Struct{};
}

// Writes an output struct up to the caller's size. Fields that only a newer caller has become 0.
// The caller's struct_size is kept.
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

// Writes element `index` of a caller's array whose elements are `stride` bytes apart.
template <typename Struct>
void write_element(Struct *list, uint64_t index, uint32_t stride, const Struct &value) {
  char *bytes = reinterpret_cast<char *>(list) + index * stride;
  const size_t common = std::min<size_t>(stride, sizeof(Struct));
  std::memcpy(bytes, &value, common);
  std::memset(bytes + common, 0, stride - common);
}

// Copies the bytes that make() returns to the caller's memory, up to its capacity, and sets *size
// to their full number.
template <typename Make>
void write_bytes(void *data, uint64_t capacity, uint64_t *size, Make make) {
  must_point(size, "size");
  if (capacity > 0) must_point(data, "data");
  const std::string bytes = make();
  if (capacity > 0) std::memcpy(data, bytes.data(), std::min<uint64_t>(capacity, bytes.size()));
  *size = bytes.size();
}

}  // namespace mvs::core
