// Why a function failed: a code of mvs/driver.h and the sentence for it, kept without allocating.
#pragma once

#include <mvs/driver.h>

namespace haply {

struct Fault {
  // Returns `code`.
  __attribute__((format(printf, 3, 4))) int32_t set(int32_t code, const char *format, ...);

  char sentence[400] = "";
};

}  // namespace haply
