// printf into a string.
#pragma once
#include <cstdarg>
#include <cstdio>
#include <string>

namespace driver {

[[gnu::format(printf, 1, 2)]] inline std::string sentence(const char *format, ...) {
  char text[1024];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  return text;
}

}  // namespace driver
