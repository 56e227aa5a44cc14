// List of existing names for the error sentence about an unknown name.
#pragma once

#include <string>

namespace mvs::core {

// Returns "; there are A, P", at most a dozen names.
template <typename Parts>
std::string existing_names(const Parts &parts) {
  constexpr size_t most = 12;
  std::string list = parts.empty() ? "; there is no such part" : "; there are ";
  for (size_t k = 0; k < parts.size() && k < most; ++k) {
    list += (k == 0 ? "" : ", ") + parts[k].name;
  }
  return list + (parts.size() > most ? ", ..." : "");
}

}  // namespace mvs::core
