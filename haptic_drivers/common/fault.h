// Error code with a message, stored without allocation, for use at the device's rate.
#pragma once

#include <cstdarg>
#include <cstdio>

#include "common/interface.h"

namespace driver {

struct Fault {
  // Formats the message and returns `code`.
  [[gnu::format(printf, 3, 4)]] int32_t set(int32_t code, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(sentence, sizeof sentence, format, arguments);
    va_end(arguments);
    return code;
  }

  char sentence[400] = "";
};

// Throws a Refusal on failure; not for use at the device's rate.
inline void must(int32_t result, const Fault &fault) {
  if (result != MVS_DRIVER_OK) refuse(result, fault.sentence);
}

}  // namespace driver
