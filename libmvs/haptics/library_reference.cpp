// Reference to the own library, found by the address of one of its functions.
#include "haptics/library_reference.h"

#include <dlfcn.h>

namespace mvs::core {

void *hold_library() noexcept {
  Dl_info found = {};
  if (!dladdr(reinterpret_cast<const void *>(&hold_library), &found) || !found.dli_fname) {
    return nullptr;
  }
  void *const reference = dlopen(found.dli_fname, RTLD_NOW | RTLD_NOLOAD);
  if (!reference) dlerror();  // a message that the host would read as one of its own calls
  return reference;
}

void release_library(void *reference) noexcept {
  if (reference) dlclose(reference);
}

}  // namespace mvs::core
