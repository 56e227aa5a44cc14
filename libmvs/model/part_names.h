// What a sentence says of a name that no part has: the names that there are.
#pragma once

#include <string>

namespace mvs::core {

// "; there are A, P", or the first dozen of more.
template <typename Parts>
std::string names_there(const Parts &parts) {
  constexpr size_t most = 12;
  std::string list = parts.empty() ? "; there are none" : "; there are ";
  for (size_t k = 0; k < parts.size() && k < most; ++k) {
    list += (k == 0 ? "" : ", ") + parts[k].name;
  }
  return list + (parts.size() > most ? ", ..." : "");
}

}  // namespace mvs::core
