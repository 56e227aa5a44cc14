// Least-area fillings of the holes of a skin.
#include "patient/skin/skin_holes.h"

#include <algorithm>

#include "base/error.h"
#include "model/sides.h"
#include "patient/findings.h"
#include "patient/surface/boundary.h"
#include "patient/surface/fill_hole.h"

namespace mvs::core {
namespace {

// m, around: a hole of 6 mm. A longer boundary may be an orifice, a rim, or a side that is missing.
constexpr double longest_skin_hole = 20e-3;

}  // namespace

void fill_skin_holes(LeafletSheet &sheet, Findings &findings) {
  const std::vector<std::vector<uint32_t>> loops = boundary_loops(sheet);
  double longest = 0, sum = 0;
  for (const std::vector<uint32_t> &loop : loops) {
    const double length = shape_of(sheet, loop).length;
    longest = std::max(longest, length);
    sum += length;
  }
  if (loops.empty() || longest * longest >= surface_area(sheet.x, sheet.triangles)) return;
  MVS_MUST(longest <= longest_skin_hole, MVS_E_OP, "kind",
           "the surface is a skin with a hole of %.0f mm around, at most %.0f mm are filled: close "
           "it, or give the mid-surface or the atrial side of the leaflets",
           longest * 1e3, longest_skin_hole * 1e3);
  size_t triangles = 0;
  for (const std::vector<uint32_t> &loop : loops) triangles += fill_hole(sheet, loop);
  findings.push_back({"skin_holes",
                      FindingSource::guessed,
                      0.8,
                      format("%zu holes of the skin, the longest %.1f mm around, were filled with "
                             "%zu triangles",
                             loops.size(), longest * 1e3, triangles),
                      {longest, sum},
                      "m"});
}

}  // namespace mvs::core
