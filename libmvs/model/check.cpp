// Is this a valve? The faults, from the coarse (sizes) to the fine (materials).
#include "model/check.h"

#include "base/error.h"

namespace mvs {
namespace {

using Faults = std::vector<Fault>;

void check_indices(const Valve &valve, Faults &faults) {
  const size_t n = valve.rest.size();
  for (size_t t = 0; t < valve.triangles.size(); ++t) {
    for (const uint32_t node : valve.triangles[t]) {
      if (node < n) continue;
      faults.push_back({format("triangle %zu", t),
                        format("triangle %zu names node %u, but there are %zu nodes: indices "
                               "start at 0",
                               t, node, n)});
    }
  }
}

}  // namespace

std::vector<Fault> find_faults(const Valve &valve) {
  Faults faults;
  check_indices(valve, faults);
  return faults;
}

}  // namespace mvs
