// List of existing names for the error sentence about an unknown name.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace mvs::core {

// Returns "; near: A2/7, A2/17", the at most eight existing names nearest to the unknown one, or
// "; there are A, P" where a dozen names or fewer exist or none is near.
std::string near_names(std::string_view unknown, const std::vector<std::string_view> &existing);

template <typename Parts>
std::string near_names(std::string_view unknown, const Parts &parts) {
  std::vector<std::string_view> existing;
  for (const auto &part : parts) existing.emplace_back(part.name);
  return near_names(unknown, existing);
}

}  // namespace mvs::core
