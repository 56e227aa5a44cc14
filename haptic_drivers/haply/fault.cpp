#include "fault.h"

#include <cstdarg>
#include <cstdio>

namespace haply {

int32_t Fault::set(int32_t code, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(sentence, sizeof sentence, format, arguments);
  va_end(arguments);
  return code;
}

}  // namespace haply
