// Checks that the annulus is a closed loop of boundary edges of the sheet.
#include <algorithm>

#include "model/checks/checks.h"

namespace mvs::core {
namespace {

// Returns the number of triangles at the edge between two nodes.
size_t triangles_at(const Sheet &sheet, uint32_t a, uint32_t b) {
  const Edge edge = {std::min(a, b), std::max(a, b)};
  const auto before = [](const Side &side, const Edge &e) { return side.edge < e; };
  auto side = std::lower_bound(sheet.sides.begin(), sheet.sides.end(), edge, before);
  size_t count = 0;
  for (; side != sheet.sides.end() && side->edge == edge; ++side) ++count;
  return count;
}

void check_annulus_nodes(const Valve &valve, const Sheet &sheet, Faults &faults) {
  std::vector<uint8_t> seen(valve.rest.size(), 0);
  for (const uint32_t node : valve.annulus) {
    if (!sheet.is_vertex[node]) {
      faults.add(format("node %u", node), "annulus node %u is no corner of a triangle", node);
    }
    if (seen[node]++ == 1) {
      faults.add(
          format("node %u", node),
          "annulus node %u appears more than once: the loop is closed implicitly, do not repeat "
          "its first node",
          node);
    }
  }
}

}  // namespace

void check_annulus(const Valve &valve, const Sheet &sheet, Faults &faults) {
  const size_t before = faults.list.size();
  const size_t k = valve.annulus.size();
  if (k < 3) {
    faults.add("annulus", "the annulus has %zu nodes: a loop has at least 3", k);
  }
  check_annulus_nodes(valve, sheet, faults);
  if (faults.list.size() > before) return;
  for (size_t i = 0; i < k; ++i) {
    const uint32_t a = valve.annulus[i], b = valve.annulus[(i + 1) % k];
    const std::string part = format("annulus %u-%u", a, b);
    const size_t count = triangles_at(sheet, a, b);
    if (count == 0) {
      faults.add(part,
                 "annulus nodes %u and %u follow each other but no edge joins them: list the nodes "
                 "of the loop in order, leaflets joined along it",
                 a, b);
    } else if (count > 1) {
      faults.add(part,
                 "the annulus runs through the sheet between nodes %u and %u: it has to follow "
                 "the boundary",
                 a, b);
    }
  }
}

}  // namespace mvs::core
