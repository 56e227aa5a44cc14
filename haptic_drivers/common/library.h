// Finds a vendor's library at run time, and says why not.
#pragma once
#include <string>
#include <vector>

namespace driver {

struct Library {
  void *handle = nullptr;  // null: nothing was loaded; never closed, some do not bear it
  std::string path;        // what was loaded, or what was there and did not load
  std::string why;         // what the system said to that
  bool there = false;      // a file is there, even if something that it needs is not
};

// The first of the candidates that loads: absolute paths, or names without a folder, which the
// system looks up. Others are passed over, so that nothing comes from the working directory.
Library load(const std::vector<std::string> &candidates);

// What an environment variable names, with `below` after it; empty if it is no absolute path, or
// if the program runs with more rights than its user has.
std::string below_variable(const char *variable, const char *below);

// Looks `name` up in a library: false, and adds it to `missing`, if it is not exported.
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
