// Distances on the surface, and heights of the leaflets at the commissures and between them.
#include "patient/given_commissures.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/math.h"
#include "patient/surface/mirrored.h"

namespace mvs::core {
namespace {

// m: given commissures farther from the surface than landmarks by hand are doubted.
constexpr double near_landmark = 3e-3;
// Given commissures are doubted if they, and all pairs within near_landmark of them, are less
// likely than this beside the likeliest pair: as the odds below which an anterior leaflet is
// doubted.
constexpr double doubtful_ratio = 0.1;

// The least misfit of pairs within near_landmark of two feet, with either arc as the anterior one.
double least_misfit_near(const ArcOdds &odds, const std::array<double, 2> &feet, double length,
                         size_t n) {
  const size_t near =
      static_cast<size_t>(std::lround(near_landmark * static_cast<double>(n) / length));
  const size_t a = sample_at(feet[0], length, n) + n - near,
               b = sample_at(feet[1], length, n) + n - near;
  double least = HUGE_VAL;
  for (size_t i = 0; i <= 2 * near; ++i) {
    for (size_t j = 0; j <= 2 * near; ++j) {
      const size_t from = (a + i) % n, to = (b + j) % n;
      least = std::min({least, odds.misfit(from, to > from ? to : to + n),
                        odds.misfit(to, from > to ? from : from + n)});
    }
  }
  return least;
}

// m along the annulus from two feet to two others, each to its own: the farther, in the better
// order.
double farthest_of(const std::array<double, 2> &feet, const std::array<double, 2> &others,
                   double length) {
  const auto away = [&](size_t k, size_t j) {
    return std::abs(around(feet[k], others[j], length));
  };
  return std::min(std::max(away(0, 0), away(1, 1)), std::max(away(0, 1), away(1, 0)));
}

}  // namespace

CommissureFeet feet_of(const LeafletSheet &sheet, const SheetCoordinates &coordinates,
                       const std::vector<Vec3> &points, bool given) {
  CommissureFeet found;
  auto &[feet, distance, other] = found;
  for (const Vec3 &p : points) {
    other = std::max(other, place_on(sheet, coordinates, mirrored(p)).distance);
  }
  for (size_t k = 0; k < 2; ++k) {
    const SheetPlace place = place_on(sheet, coordinates, points[k]);
    MVS_MUST(place.distance <= farthest_landmark, MVS_E_OP, "commissures",
             "commissure %zu lies %.1f mm from the surface, at most %.0f mm are accepted: are both "
             "in one frame (LPS or RAS), in m (--unit of a file), of one patient and one phase?%s",
             k + 1, place.distance * 1e3, farthest_landmark * 1e3,
             mirrored_words(place.distance, other, near_landmark).c_str());
    feet[k] = place.foot;
    distance[k] = place.distance;
  }
  const double apart = std::abs(around(feet[0], feet[1], coordinates.annulus_length));
  MVS_MUST(apart >= least_share * coordinates.annulus_length, MVS_E_OP, "commissures",
           "the commissures are %.1f mm apart along the annulus of %.0f mm, less than a fifth of "
           "it: %s",
           apart * 1e3, coordinates.annulus_length * 1e3,
           given
               ? "give one point for each commissure"
               : "is wall of the atrium labelled as a leaflet? Give six points or more all around "
                 "the annulus, along which it is cut off");
  return found;
}

void say_given(const CommissureFeet &found, Finding &finding) {
  const std::array<double, 2> &distance = found.distance;
  const double farthest = std::max(distance[0], distance[1]);
  finding.sentence = format("the given points, %.1f and %.1f mm from the surface",
                            distance[0] * 1e3, distance[1] * 1e3);
  const bool is_mirrored =
      farthest > off_by_frame && fits_mirrored(farthest, found.mirrored, near_landmark);
  if (farthest <= near_landmark && !is_mirrored) return;
  finding.confidence = std::min(1.0, near_landmark / farthest);
  finding.sentence += ": are they of this patient and phase?" +
                      mirrored_words(farthest, found.mirrored, near_landmark);
  if (is_mirrored) finding.confidence = std::min(finding.confidence, mirrored_confidence);
}

void doubt_high(const AnnulusSamples &annulus, const std::array<double, 2> &feet, double length,
                Finding &finding) {
  const auto height = [&](double foot) {
    return annulus.height[sample_at(foot, length, annulus.height.size())];
  };
  const double half = 0.5 * wrapped(feet[1] - feet[0], length);
  const std::array<double, 2> there = {height(feet[0]), height(feet[1])},
                              between = {height(feet[0] + half),
                                         height(feet[1] + 0.5 * length - half)};
  const double share = (between[0] + between[1]) / (there[0] + there[1]);
  if (!(share < 1)) return;
  finding.confidence *= 0.5 * share;
  finding.sentence += format(
      "; but the leaflets are %.1f and %.1f mm high there and %.1f and %.1f mm midway between: "
      "commissures are where leaflets are lowest, are these in the middle of the free edges?",
      there[0] * 1e3, there[1] * 1e3, between[0] * 1e3, between[1] * 1e3);
}

void doubt_unlikely(const AnnulusSamples &annulus, const std::array<double, 2> &feet, double length,
                    double least_guessed_share, Finding &finding) {
  const size_t n = annulus.height.size();
  const ArcOdds odds(annulus);
  const ArcGuess best = odds.best(least_guessed_share);
  const double likeliest = odds.misfit(best.from, best.to);
  const double deviation = least_misfit_near(odds, feet, length, n) - likeliest;
  const double ratio = math::exp(-0.5 * deviation);
  if (!(ratio < doubtful_ratio)) return;
  const double away =
      farthest_of(feet, {foot_of(best.from, length, n), foot_of(best.to % n, length, n)}, length);
  finding.confidence *= ratio;
  finding.sentence += format(
      "; but they lie up to %.0f mm along the annulus from the likeliest places, by heights of the "
      "leaflets, shape of the annulus%s, which are %s times as likely: are they of this patient "
      "and "
      "phase, in this frame (LPS or RAS), and one for each commissure?",
      away * 1e3, annulus.tips.empty() ? "" : " and papillary tips",
      deviation < 14 ? format("%.0f", 1 / ratio).c_str() : "over 1000");
}

}  // namespace mvs::core
