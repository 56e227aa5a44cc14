// Instruments for C++17. Part of mvs/mvs.hpp.
#ifndef MVS_TOOL_HPP
#define MVS_TOOL_HPP

#include <mvs/tool.h>
#include <mvs/snapshot.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace mvs {

// Returns the tools of a snapshot in the order of their addition.
inline std::vector<mvs_tool_state> tools_of(const Snapshot &snapshot) {
  std::uint32_t count = 0;
  must(mvs_snapshot_get_tool_count(snapshot.get(), &count));
  std::vector<mvs_tool_state> found;
  for (std::uint32_t k = 0; k < count; ++k) {
    found.push_back(filled<mvs_tool_state>(mvs_snapshot_get_tool, snapshot.get(), k));
  }
  return found;
}

}  // namespace mvs

#endif
