// Raster of the leaflets seen from the atrium; gaps are filled from around them, and the whole is
// closed morphologically by a ball of the contact thickness. The deepest cells are where balls are
// rolled down the leaflets themselves.
#include "measure/tenting/atrial_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "measure/annulus/landmarks.h"
#include "measure/tenting/fill_gaps.h"
#include "measure/tenting/resting_balls.h"
#include "measure/tenting/rolling_ball.h"
#include "measure/tenting/upper_envelope.h"
#include "measure/tissue/sheet_topology.h"

namespace mvs::core {
namespace {

// Gaps below this share of a cell are rounding of its covered length.
constexpr double rounding = 1e-9;
// Tissue deeper than this below the rest of a cell, over the contact thickness, does not count as
// deeper: a ball that rests on the rest of the cell does not reach it.
constexpr double most_of_thickness = 0.25;

// The mean height of each cell: of the tissue seen there, and in gaps of the tissue around them.
// Takes the heights; of cells on the rim, `covered` becomes the share of the part inside.
std::vector<double> mean_heights(const AnnulusMap &map, VisibleTissue &seen) {
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

// Balls start in the lowest cells of squares of so many cells, as far as these are at most so much
// higher than the lowest cell of all: the raster can be wrong by 0.4 mm in a steep crevice.
constexpr size_t cells_of_square = 8;
constexpr double above_lowest = 0.5e-3;
static_assert(AnnulusMap::across % cells_of_square == 0);

// The centres of a ball on the raster from which balls roll down, the lowest first.
std::vector<Vec3> starts_of_balls(const AnnulusMap &map, const std::vector<double> &centres) {
  constexpr size_t squares = AnnulusMap::across / cells_of_square;
  std::vector<Vec3> starts;
  for (size_t band = 0; band < squares; ++band) {
    std::array<Vec3, squares> lowest;
    lowest.fill(Vec3(0, 0, std::numeric_limits<double>::infinity()));
    for (size_t row = band * cells_of_square; row < (band + 1) * cells_of_square; ++row) {
      for (size_t column = map.first_inside(row); column < map.end_inside(row); ++column) {
        const size_t cell = row * AnnulusMap::across + column;
        Vec3 &found = lowest[column / cells_of_square];
        if (!(centres[cell] < found[2]) || map.share(cell) < 1) continue;
        found = {map.u()[column], map.v()[row], centres[cell]};
      }
    }
    for (const Vec3 &found : lowest) {
      if (std::isfinite(found[2])) starts.push_back(found);
    }
  }
  std::stable_sort(starts.begin(), starts.end(),
                   [](const Vec3 &a, const Vec3 &b) { return a[2] < b[2]; });
  const auto is_too_high = [&](const Vec3 &start) {
    return start[2] > starts.front()[2] + above_lowest;
  };
  starts.erase(std::find_if(starts.begin(), starts.end(), is_too_high), starts.end());
  return starts;
}

// Whether the cell of a place is inside the annulus and no tissue is seen in it.
bool is_open(const AnnulusMap &map, const std::vector<double> &covered, const Vec3 &place) {
  const double column = std::floor((place[0] - map.low_u()) / map.width());
  const double row = std::floor((place[1] - map.low_v()) / map.depth());
  if (!(column >= 0 && column < AnnulusMap::across && row >= 0 && row < AnnulusMap::across)) {
    return false;
  }
  const size_t cell = AnnulusMap::at(static_cast<int>(column), static_cast<int>(row));
  return map.share(cell) == 1 && covered[cell] == 0;
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
  VisibleTissue seen = visible_tissue(map, model.valve.triangles, surface.local, most);
  surface.heights = mean_heights(map, seen);
  const std::vector<double> centres = roll_ball(map, surface.heights, radius, 1);
  surface.heights = roll_ball(map, centres, radius, -1);
  const TriangleBvh tree(model.valve.triangles, surface.local, *sheet_topology(model));
  const std::vector<Vec3> rim = Loop(model.valve.annulus, surface.local).points();
  surface.lows =
      lows_of_ball({tree, surface.local, model.topology.free_edges, rim,
                    [&](const Vec3 &place) { return is_open(map, seen.covered, place); }},
                   starts_of_balls(map, centres), radius);
  surface.node_rise = node_rises(model, surface.local, map.surface());
  return surface;
}

}  // namespace mvs::core
