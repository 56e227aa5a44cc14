// Sentences and confidence of a leak.
#include "patient/fit/leak_report.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/error.h"
#include "patient/findings.h"

namespace mvs::core {
namespace {

// Confidence of a leak that does not depend on the lengths, and the difference at which none is
// left: grades of regurgitation are 10 to 20 mm2 apart (0.2, 0.3, 0.4 cm2).
constexpr double same_leak_confidence = 0.8, unknown_leak = 20e-6;

// One decimal, in mm2.
std::string area_words(double leak) {
  return std::isnan(leak) ? "(diverged)" : format("%.1f mm2", leak * 1e6);
}

std::string shape_words(const ShapeLeaks &shape) {
  return format(
      "; the closed valve lies %.2f mm (RMS, to the nearest tissue, whichever way it faces) from "
      "the given surface: with edges %.2f mm short of "
      "where they are it leaks %s, and %s through gaps as much narrower on both sides",
      shape.distance * 1e3, shape.error * 1e3, area_words(shape.most).c_str(),
      area_words(shape.least).c_str());
}

std::string ranges_of(const LeakInterval &interval, const EdgeRange &edge, double thickness_error) {
  const double more = interval.factor[2] - 1;
  std::string ranges = format("lengths of chordae up to %.0f %% shorter or longer", 100 * more);
  if (edge.geometry) {
    ranges += format(
        ", a free edge up to %.1f mm farther out (%s with the lengths as they are) or %.1f mm "
        "farther in (%s)",
        edge.out * 1e3, area_words(interval.edge_leak[0]).c_str(), edge.in * 1e3,
        area_words(interval.edge_leak[1]).c_str());
  }
  if (thickness_error > 0) {
    ranges += format(", tissue up to %.2f mm thicker (%s) or thinner (%s)", thickness_error * 1e3,
                     area_words(interval.tissue_leak[0]).c_str(),
                     area_words(interval.tissue_leak[1]).c_str());
  }
  return ranges;
}

// Landmarks of a list of findings that were not given, in words; empty: all were given, or the list
// has none, as that of a valve without a surface.
std::string not_given_words(const Findings &findings) {
  constexpr std::pair<const char *, const char *> landmarks[] = {
      {"papillary_tips", "papillary heads"}, {"commissures", "commissures"}};
  std::string words;
  for (const auto &[name, meaning] : landmarks) {
    const Finding *found = find_finding(findings, name);
    if (found == nullptr ||
        (found->source != FindingSource::guessed && found->source != FindingSource::assumed)) {
      continue;
    }
    words += (words.empty() ? "" : " and ") + std::string(meaning);
  }
  return words;
}

Finding leaks_by_length(const LeakInterval &interval, double confidence, bool at_rest) {
  const auto &[f0, f1, f2] = interval.factor;
  Finding finding{
      "leak",
      FindingSource::measured,
      confidence,
      format("regurgitant orifice at 120 mmHg with chordae of %.0f, %.0f and %.0f %% of their "
             "lengths: %s, %s and %s%s; lengths are known to that range only, so one of these "
             "numbers alone says little",
             100 * f0, 100 * f1, 100 * f2, area_words(interval.leak[0]).c_str(),
             area_words(interval.leak[1]).c_str(), area_words(interval.leak[2]).c_str(),
             at_rest ? "" : ", not all of them at rest"),
      {},
      "m2"};
  for (const double leak : interval.leak) {
    if (!std::isnan(leak)) finding.value.push_back(leak);
  }
  return finding;
}

// Whether two numbers differ where they are shown, with one decimal in mm2.
bool differ(double a, double b) {
  return std::abs(a - b) >= 0.05e-6;
}

// The closures beside the interval, if it reaches beyond them.
std::string closures_words(const LeakInterval &interval) {
  const auto [least, most] = interval.of_closures;
  if (std::isnan(most)) return "";
  if (!differ(least, interval.least) && !differ(most, interval.most)) return "";
  return format("; by closures alone %.1f to %.1f mm2", least * 1e6, most * 1e6);
}

// The parts of the interval that the given closed surface makes.
std::string surface_words(const LeakInterval &interval) {
  std::string words;
  if (interval.shape.distance > 0) words += shape_words(interval.shape);
  const auto [least, most] = interval.with_shape;
  if (differ(least, interval.of_closures[0]) || differ(most, interval.of_closures[1])) {
    words += format(": this widens the interval to %.1f to %.1f mm2", least * 1e6, most * 1e6);
  }
  const auto [narrow, wide] = interval.shown;
  if (wide > 0 && (narrow <= interval.least || wide >= interval.most)) {
    const bool lower = narrow<least, upper = wide> most;
    words += format("; that surface itself has gaps of %.1f to %.1f mm2", narrow * 1e6, wide * 1e6);
    if (lower || upper) {
      words += format(
          ": %s the interval %s theirs",
          lower && upper ? "both ends of" : (lower ? "the lower end of" : "the upper end of"),
          lower && upper ? "are" : "is");
    }
  }
  return words;
}

// The interval, with where each part of it comes from.
std::string interval_words(const LeakInterval &interval, const std::string &ranges,
                           const std::string &not_given) {
  std::string words = format("%.1f to %.1f mm2%s for %s", interval.least * 1e6, interval.most * 1e6,
                             closures_words(interval).c_str(), ranges.c_str());
  const uint32_t moving = interval.closures - interval.rests;
  if (interval.draws > 0) {
    words += format("; %u closures with random ones are among them", interval.draws);
  } else if (!interval.creeps) {
    words += format(": each of these closures leaks less than %.1f mm2", sealed_leak * 1e6);
  }
  if (moving > 0) {
    words +=
        format("; %u of %u closures did not come to rest and %s", moving, interval.closures,
               interval.creeps ? "count with the shapes that they have reached" : "are left out");
  }
  words += surface_words(interval);
  if (!not_given.empty()) {
    words += "; errors of the " + not_given + ", which were not given, are not in it";
  }
  return words;
}

std::string unknown_words(const LeakInterval &interval, const std::string &ranges) {
  const std::string rest = interval.rests == 0 ? "none" : format("only %u", interval.rests);
  return format(
      "not determined: %s of %u closures came to rest, for %s; check the surface, the thickness, "
      "the papillary tips, and that all lie in one frame",
      rest.c_str(), interval.closures, ranges.c_str());
}

// Less sure the fewer closures came to rest, and no more than the fit to a closed surface is.
double confidence_in(const LeakInterval &interval, const Findings &findings) {
  if (std::isnan(interval.most)) return 0;
  const double unsure = std::min(1.0, (interval.most - interval.least) / unknown_leak);
  double confidence = same_leak_confidence * (1 - unsure);
  if (interval.rests < interval.closures) {
    confidence *= 0.5 * interval.rests / interval.closures;
  }
  const Finding *fit = find_finding(findings, "closed_fit");
  return fit == nullptr ? confidence : std::min(confidence, fit->confidence);
}

// A finding where fewer than half of the closures came to rest.
void report_moving(const LeakInterval &interval, Findings &findings) {
  if (2 * interval.rests >= interval.closures) return;
  const double share = static_cast<double>(interval.rests) / interval.closures;
  findings.push_back(
      {"leak_at_rest",
       FindingSource::measured,
       share,
       format("%u of %u closures with other lengths, edges and thicknesses came to rest: the leak "
              "of this valve is not sure; check the thickness, the papillary tips, and that the "
              "open and the closed surface lie in one frame",
              interval.rests, interval.closures),
       {share},
       ""});
}

}  // namespace

void report_leaks(const LeakInterval &interval, const EdgeRange &edge, double thickness_error,
                  Findings &findings) {
  const double confidence = confidence_in(interval, findings);
  findings.push_back(leaks_by_length(interval, confidence, interval.rests == interval.closures));
  const std::string not_given = not_given_words(findings);
  const std::string ranges = ranges_of(interval, edge, thickness_error);
  Finding finding{"leak_interval", FindingSource::measured, confidence, {}, {}, "m2"};
  if (std::isnan(interval.most)) {
    finding.sentence = unknown_words(interval, ranges);
  } else {
    finding.sentence = interval_words(interval, ranges, not_given);
    finding.value = {interval.least, interval.most};
  }
  findings.push_back(finding);
  report_moving(interval, findings);
  findings.push_back(
      {"leak_limits",
       FindingSource::assumed,
       1,
       format(
           "meshes of one sealed valve leak alike to %.1f mm2, those of a leaking one less so: "
           "compare edges of other lengths; an interval of %.0f mm2 says nothing, "
           "as grades of regurgitation are that far apart; leaks of ruptured or missing chordae, "
           "and of other insertions than those of this valve%s%s, are not in it%s",
           sealed_leak * 1e6, unknown_leak * 1e6,
           not_given.empty() ? "" : ", and errors of the guessed ", not_given.c_str(),
           not_given.empty() ? "" : ": give them as landmarks"),
       {sealed_leak, unknown_leak},
       "m2"});
}

}  // namespace mvs::core
