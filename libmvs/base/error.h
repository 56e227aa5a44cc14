// Exceptions of the core: MVS_MUST throws an Error, which only the C interface (api/) catches.
#pragma once

#include <mvs/base.h>

#include <cstdarg>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace mvs::core {

// A failure with all fields of mvs_last_error().
class Error : public std::runtime_error {
 public:
  Error(mvs_result code_in, std::string part_in, const std::string &message, int32_t line_in = 0)
      : std::runtime_error(message), code(code_in), line(line_in), part(std::move(part_in)) {}

  mvs_result code;
  int32_t line;
  std::string part;
};

// Formats like printf into a string.
[[gnu::format(printf, 1, 2)]] std::string format(const char *pattern, ...);
[[gnu::format(printf, 1, 0)]] std::string vformat(const char *pattern, va_list arguments);

// Throws an Error of `code` about `part` ("" if there is no part) with a printf-style sentence.
[[noreturn, gnu::format(printf, 3, 4)]] void fail(mvs_result code, const std::string &part,
                                                  const char *pattern, ...);

}  // namespace mvs::core

// Throws unless `condition` holds; the sentence names the part and what to do.
#define MVS_MUST(condition, code, part, ...)                      \
  do {                                                            \
    if (!(condition)) ::mvs::core::fail(code, part, __VA_ARGS__); \
  } while (false)
