// Heights at both commissures and the greatest of the anterior leaflet against normal anatomy.
#include "patient/tall_leaflets.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "geometry/distance.h"
#include "patient/findings.h"
#include "patient/leaflet_heights.h"
#include "patient/surface/rims.h"

namespace mvs::core {
namespace {

constexpr size_t samples = 120;  // of the annulus: about 1 mm apart
// m: a third more than the largest normal heights, 10 mm at a commissure and 25 mm at A2. Leaflets
// of Barlow's disease come near to them.
constexpr double tall_commissure = 13.3e-3, tall_anterior = 33e-3;
// Samples on either side of a commissure, 9 mm, of which the lowest counts: leaflets that touch
// beside it, or are fused there, are one high leaflet at the commissure itself. Wall of the atrium
// is as high on both sides.
constexpr size_t beside = 9;
// Leaflets in an image are fused where they are nearer to each other than they are thick. They part
// by 30 degrees and more, so that they are higher by up to twice what they are thicker than usual.
constexpr double usual_thickness = 1e-3, fused = 2;

double lowest_beside(const std::vector<double> &height, size_t at) {
  double least = height[at];
  for (size_t k = 0; k <= 2 * beside; ++k) {
    least = std::min(least, height[(at + k + height.size() - beside) % height.size()]);
  }
  return least;
}

// m: given commissures this far below the annulus show tissue beyond it: points by hand err by 2
// mm. Those past this share of the way to the free edge were placed where the free edges meet.
constexpr double below_annulus = 3e-3, nearer_free_edge = 0.6;

// How far given commissures are from the annulus, if both lie below it; else empty.
std::vector<double> commissures_below(const LeafletSheet &sheet, const SheetRims &rims,
                                      const SheetCoordinates &coordinates,
                                      const std::vector<Vec3> &commissures) {
  std::vector<double> below;
  for (const Vec3 &p : commissures) {
    double least2 = INFINITY;
    for (size_t k = 0; k < rims.annulus.size(); ++k) {
      const Vec3 &a = sheet.x[rims.annulus[k]];
      const Vec3 &b = sheet.x[rims.annulus[(k + 1) % rims.annulus.size()]];
      least2 = std::min(least2, closest_on_segment(p, a, b).distance2);
    }
    const bool is_below = least2 > below_annulus * below_annulus &&
                          place_on(sheet, coordinates, p).share < nearer_free_edge;
    if (!is_below) return {};
    below.push_back(std::sqrt(least2));
  }
  return below;
}

std::string below_words(const std::vector<double> &below) {
  if (below.size() != 2) return "";
  return format(
      "; the given commissures lie %.1f and %.1f mm below the boundary that is taken for "
      "the annulus",
      below[0] * 1e3, below[1] * 1e3);
}

// m; 0: not known.
double mean_thickness(const LeafletSheet &sheet) {
  double sum = 0;
  for (const double t : sheet.thickness) sum += t;
  return sum / std::max(1.0, static_cast<double>(sheet.thickness.size()));
}

}  // namespace

void doubt_tall_leaflets(const LeafletSheet &sheet, const SheetRims &rims,
                         const SheetCoordinates &coordinates, const LeafletArcs &arcs,
                         const std::vector<Vec3> &commissures, Findings &findings) {
  Finding *annulus = find_finding(findings, "annulus");
  if (!annulus || annulus->source == FindingSource::given) return;
  const double length = coordinates.annulus_length;
  const std::vector<double> height = smoothed(height_profile(rims, coordinates, samples), 2);
  const double first = lowest_beside(height, sample_at(arcs.from, length, samples));
  const double last = lowest_beside(height, sample_at(arcs.to, length, samples));
  double anterior = 0;
  for (size_t k = 0; k < samples; ++k) {
    const double foot = (static_cast<double>(k) + 0.5) * length / samples;
    if (wrapped(foot - arcs.from, length) < arcs.to - arcs.from) {
      anterior = std::max(anterior, height[k]);
    }
  }
  const std::vector<double> below = commissures_below(sheet, rims, coordinates, commissures);
  const double scale = std::min(1.0, length / whole_annulus);
  const double thicker = std::max(0.0, mean_thickness(sheet) - usual_thickness);
  const bool tall = std::min(first, last) >= scale * tall_commissure + fused * thicker ||
                    anterior >= scale * tall_anterior;
  if (!tall && below.empty()) return;
  annulus->confidence *= 0.5;
  findings.push_back(
      {"tall_leaflets",
       FindingSource::guessed,
       0.5,
       format(
           "the leaflets are %.0f and %.0f mm high at the commissures and up to %.0f mm in the "
           "anterior leaflet, normal ones 8 to 10 and 22 to 25 mm%s: is wall of the atrium or the "
           "aorta part of the surface? Here it counts as leaflet; give six points or more all "
           "around the annulus, along which it is cut off",
           first * 1e3, last * 1e3, anterior * 1e3, below_words(below).c_str()),
       {first, last, anterior},
       "m"});
}

}  // namespace mvs::core
