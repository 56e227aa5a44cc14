// Which boundary loops are holes: by length, area, labels and the plane of the tissue around.
#include "patient/surface/holes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "model/sides.h"
#include "patient/findings.h"
#include "patient/surface/fill_hole.h"

namespace mvs::core {
namespace {

// A longer loop is a hole up to this share, 35 to 45 mm around, if it spans no more than a round
// one of 7 mm and lies in one leaflet: at most a tenth of its rim has the label of the other one,
// or, without labels, the tissue around lies in its plane. The mean cosine between both normals is
// 1 in a flat leaflet and 0.6 to 0.9 around ragged holes of label maps; the free edges of four
// valves have 0.0 to 0.46, as leaflets hang down from an orifice.
constexpr double long_hole_share = 0.4, hole_flatness = 0.55;
constexpr double other_leaflet = 0.1;
// m: a hole nearer to a rim may be a notch or an orifice behind a strand; two triangles.
constexpr double beside_rim = 2e-3;
constexpr double doubtful_hole = 0.5, wrong_hole = 0.2;  // confidence

// A boundary loop that may be a hole.
struct HoleSigns {
  bool is_small = false;   // its length alone says that it is a hole
  bool is_inside = false;  // of one leaflet, by its labels or by the plane of the tissue around
  double flatness = 0;     // 1: the tissue around lies in the plane of the loop; 0: stands on it
};

// Around a hole the tissue goes on in the plane of the hole. Around an orifice the leaflets hang
// down: it lies across them.
HoleSigns signs_of(const LeafletSheet &sheet, const std::vector<Side> &sides, const RimLoop &rim,
                   double longest) {
  HoleSigns signs;
  signs.is_small = rim.shape.length < hole_share * longest;
  std::vector<uint8_t> on_loop(sheet.x.size(), 0);
  for (const uint32_t i : rim.loop) on_loop[i] = 1;
  double length = 0, flat = 0, anterior = 0, posterior = 0;
  const Vec3 across = -rim.shape.area.normalized();  // the loop runs clockwise seen from a normal
  for_each_edge(sides, [&](size_t first, size_t last) {
    const auto [a, b] = sides[first].edge;
    if (last - first != 1 || on_loop[a] == 0 || on_loop[b] == 0) return;
    const uint32_t t = sides[first].triangle;
    const auto &[i, j, k] = sheet.triangles[t];
    const double side = (sheet.x[b] - sheet.x[a]).norm();
    length += side;
    flat +=
        side * across.dot((sheet.x[j] - sheet.x[i]).cross(sheet.x[k] - sheet.x[i]).normalized());
    if (sheet.label[t] == LeafletLabel::anterior) anterior += side;
    if (sheet.label[t] == LeafletLabel::posterior) posterior += side;
  });
  signs.flatness = length > 0 ? flat / length : 0;
  const double labelled = anterior + posterior;
  signs.is_inside = labelled > 0.5 * length
                        ? std::min(anterior, posterior) <= other_leaflet * labelled
                        : signs.flatness > hole_flatness;
  return signs;
}

// A longer loop is a hole if it is narrow and lies in one leaflet: networks lose stretches of the
// free edge and leave a strand of tissue below.
bool is_hole(const RimLoop &rim, const HoleSigns &signs, double longest) {
  if (signs.is_small) return true;
  return rim.shape.length < long_hole_share * longest && rim.shape.area.norm() < long_hole_area &&
         signs.is_inside;
}

// m, between a loop and the nearer of the two rims.
double way_to_rims(const LeafletSheet &sheet, const std::vector<RimLoop> &rims,
                   const RimLoop &hole) {
  double least2 = INFINITY;
  for (size_t k = 0; k < 2; ++k) {
    if (&rims[k] == &hole) continue;
    for (const uint32_t i : rims[k].loop) {
      for (const uint32_t j : hole.loop)
        least2 = std::min(least2, (sheet.x[i] - sheet.x[j]).squaredNorm());
    }
  }
  return std::sqrt(least2);
}

}  // namespace

void fill_holes(LeafletSheet &sheet, std::vector<RimLoop> &rims, FilledHoles &filled) {
  if (rims.size() < 2) return;
  const std::vector<Side> sides = sorted_sides(sheet.triangles);
  const double longest = rims[0].shape.length;
  for (size_t k = rims.size(); k-- > 1;) {
    const HoleSigns signs = signs_of(sheet, sides, rims[k], longest);
    if (k == 1 ? !signs.is_small : !is_hole(rims[k], signs, longest)) continue;
    const double away = way_to_rims(sheet, rims, rims[k]);
    filled.nearest = std::min(filled.nearest, away);
    if (!signs.is_small || away < beside_rim || !signs.is_inside) {
      ++filled.doubtful;
      filled.confidence = std::min(filled.confidence, signs.is_inside ? doubtful_hole : wrong_hole);
    }
    filled.triangles += fill_hole(sheet, rims[k].loop);
    filled.lengths.push_back(rims[k].shape.length);
    rims.erase(rims.begin() + static_cast<std::ptrdiff_t>(k));
  }
}

void report_holes(const FilledHoles &filled, Findings &findings) {
  if (filled.lengths.empty()) return;
  const double longest = *std::max_element(filled.lengths.begin(), filled.lengths.end());
  findings.push_back(
      {"filled_holes", FindingSource::guessed, filled.confidence,
       format("holes that were filled: %zu, the longest %.1f mm around, the nearest %.1f mm from a "
              "rim, with %zu triangles. Perforations are not told from gaps of a surface: a leak "
              "through one is neither in the leak nor in its interval. Long, beside a rim or not "
              "inside of one leaflet: %zu; if one is a notch or a second orifice, cut the strand "
              "of tissue beside it",
              filled.lengths.size(), longest * 1e3, filled.nearest * 1e3, filled.triangles,
              filled.doubtful),
       filled.lengths, "m"});
}

}  // namespace mvs::core
