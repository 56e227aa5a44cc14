// Sized structs and strided arrays of the C interface: reads and writes structs of callers that
// were compiled with older or newer headers than this library.
#pragma once

#include <mvs/sim.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "api/exception_boundary.h"
#include "base/array_view.h"
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

// Copies a caller's struct of `size` bytes. Fields that an older caller lacks are zero. Fields that
// only a newer caller has must be zero, because this library does not implement them. `element`:
// the index in a list, for the message; negative for a struct by itself.
template <typename Struct>
Struct copy_known(const void *given, uint32_t size, const char *what, int64_t element = -1) {
  const char *bytes = static_cast<const char *>(given);
  for (size_t k = sizeof(Struct); k < size; ++k) {
    MVS_MUST(bytes[k] == 0, MVS_E_VERSION, what,
             "%s%s has a field at byte %zu that this version of libmvs does not know: update "
             "libmvs, or leave the field zero",
             what, element < 0 ? "" : format("[%lld]", static_cast<long long>(element)).c_str(), k);
  }
  Struct known = {};
  std::memcpy(&known, bytes, std::min<size_t>(size, sizeof(Struct)));
  return known;
}

// Reads an input struct.
template <typename Struct>
Struct read_struct(const Struct *given, const char *what) {
  Struct known = copy_known<Struct>(given, checked_struct_size(given, what), what);
  known.struct_size = sizeof(Struct);
  return known;
}

// The same; a null pointer selects all defaults.
template <typename Struct>
Struct read_struct_or_default(const Struct *given, const char *what) {
  return given ? read_struct(given, what) : Struct{};
}

// Writes element `index` of a caller's array whose elements are `stride` bytes apart, up to the
// stride. Fields that only a newer caller has become 0.
template <typename Struct>
void write_element(Struct *list, uint64_t index, uint32_t stride, const Struct &value) {
  char *bytes = reinterpret_cast<char *>(list) + index * stride;
  const size_t common = std::min<size_t>(stride, sizeof(Struct));
  std::memcpy(bytes, &value, common);
  std::memset(bytes + common, 0, stride - common);
}

// Writes an output struct in the same way. The caller's struct_size is kept.
template <typename Struct>
void write_struct(Struct *to, Struct value, const char *what) {
  value.struct_size = checked_struct_size(to, what);
  write_element(to, 0, value.struct_size, value);
}

// Returns read(element) of each of `count` elements of a caller's list that are `stride` bytes
// apart.
template <typename Struct, typename Part>
std::vector<Part> read_list(const Struct *list, uint32_t count, uint32_t stride, const char *what,
                            Part (*read)(const Struct &)) {
  check_list(list, count, what);
  MVS_MUST(count == 0 || (stride >= 8 && stride <= struct_size_limit && stride % 4 == 0),
           MVS_E_ARGUMENT, what, "the stride of %s is %u: set it to sizeof its struct", what,
           stride);
  const char *bytes = reinterpret_cast<const char *>(list);
  std::vector<Part> parts;
  for (uint32_t k = 0; k < count; ++k, bytes += stride) {
    parts.push_back(read(copy_known<Struct>(bytes, stride, what, k)));
  }
  return parts;
}

// Checks an MVS_BACKEND_*.
inline void must_be_backend(mvs_backend backend, const char *what) {
  MVS_MUST(backend <= MVS_BACKEND_BLOCK, MVS_E_ARGUMENT, what,
           "%s is %u: it has to be one of MVS_BACKEND_*", what, backend);
}

// The bytes that a caller gives; throws MVS_E_ARGUMENT where none can be as long (32 bits).
inline std::string_view read_bytes(const void *data, uint64_t size) {
  must_point(data, "data");
  MVS_MUST(static_cast<size_t>(size) == size, MVS_E_ARGUMENT, "size",
           "size is %llu: no memory is as long", static_cast<unsigned long long>(size));
  return {static_cast<const char *>(data), static_cast<size_t>(size)};
}

// Copies the bytes that make() returns to the caller's memory, up to its capacity, and sets *size
// to their full number.
template <typename Make>
void write_bytes(void *data, uint64_t capacity, uint64_t *size, Make make) {
  must_point(size, "size");
  if (capacity > 0) must_point(data, "data");
  const std::string bytes = make();
  if (capacity > 0)
    std::memcpy(data, bytes.data(),
                static_cast<size_t>(std::min<uint64_t>(capacity, bytes.size())));
  *size = bytes.size();
}

}  // namespace mvs::core
