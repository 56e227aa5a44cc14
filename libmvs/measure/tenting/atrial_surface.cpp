// Raster of the leaflets seen from the atrium; gaps are filled from around them, and the whole is
// closed morphologically by a ball of the contact thickness.
#include "measure/tenting/atrial_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "measure/annulus/landmarks.h"
#include "measure/tenting/fill_gaps.h"
#include "measure/tenting/rolling_ball.h"
#include "measure/tenting/upper_envelope.h"

namespace mvs::core {
namespace {

// Gaps below this share of a cell are rounding of its covered length.
constexpr double rounding = 1e-9;
// Tissue deeper than this below the rest of a cell, over the contact thickness, does not count as
// deeper: a ball that rests on the rest of the cell does not reach it.
constexpr double most_of_thickness = 0.25;

// The mean height of each cell: of the tissue seen there, and in gaps of the tissue around them.
std::vector<double> mean_heights(const AnnulusMap &map, VisibleTissue seen) {
  const double nothing = -std::numeric_limits<double>::infinity();
  bool has_tissue = false;
  std::vector<uint32_t> gaps;
  for (uint32_t c = 0; c < seen.covered.size(); ++c) {
    has_tissue |= seen.covered[c] > 0;
    if (map.share(c) - seen.covered[c] > rounding) gaps.push_back(c);
  }
  if (!has_tissue) return std::vector<double>(seen.covered.size(), nothing);
  if (!gaps.empty()) {
    // on the rim, the weight of a cell is the covered share of its part inside
    for (const uint32_t c : gaps) seen.covered[c] /= map.share(c);
    fill_gaps(seen.covered, AnnulusMap::across, gaps, seen.height);
  }
  return std::move(seen.height);
}

// Heights of the nodes of the sheet above the surface that spans the annulus.
std::vector<double> node_rises(const Model &model, const std::vector<Vec3> &local,
                               const AnnulusSurface &surface) {
  std::vector<double> rises(local.size(), std::numeric_limits<double>::quiet_NaN());
  size_t near = 0;
  const Rows &sheet = model.topology.node_triangles;
  for (size_t node = 0; node < rises.size(); ++node) {
    if (sheet.start[node] == sheet.start[node + 1]) continue;
    const Vec3 &p = local[node];
    rises[node] = p[2] - surface.height(p[0], p[1], near);
  }
  return rises;
}

}  // namespace

AtrialSurface atrial_surface(const Model &model, const std::vector<Vec3> &x) {
  AtrialSurface surface;
  surface.frame = valve_frame(model, x);
  surface.local = surface.frame.local(x);
  surface.map = annulus_map(surface.frame, Loop(model.valve.annulus, x).points());
  const AnnulusMap &map = *surface.map;
  const double radius = 0.5 * model.valve.contact_thickness;
  const double most = most_of_thickness * model.valve.contact_thickness;
  surface.heights =
      mean_heights(map, visible_tissue(map, model.valve.triangles, surface.local, most));
  surface.heights = roll_ball(map, roll_ball(map, surface.heights, radius, 1), radius, -1);
  surface.node_rise = node_rises(model, surface.local, map.surface());
  return surface;
}

}  // namespace mvs::core
