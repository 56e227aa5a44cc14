// Basis of the C++ wrappers: failures as exceptions, structs with their size.
#ifndef MVS_BASE_HPP
#define MVS_BASE_HPP

#include <mvs/base.h>

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

namespace mvs {

// A failed call: what() is the sentence of mvs_last_error().
class Error : public std::runtime_error {
 public:
  explicit Error(const mvs_error &error)
      : std::runtime_error(error.message),
        code_(error.code),
        line_(error.line),
        part_(error.part) {}

  mvs_result code() const noexcept { return code_; }
  std::int32_t line() const noexcept { return line_; }
  const std::string &part() const noexcept { return part_; }

 private:
  mvs_result code_;
  std::int32_t line_;
  std::string part_;
};

// Throws the last failure of this thread unless `result` is MVS_OK.
inline void must(mvs_result result) {
  if (result != MVS_OK) throw Error(*mvs_last_error());
}

// Returns a zeroed struct of the C interface with its struct_size.
template <typename Struct>
Struct sized() {
  Struct made = {};
  made.struct_size = sizeof(Struct);
  return made;
}

// Returns the struct that a call of the C interface fills: its last parameter, after `arguments`.
template <typename Struct, typename Get, typename... Arguments>
Struct filled(Get get, Arguments... arguments) {
  Struct made = sized<Struct>();
  must(get(arguments..., &made));
  return made;
}

// Returns the described fields of a struct of results, MVS_STRUCT_*.
inline std::vector<mvs_field_info> fields_of(mvs_struct which) {
  std::vector<mvs_field_info> fields;
  for (std::uint32_t k = 0; k < mvs_get_field_count(which); ++k) {
    fields.push_back(filled<mvs_field_info>(mvs_get_field, which, k));
  }
  return fields;
}

// Reads a field of a struct of results; counts are converted.
inline double field_value(const void *from, const mvs_field_info &field) {
  const char *at = static_cast<const char *>(from) + field.offset;
  if (field.type == MVS_FIELD_COUNT) {
    std::uint32_t count = 0;
    std::memcpy(&count, at, sizeof count);
    return count;
  }
  double number = 0;
  std::memcpy(&number, at, sizeof number);
  return number;
}

}  // namespace mvs

#endif
