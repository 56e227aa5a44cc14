// Run-time search of a vendor's library.
#pragma once
#include <string>
#include <vector>

namespace driver {

struct Library {
  void *handle =
      nullptr;         // null: not loaded; never closed, because some libraries do not support it
  std::string path;    // of the loaded library, or of the best candidate
  std::string why;     // the error message of dlopen
  bool there = false;  // the file exists, even if a library that it needs does not
};

// Loads the first possible candidate: absolute paths, or names without a folder, which the system
// searches. Other candidates are skipped, so that no library comes from the working directory.
Library load(const std::vector<std::string> &candidates);

// Returns the value of an environment variable with `below` appended; empty if it is not an
// absolute path, or if the program runs with elevated privileges.
std::string below_variable(const char *variable, const char *below);

// Looks up `name` in a library. If it is not exported, returns false and adds it to `missing`.
template <class Function>
bool bind(void *library, const char *name, Function &function, std::string &missing);
void *symbol(void *library, const char *name);

template <class Function>
bool bind(void *library, const char *name, Function &function, std::string &missing) {
  function = reinterpret_cast<Function>(symbol(library, name));
  if (!function) missing += (missing.empty() ? "" : ", ") + std::string(name);
  return function != nullptr;
}

}  // namespace driver
