// dlopen and dlsym with checks of the path.
#include "common/library.h"

#include <dlfcn.h>
#include <unistd.h>

#include <cstdlib>

namespace driver {
namespace {

bool is_absolute(const std::string &path) {
  return !path.empty() && path.front() == '/';
}

// A relative path with a folder would be searched in the working directory.
bool is_safe(const std::string &candidate) {
  return is_absolute(candidate) || (!candidate.empty() && candidate.find('/') == std::string::npos);
}

// The message of dlerror begins with the file that failed: the candidate, or a library that it
// needs.
bool is_there(const std::string &candidate, const std::string &why) {
  if (is_absolute(candidate)) return access(candidate.c_str(), F_OK) == 0;
  return why.compare(0, candidate.size() + 1, candidate + ":") != 0;
}

}  // namespace

Library load(const std::vector<std::string> &candidates) {
  Library best;
  for (const std::string &candidate : candidates) {
    if (!is_safe(candidate)) continue;
    Library one;
    one.path = candidate;
    one.handle = dlopen(candidate.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (one.handle) {
      one.there = true;
      return one;
    }
    const char *const why = dlerror();
    one.why = why ? why : "the system does not say why";
    one.there = is_there(candidate, one.why);
    if (best.path.empty() || (one.there && !best.there)) best = one;
  }
  return best;
}

std::string below_variable(const char *variable, const char *below) {
#if defined(__GLIBC__)
  const char *const folder = secure_getenv(variable);
#else
  const char *const folder = std::getenv(variable);
#endif
  return folder && is_absolute(folder) ? std::string(folder) + below : std::string();
}

void *symbol(void *library, const char *name) {
  return dlsym(library, name);
}

}  // namespace driver
