// Commissures, the anterior leaflet, scallops.
#include "patient/leaflets.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "measure/annulus/landmarks.h"
#include "model/sides.h"
#include "patient/findings.h"
#include "patient/given_commissures.h"
#include "patient/leaflet_heights.h"
#include "patient/leaflet_labels.h"
#include "patient/leaflet_odds.h"
#include "patient/surface/mirrored.h"

namespace mvs::core {
namespace {

// Samples of the annulus: about 1 mm apart.
constexpr size_t samples = 120;
// As least_share of given commissures, for a guess: it must not take both ends of one notch.
constexpr double least_guessed_share = 0.28;
// Odds of the leaflet that is said to be the anterior one, below which this is doubted.
constexpr double doubtful_odds = 0.1;
// A valve with a third place as low as the guessed commissures is not likely a mitral one: the
// guess is doubted. None of the valves of forty_surfaces.py has one.
constexpr double third_leaflet_confidence = 0.1;
// The anterior leaflet is up to twice as high as the posterior one, and about as high where that is
// enlarged. Below this share of its height a given one is doubted, with a confidence of this.
constexpr double low_anterior = 0.75, low_confidence = 0.4;
// Least over greatest height along the annulus, from which on no commissures are guessed: leaflets
// are 0.25 to 0.5 times as high at a commissure as at A2, a tube cut straight is as high
// everywhere.
constexpr double even_height = 0.8;
// Shares of an arc at which A2 and P2 begin and end: their widths in the parametric valve.
constexpr double a2_begin = 0.22, p2_begin = 0.27;

Finding &add(Findings &findings, const char *name, FindingSource source, double confidence,
             std::string sentence) {
  findings.push_back({name, source, confidence, std::move(sentence), {}, ""});
  return findings.back();
}

// Clefts and tears are narrower than 6 mm, leaflets are low over 10 mm and more at a commissure.
AnnulusSamples annulus_samples(const LeafletSheet &sheet, const SheetRims &rims,
                               const std::vector<double> &heights, const std::vector<Vec3> &tips) {
  const Loop loop(rims.annulus, sheet.x);
  AnnulusSamples annulus;
  annulus.tips = tips;
  annulus.height = smoothed(without_notches(heights, 3), 2);
  for (size_t k = 0; k < samples; ++k) {
    annulus.points.push_back(loop.at((static_cast<double>(k) + 0.5) / samples * loop.length()));
  }
  return annulus;
}

// Refuses a tube, in which nothing shows where leaflets meet.
void check_heights(const std::vector<double> &height) {
  const auto [least, most] = std::minmax_element(height.begin(), height.end());
  MVS_MUST(
      *least < even_height * *most, MVS_E_OP, "commissures",
      "the surface is a tube without leaflets: it is %.1f to %.1f mm high all along its annulus, "
      "and leaflets are about half as high at both commissures as between them. Give a "
      "surface of the leaflets down to their free edge; if it is one, give both commissures",
      *least * 1e3, *most * 1e3);
}

// Feet of commissures, and the probability of the side of the anterior leaflet as far as it depends
// on where they are.
struct GuessedFeet {
  std::array<double, 2> feet{};
  double orientation = 1;
};

GuessedFeet guessed_commissures(const AnnulusSamples &annulus, const std::vector<double> &heights,
                                double length, Findings &findings) {
  check_heights(annulus.height);
  const ArcGuess guess = ArcOdds(annulus).best(least_guessed_share);
  const std::vector<double> exact = smoothed(heights, 2);
  const size_t i = lowest_near(exact, guess.from), j = lowest_near(exact, guess.to % samples);
  add(findings, "commissures", FindingSource::guessed, std::min(0.9, guess.confidence),
      format("where heights of the leaflets%s are most like those of a normal "
             "valve; the leaflets are %.1f and %.1f mm high there. Give both commissures first: "
             "scallops, chordae and the closed shape follow from them",
             annulus.tips.empty() ? " and shape of the annulus"
                                  : ", shape of the annulus and place of the papillary tips",
             exact[i] * 1e3, exact[j] * 1e3));
  if (const size_t others = other_low_places(annulus.height, i, j); others > 0) {
    findings.back().confidence =
        std::min(0.5 * findings.back().confidence, third_leaflet_confidence);
    findings.back().sentence += format(
        "; %zu other places along the annulus are as low: clefts, or commissures of a third "
        "leaflet, as aortic and tricuspid valves have; a mitral valve is taken for granted",
        others);
  }
  const double width = length / samples;
  return {{(static_cast<double>(i) + 0.5) * width, (static_cast<double>(j) + 0.5) * width},
          guess.orientation};
}

bool contains(double from, double to, double foot, double length) {
  return wrapped(foot - from, length) < to - from;
}

// The odds that the leaflet along an arc is the anterior one, and their cues in words.
struct AnteriorOdds {
  double odds;
  std::string cues;
  double orientation = 1;  // GuessedFeet
};

AnteriorOdds anterior_odds(const AnnulusSamples &annulus, const LeafletArcs &arcs, double length) {
  size_t first = sample_at(arcs.from, length, samples);
  size_t last = sample_at(arcs.to, length, samples);
  if (last <= first) last += samples;
  return {ArcOdds(annulus).is_anterior(first, last),
          std::string("its height and the share and flatness of its annulus") +
              (annulus.tips.empty() ? "" : ", and by the papillary tips")};
}

// Adds the finding of an anterior leaflet that was given or labelled, with a doubt if the odds of
// its shape are low.
void add_anterior(FindingSource source, const char *sentence, const AnteriorOdds &shape,
                  bool anterior, Findings &findings) {
  const double odds = anterior ? shape.odds : 1 - shape.odds;
  if (odds >= doubtful_odds) {
    add(findings, "anterior", source, 1, sentence);
    if (odds < 0.5) {
      findings.back().sentence += format("; by %s alone the other one is the likelier, %.0f %%",
                                         shape.cues.c_str(), 100 * (1 - odds));
    }
    return;
  }
  add(findings, "anterior", source, odds,
      format("%s; but the other one is %.0f %% likely to be the anterior one by %s: are both "
             "leaflets swapped?",
             sentence, 100 * (1 - odds), shape.cues.c_str()));
}

// The greatest height of the leaflet along an arc, m.
double greatest_height(const std::vector<double> &height, double from, double to, double length) {
  double most = 0;
  for (size_t k = 0; k < samples; ++k) {
    const double foot = foot_of(k, length, samples);
    if (contains(from, to, foot, length)) most = std::max(most, height[k]);
  }
  return most;
}

// Doubts a given anterior leaflet that is far lower than the other one, as with landmarks of
// another frame.
void doubt_low(const AnnulusSamples &annulus, const LeafletArcs &arcs, double length,
               Finding &finding) {
  const double own = greatest_height(annulus.height, arcs.from, arcs.to, length);
  const double other = greatest_height(annulus.height, arcs.to, arcs.from + length, length);
  if (own >= low_anterior * other) return;
  finding.confidence = std::min(finding.confidence, low_confidence);
  finding.sentence += format(
      "; but it is up to %.0f mm high and the other one %.0f mm: are both leaflets swapped, or are "
      "the landmarks in the other frame of LPS and RAS?",
      own * 1e3, other * 1e3);
}

// Doubts an anterior point that lies on the surface only if x and y are mirrored.
void doubt_mirrored(double distance, double other, Finding &finding) {
  if (distance <= off_by_frame || !fits_mirrored(distance, other, farthest_landmark)) return;
  finding.confidence = std::min(finding.confidence, mirrored_confidence);
  finding.sentence += format(", which lies %.1f mm from the surface.", distance * 1e3) +
                      mirrored_words(distance, other, farthest_landmark);
}

// Whether the leaflet along an arc is the anterior one. `shape`: the odds for it by its shape.
bool decide_anterior(const LeafletSheet &sheet, const SheetCoordinates &c,
                     const LeafletLandmarks &landmarks, const LabelledArea &area,
                     const AnteriorOdds &shape, const LeafletArcs &arcs, Findings &findings) {
  const double length = c.annulus_length;
  const auto [from, to] = arcs;
  if (!landmarks.anterior.empty()) {
    const SheetPlace place = place_on(sheet, c, landmarks.anterior[0]);
    MVS_MUST(place.distance <= farthest_landmark, MVS_E_OP, "anterior",
             "the anterior point lies %.1f mm from the surface, at most %.0f mm are accepted: are "
             "both in one frame (LPS or RAS), and in m (--unit of a file)?",
             place.distance * 1e3, farthest_landmark * 1e3);
    const bool anterior = contains(from, to, place.foot, length);
    add_anterior(FindingSource::given, "the leaflet with the given point", shape, anterior,
                 findings);
    doubt_mirrored(place.distance, place_on(sheet, c, mirrored(landmarks.anterior[0])).distance,
                   findings.back());
    return anterior;
  }
  double labelled = 0;
  for (size_t k = 0; k < samples; ++k) {
    const double foot = foot_of(k, length, samples);
    labelled += contains(from, to, foot, length) ? area.balance[k] : -area.balance[k];
  }
  if (labelled != 0) {
    add_anterior(FindingSource::measured, "the leaflet that is labelled so", shape, labelled > 0,
                 findings);
    return labelled > 0;
  }
  const double likely = std::min(std::max(shape.odds, 1 - shape.odds), shape.orientation);
  add(findings, "anterior", FindingSource::guessed, std::clamp(2 * likely - 1, 0.0, 0.95),
      format(
          "the leaflet that is more like a normal anterior one by %s: %.0f %% likely%s. If it is "
          "the other one, all scallops, chordae, measures and operations are on the wrong "
          "leaflet: give a point of the anterior leaflet",
          shape.cues.c_str(), 100 * likely,
          shape.orientation < 1 ? ", over all places where commissures may be" : ""));
  return shape.odds >= 0.5;
}

// The point of the annulus at an arc length.
Vec3 annulus_point(const LeafletSheet &sheet, const SheetRims &rims, double s) {
  return Loop(rims.annulus, sheet.x).at(s);
}

}  // namespace

LeafletArcs find_leaflets(const LeafletSheet &sheet, const SheetRims &rims,
                          const SheetCoordinates &coordinates, const LeafletLandmarks &landmarks,
                          Findings &findings) {
  const double length = coordinates.annulus_length;
  const std::vector<double> heights = height_profile(rims, coordinates, samples);
  const AnnulusSamples annulus = annulus_samples(sheet, rims, heights, landmarks.tips);
  const LabelledArea area = labelled_area(sheet, coordinates, samples);
  const size_t at = findings.size();
  double orientation = 1;
  std::vector<Vec3> commissures = landmarks.commissures;
  if (!commissures.empty()) {
    add(findings, "commissures", FindingSource::given, 1, "");
  } else {
    const GuessedFeet guess = area.anterior + area.posterior > 0
                                  ? GuessedFeet{commissures_of_labels(area, length, findings)}
                                  : guessed_commissures(annulus, heights, length, findings);
    for (const double s : guess.feet) commissures.push_back(annulus_point(sheet, rims, s));
    if (landmarks.anterior.empty()) orientation = guess.orientation;
    findings[at].confidence *= orientation;  // the sides tell the two commissures apart
  }
  // found points take the same way as given ones, so that giving them changes no bit
  const CommissureFeet placed =
      feet_of(sheet, coordinates, commissures, !landmarks.commissures.empty());
  const std::array<double, 2> &feet = placed.feet;
  if (!landmarks.commissures.empty()) {
    say_given(placed, findings[at]);
    doubt_high(annulus, feet, length, findings[at]);
    doubt_unlikely(annulus, feet, length, least_guessed_share, findings[at]);
  }
  LeafletArcs arcs = {feet[0], feet[0] + wrapped(feet[1] - feet[0], length)};
  AnteriorOdds shape = anterior_odds(annulus, arcs, length);
  shape.orientation = orientation;
  if (!decide_anterior(sheet, coordinates, landmarks, area, shape, arcs, findings)) {
    arcs = {feet[1], feet[1] + wrapped(feet[0] - feet[1], length)};
    std::swap(commissures[0], commissures[1]);
  }
  if (!landmarks.anterior.empty()) doubt_low(annulus, arcs, length, findings.back());
  const double share = (arcs.to - arcs.from) / length;
  MVS_MUST(share >= least_share && share <= 1 - least_share, MVS_E_OP, "commissures",
           "the anterior leaflet would be attached along %.0f %% of the annulus: is a leaflet "
           "missing, or are labels or commissures swapped?",
           100 * share);
  set_points({commissures[1], commissures[0]}, findings[at]);  // the anterolateral one first
  set_points({annulus_point(sheet, rims, 0.5 * (arcs.from + arcs.to))}, findings.back());
  return arcs;
}

uint32_t scallop_of(const LeafletArcs &arcs, double foot, double annulus_length) {
  const double along = wrapped(foot - arcs.from, annulus_length), arc = arcs.to - arcs.from;
  if (along < arc) {
    const double f = along / arc;  // from A3 to A1
    return f < a2_begin ? 2 : (f <= 1 - a2_begin ? 1 : 0);
  }
  const double f = (along - arc) / (annulus_length - arc);  // from P1 to P3
  return f < p2_begin ? 3 : (f <= 1 - p2_begin ? 4 : 5);
}

}  // namespace mvs::core
