// Sentences and confidence of a fit.
#include "patient/fit/fit_report.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace mvs::core {
namespace {

void add_name(std::string &list, const std::string &name) {
  list += (list.empty() ? "" : "; ") + name;
}

void report_distance(const ChordFit &fit, const FitSettings &s, double confidence,
                     Findings &findings) {
  std::string bound;
  for (size_t k = 0; k < fit.groups.size(); ++k) {
    if (fit.factor[k] <= s.least || fit.factor[k] >= s.most) add_name(bound, fit.groups[k].name);
  }
  findings.push_back(
      {"closed_fit",
       FindingSource::measured,
       confidence,
       format("chordae fitted in %u rounds: the closed valve is %.2f mm (RMS, between tissue that "
              "faces the same way) from the given surface, %.2f mm before%s%s%s",
              fit.rounds, fit.rms * 1e3, fit.rms_before * 1e3,
              fit.at_rest ? "" : "; it did not come to rest",
              bound.empty() ? "" : "; factors at their limit, are tips and rest shape right? ",
              bound.c_str()),
       {fit.rms, fit.rms_before},
       "m"});
}

}  // namespace

void report_fit(const ChordFit &fit, const FitSettings &s, Findings &findings) {
  std::string open;
  for (size_t k = 0; k < fit.groups.size(); ++k) {
    if (fit.deviation[k] >= undetermined_share * s.prior) add_name(open, fit.groups[k].name);
  }
  // 0.5 mm: two segmentations of one valve differ by as much; 2 mm: a fit that failed
  const double confidence =
      std::clamp(0.9 * (2e-3 - fit.rms) / 1.5e-3, 0.1, 0.9) * (fit.at_rest ? 1 : 0.5);
  report_distance(fit, s, confidence, findings);
  findings.push_back(
      {"chord_factors", FindingSource::measured, open.empty() ? confidence : 0.5 * confidence,
       open.empty() ? std::string("factors of all groups of chordae follow from the closed surface")
                    : "the closed surface does not determine the lengths of these chordae: " + open,
       fit.factor, ""});
  if (fit.chord_factor.empty()) return;
  const double prior = std::sqrt(s.prior * s.prior + s.single_prior * s.single_prior);
  const auto known =
      std::count_if(fit.chord_deviation.begin(), fit.chord_deviation.end(),
                    [&](double deviation) { return deviation < undetermined_share * prior; });
  std::vector<double> rows;
  for (size_t c = 0; c < fit.chord_factor.size(); ++c) {
    rows.push_back(fit.chord_factor[c]);
    rows.push_back(fit.chord_deviation[c]);
  }
  findings.push_back(
      {"chord_lengths", FindingSource::measured, confidence,
       format("the closed surface determines the lengths of %td of %zu chord segments; of each, "
              "the factor on its length and how far that is open (standard deviation)",
              known, fit.chord_factor.size()),
       std::move(rows), ""});
  std::vector<double> leaks = fit.other_leaks;
  leaks.push_back(fit.leak);
  const auto [least, most] = std::minmax_element(leaks.begin(), leaks.end());
  findings.push_back(
      {"fit_spread",
       FindingSource::measured,
       leaks.size() > 1 ? confidence : 0.5 * confidence,
       format("%zu of %u fits from different lengths are as good; their closed valves are up to "
              "%.2f mm (RMS) apart and leak through %.1f to %.1f mm2",
              leaks.size(), s.starts, fit.spread * 1e3, *least * 1e6, *most * 1e6),
       {fit.spread},
       "m"});
}

}  // namespace mvs::core
