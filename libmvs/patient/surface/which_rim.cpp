// By given points, by papillary tips, or by shape.
#include "patient/surface/which_rim.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "geometry/distance.h"
#include "patient/findings.h"
#include "patient/surface/mirrored.h"

namespace mvs::core {
namespace {

// m: papillary tips lie 15 to 40 mm below the annulus, also in a dilated ventricle.
constexpr double farthest_papillary_tip = 70e-3, usual_papillary_tip = 40e-3;
// m: points of the annulus are placed by hand on images of 0.7 mm; farther from a rim in the mean
// they say that tissue is missing or that the wall of the atrium belongs to the surface.
constexpr double near_annulus = 2e-3;
// How many times more like an annulus the other boundary may be than the one that tips show. Real
// annuli are 28 and more times as like one as their free edges, parametric ones 2 to 3 times.
constexpr double most_odds = 3;

// A rim that spans this many times the area of the other one is the likelier annulus, by odds of at
// least the second number, which make a guess a doubtful one. Annuli of open valves span 1.3 to 2.3
// times the area of their free edges. The voxels of labels lengthen and bend a rim, so that it is
// less like an annulus by up to 40 %, and hardly change its area.
constexpr double clearly_larger = 1.5, least_odds = 1.2;

// The mean distance of points from the curve of a rim.
double mean_distance(const LeafletSheet &sheet, const RimLoop &rim,
                     const std::vector<Vec3> &points) {
  double sum = 0;
  for (const Vec3 &p : points) {
    double least2 = INFINITY;
    for (size_t k = 0; k < rim.loop.size(); ++k) {
      const Vec3 &a = sheet.x[rim.loop[k]], &b = sheet.x[rim.loop[(k + 1) % rim.loop.size()]];
      least2 = std::min(least2, closest_on_segment(p, a, b).distance2);
    }
    sum += std::sqrt(least2);
  }
  return sum / static_cast<double>(points.size());
}

// Lowers the confidence in the annulus if the other boundary is more like one by its shape. Returns
// how many times more.
double doubt_shape(const std::vector<RimLoop> &rims, size_t annulus, const char *remedy,
                   Finding &finding) {
  const double odds = annulus_odds(rims[1 - annulus].shape, rims[annulus].shape);
  if (odds > 1) {
    finding.confidence /= odds;
    finding.sentence += format("; by its shape the other one is the annulus: %s", remedy);
  }
  return odds;
}

// Whether the first rim is the annulus, with how it was decided.
bool first_by_points(const LeafletSheet &sheet, const std::vector<RimLoop> &rims,
                     const std::vector<Vec3> &points, Finding &finding) {
  const double d0 = mean_distance(sheet, rims[0], points);
  const double d1 = mean_distance(sheet, rims[1], points);
  const double near = std::min(d0, d1), far = std::max(d0, d1);
  const auto other = [&] {
    const std::vector<Vec3> turned = mirrored(points);
    return std::min(mean_distance(sheet, rims[0], turned), mean_distance(sheet, rims[1], turned));
  };
  MVS_MUST(
      near <= farthest_annulus, MVS_E_OP, "annulus",
      "the annulus points lie %.1f mm from the nearest boundary of the surface in the mean, at "
      "most %.0f mm are accepted: are both in one frame (LPS or RAS), in m (--unit of a file), of "
      "one patient and one phase?%s",
      near * 1e3, farthest_annulus * 1e3, mirrored_words(near, other(), near_annulus).c_str());
  finding.source = FindingSource::given;
  finding.confidence = far > 0 ? (far - near) / far : 0;
  finding.sentence = format(
      "the boundary %.1f mm from the given points in the mean; the other one is %.1f mm away",
      near * 1e3, far * 1e3);
  if (near > off_by_frame && fits_mirrored(near, other(), near_annulus)) {
    finding.confidence = std::min(finding.confidence, mirrored_confidence);
    finding.sentence += "." + mirrored_words(near, other(), near_annulus);
  } else if (near > near_annulus) {
    finding.confidence = std::min(finding.confidence, near_annulus / near);
    finding.sentence +=
        "; the leaflets are taken to begin at this boundary, not at the points: if tissue between "
        "them is the wall of the atrium, give six points or more all around the annulus, on the "
        "surface, along which it is cut off";
  }
  doubt_shape(rims, d0 <= d1 ? 0 : 1, "check that the points are not those of the free edge",
              finding);
  return d0 <= d1;
}

// The mean distances of the tips from the middles of both rims.
std::array<double, 2> distances_of_tips(const std::vector<RimLoop> &rims,
                                        const std::vector<Vec3> &tips) {
  std::array<double, 2> apart{};
  for (size_t k = 0; k < 2; ++k) {
    for (const Vec3 &tip : tips) apart[k] += (tip - rims[k].shape.centre).norm();
    apart[k] /= static_cast<double>(tips.size());
  }
  return apart;
}

bool first_by_tips(const std::vector<RimLoop> &rims, const std::vector<Vec3> &tips,
                   Finding &finding) {
  const std::array<double, 2> apart = distances_of_tips(rims, tips);
  const double near = std::min(apart[0], apart[1]), far = std::max(apart[0], apart[1]);
  const auto other = [&] {
    const std::array<double, 2> turned = distances_of_tips(rims, mirrored(tips));
    return std::min(turned[0], turned[1]);
  };
  MVS_MUST(
      near <= farthest_papillary_tip, MVS_E_OP, "papillary_tips",
      "the papillary tips lie %.0f mm from the middle of the nearer boundary in the mean, at "
      "most %.0f mm are accepted: are both in one frame (LPS or RAS), in m (--unit of a file), "
      "and of one patient?%s",
      near * 1e3, farthest_papillary_tip * 1e3,
      mirrored_words(near, other(), usual_papillary_tip).c_str());
  // the free edge of a normal valve is two thirds as far from the tips
  finding.confidence = std::clamp(3 * (far - near) / far, 0.0, 1.0);
  finding.sentence = format(
      "the boundary whose middle is %.0f mm from the papillary tips; the other one is %.0f mm away",
      far * 1e3, near * 1e3);
  const size_t annulus = apart[0] >= apart[1] ? 0 : 1;
  const double odds = doubt_shape(
      rims, annulus, "give points of the annulus, and check the frame of the tips", finding);
  MVS_MUST(
      odds <= most_odds, MVS_E_OP, "papillary_tips",
      "the papillary tips are nearer to the boundary that is the annulus by its shape, %.0f mm "
      "from it and %.0f mm from the free edge: tips lie below the free edge; are both in one "
      "frame (LPS or RAS) and one unit? If so, give points of the annulus",
      near * 1e3, far * 1e3);
  return annulus == 0;
}

bool first_by_shape(const std::vector<RimLoop> &rims, Finding &finding) {
  const double first = annulus_odds(rims[0].shape, rims[1].shape),
               odds = std::max(first, 1 / first);
  const LoopShape &annulus = rims[first >= 1 ? 0 : 1].shape;
  const LoopShape &edge = rims[first >= 1 ? 1 : 0].shape;
  const bool is_rough = annulus_likeness(annulus) < annulus_likeness(edge);
  finding.source = FindingSource::guessed;
  finding.confidence = std::min((odds - 1) / (odds + 1), 0.95);
  finding.sentence = format(
      "the boundary that %s: it is %.0f mm long, spans %.0f mm2 and "
      "has a total curvature of %.1f turns; the other one is %.0f mm long, spans %.0f mm2 and has "
      "%.1f turns; give points of the annulus if this is wrong",
      is_rough ? "spans more, though for its length the other one is rounder and smoother"
               : "is larger, rounder and smoother",
      annulus.chord_length * 1e3, annulus.area.norm() * 1e6, annulus.turning,
      edge.chord_length * 1e3, edge.area.norm() * 1e6, edge.turning);
  return first >= 1;
}

}  // namespace

double annulus_likeness(const LoopShape &shape) {
  const double area = shape.area.norm();
  const double length = shape.chord_length;
  return area * area / (length * length * shape.turning * shape.turning);
}

double annulus_odds(const LoopShape &rim, const LoopShape &other) {
  const double odds = annulus_likeness(rim) / std::max(annulus_likeness(other), 1e-300);
  const double areas = rim.area.norm() / std::max(other.area.norm(), 1e-300);
  if (areas > clearly_larger) return std::max(odds, least_odds);
  return areas < 1 / clearly_larger ? std::min(odds, 1 / least_odds) : odds;
}

void order_rims(const LeafletSheet &sheet, const RimLandmarks &landmarks,
                std::vector<RimLoop> &rims, Findings &findings) {
  Finding finding;
  finding.name = "annulus";
  const bool first = !landmarks.annulus.empty()
                         ? first_by_points(sheet, rims, landmarks.annulus, finding)
                         : (!landmarks.tips.empty() ? first_by_tips(rims, landmarks.tips, finding)
                                                    : first_by_shape(rims, finding));
  if (!first) std::swap(rims[0], rims[1]);
  // points along which tissue of the atrium is cut off stay those that were given, so that they
  // lead to the same cut again
  std::vector<Vec3> points;
  if (find_finding(findings, "atrial_tissue")) {
    points = landmarks.annulus;
  } else {
    for (const uint32_t node : rims[0].loop) points.push_back(sheet.x[node]);
  }
  set_points(points, finding);
  findings.push_back(finding);
}

}  // namespace mvs::core
