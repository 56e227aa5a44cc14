// Heights at both commissures and the greatest of the anterior leaflet against normal anatomy.
#include "patient/tall_leaflets.h"

#include <algorithm>

#include "base/error.h"
#include "patient/findings.h"
#include "patient/leaflet_heights.h"
#include "patient/surface/rims.h"

namespace mvs::core {
namespace {

constexpr size_t samples = 120;  // of the annulus: about 1 mm apart
// m: a third more than the largest normal heights, 10 mm at a commissure and 25 mm at A2. Leaflets
// of Barlow's disease come near to them.
constexpr double tall_commissure = 13.3e-3, tall_anterior = 33e-3;

}  // namespace

void doubt_tall_leaflets(const SheetRims &rims, const SheetCoordinates &coordinates,
                         const LeafletArcs &arcs, Findings &findings) {
  Finding *annulus = find_finding(findings, "annulus");
  if (!annulus || annulus->source == FindingSource::given) return;
  const double length = coordinates.annulus_length;
  const std::vector<double> height = smoothed(height_profile(rims, coordinates, samples), 2);
  const double first = height[sample_at(arcs.from, length, samples)];
  const double last = height[sample_at(arcs.to, length, samples)];
  double anterior = 0;
  for (size_t k = 0; k < samples; ++k) {
    const double foot = (static_cast<double>(k) + 0.5) * length / samples;
    if (wrapped(foot - arcs.from, length) < arcs.to - arcs.from) {
      anterior = std::max(anterior, height[k]);
    }
  }
  const double scale = std::min(1.0, length / whole_annulus);
  if (std::min(first, last) < scale * tall_commissure && anterior < scale * tall_anterior) return;
  annulus->confidence *= 0.5;
  findings.push_back(
      {"tall_leaflets",
       FindingSource::guessed,
       0.5,
       format("the leaflets are %.0f and %.0f mm high at the commissures and up to %.0f mm in the "
              "anterior leaflet, normal ones 8 to 10 and 22 to 25 mm: is wall of the atrium or the "
              "aorta part of the surface? Here it counts as leaflet; give six points or more all "
              "around the annulus, along which it is cut off",
              first * 1e3, last * 1e3, anterior * 1e3),
       {first, last, anterior},
       "m"});
}

}  // namespace mvs::core
