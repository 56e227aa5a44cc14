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

// Balls start in the lowest cells of squares of so many cells.
constexpr size_t cells_of_square = 8;
static_assert(AnnulusMap::across % cells_of_square == 0);

// The lowest centres of a ball on the raster, one in each square; infinite in squares without
// tissue. Cells without tissue do not count: a ball falls there, or rests on the tissue beside
// them.
struct LowestOfSquares {
  static constexpr size_t across = AnnulusMap::across / cells_of_square;
  std::array<Vec3, across * across> centre;

  LowestOfSquares(const AnnulusMap &map, const std::vector<double> &covered,
                  const std::vector<double> &centres) {
    centre.fill(Vec3(0, 0, std::numeric_limits<double>::infinity()));
    for (size_t row = 0; row < AnnulusMap::across; ++row) {
      for (size_t column = map.first_inside(row); column < map.end_inside(row); ++column) {
        const size_t cell = row * AnnulusMap::across + column;
        Vec3 &found = centre[row / cells_of_square * across + column / cells_of_square];
        if (!(centres[cell] < found[2]) || map.share(cell) < 1 || covered[cell] == 0) continue;
        found = {map.u()[column], map.v()[row], centres[cell]};
      }
    }
  }
  bool is_lowest_around(size_t square) const {
    const size_t row = square / across, column = square % across;
    for (size_t r = row > 0 ? row - 1 : 0; r <= std::min(row + 1, across - 1); ++r) {
      for (size_t c = column > 0 ? column - 1 : 0; c <= std::min(column + 1, across - 1); ++c) {
        if (centre[r * across + c][2] < centre[square][2]) return false;
      }
    }
    return true;
  }
};

// The centres from which balls roll down, of each square the lowest.
BallStarts starts_of_balls(const AnnulusMap &map, const std::vector<double> &covered,
                           const std::vector<double> &centres) {
  const LowestOfSquares squares(map, covered, centres);
  BallStarts starts;
  for (size_t k = 0; k < squares.centre.size(); ++k) {
    if (!std::isfinite(squares.centre[k][2])) continue;
    (squares.is_lowest_around(k) ? starts.lowest : starts.others).push_back(squares.centre[k]);
  }
  return starts;
}

// False where a cell inside the annulus is all below tissue that is higher than a place: then a
// ball, if it is larger than the cell, cannot be let down there.
bool is_open(const AnnulusMap &map, const std::vector<double> &covered,
             const std::vector<double> &heights, const Vec3 &place) {
  const double column = std::floor((place[0] - map.low_u()) / map.width());
  const double row = std::floor((place[1] - map.low_v()) / map.depth());
  if (!(column >= 0 && column < AnnulusMap::across && row >= 0 && row < AnnulusMap::across)) {
    return false;
  }
  const size_t cell = AnnulusMap::at(static_cast<int>(column), static_cast<int>(row));
  return map.share(cell) == 1 && (1 - covered[cell] > rounding || heights[cell] < place[2]);
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
  const std::vector<double> means = mean_heights(map, seen);
  const std::vector<double> centres = roll_ball(map, means, radius, 1);
  surface.heights = roll_ball(map, centres, radius, -1);
  const TriangleBvh tree(model.valve.triangles, surface.local, *sheet_topology(model));
  const std::vector<Vec3> rim = Loop(model.valve.annulus, surface.local).points();
  Aabb box;
  for (const Tri &t : model.valve.triangles) box.add(aabb_of(surface.local, t));
  const auto may_pass = [&](const Vec3 &place) { return is_open(map, seen.covered, means, place); };
  surface.lows = lows_of_ball({tree, surface.local, model.topology.free_edges, rim, box, may_pass},
                              starts_of_balls(map, seen.covered, centres), radius);
  surface.node_rise = node_rises(model, surface.local, map.surface());
  return surface;
}

}  // namespace mvs::core
