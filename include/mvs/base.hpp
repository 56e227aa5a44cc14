// Basis of the C++ wrappers: failures as exceptions, structs with their size.
#ifndef MVS_BASE_HPP
#define MVS_BASE_HPP

#include <mvs/base.h>

#include <cstdint>
#include <stdexcept>
#include <string>

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

}  // namespace mvs

#endif
