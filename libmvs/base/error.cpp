// Formatting of error sentences.
#include "base/error.h"

#include <cstdarg>
#include <cstdio>

#include "base/classic_locale.h"
#include "base/utf8.h"

namespace mvs::core {

std::string vformat(const char *pattern, va_list arguments) {
  const ClassicLocale numbers_with_points;
  char text[sizeof(mvs_error::message)];
  std::vsnprintf(text, sizeof text, pattern, arguments);
  return only_utf8(text);
}

std::string format(const char *pattern, ...) {
  va_list arguments;
  va_start(arguments, pattern);
  std::string text = vformat(pattern, arguments);
  va_end(arguments);
  return text;
}

void fail(mvs_result code, const std::string &part, const char *pattern, ...) {
  va_list arguments;
  va_start(arguments, pattern);
  const std::string text = vformat(pattern, arguments);
  va_end(arguments);
  throw Error(code, part, text);
}

}  // namespace mvs::core
