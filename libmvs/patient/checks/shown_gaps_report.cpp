// The findings about gaps that a closed surface shows, in words.
#include <algorithm>
#include <utility>

#include "base/error.h"
#include "patient/fit/shown_gaps.h"

namespace mvs::core {
namespace {

// A valve closes gaps if it leaks less than this share of them, and leaks far more if they are less
// than this share of its leak: intervals of fitted valves are about as wide.
constexpr double share_of_shown = 0.5;
// Confidence of gaps that the valve shows as well, and of those that it closes, which is doubtful.
constexpr double confidence_of_same = 0.7, confidence_of_other = 0.3;

std::string words_of_narrow(const ShownGaps &shown) {
  return format(
      "; narrower gaps of %.1f mm2, up to %.1f mm wide, do not count: errors of %.2f mm "
      "open as wide ones; give a smaller closed_error if the surface is better",
      shown.narrow_area * 1e6, shown.narrow_width * 1e3, shown.error * 1e3);
}

}  // namespace

void report_closed_error(double error, Findings &findings) {
  if (!(error > 0)) return;
  findings.push_back(
      {"closed_error",
       FindingSource::given,
       1,
       format("places of the closed surface have a standard deviation of %.2f mm, "
              "as given; gaps of it count from %.2f mm of width on, of tissue thicker than %.2f mm "
              "from as much more as it is thicker",
              error * 1e3, least_widths * error * 1e3,
              std::min(usual_thickness, usual_thicknesses * error) * 1e3),
       {error},
       "m"});
}

void report_shown_gaps(const ShownGaps &shown, double leak, Findings &findings) {
  const bool closes = shown.most > 0 && leak < share_of_shown * shown.area;
  const bool opens = shown.most > 0 && share_of_shown * leak > shown.most;
  Finding finding{"shown_gaps",
                  FindingSource::measured,
                  closes || opens ? confidence_of_other : confidence_of_same,
                  {},
                  {shown.area},
                  "m2"};
  if (!shown.missing.empty()) {
    finding.sentence = format(
        "gaps of the closed surface are not measured: it has less than %.0f %% of leaflet %s",
        100 * least_of_leaflet, shown.missing.c_str());
    finding.value.clear();
  } else if (shown.gaps.empty()) {
    finding.sentence = format("the closed surface shows no gap wider than %.1f mm between leaflets",
                              shown.least_width * 1e3);
  } else {
    finding.sentence =
        format("the closed surface shows gaps of %.1f mm2 between the middles of leaflets",
               shown.area * 1e6);
    for (const ShownGap &gap : shown.gaps) {
      finding.sentence += format("; %.1f mm2, %.1f mm wide (%s)", gap.area * 1e6, gap.width * 1e3,
                                 gap.place.c_str());
      if (!would_close(gap)) continue;
      finding.sentence += format(", which do not count: %.1f mm of tissue are missing beside it",
                                 gap.missing * 1e3);
    }
    if (shown.most == 0 && shown.area > 0) finding.sentence += "; errors of a surface show as much";
    const std::string has =
        format("; the valve that was fitted to it leaks %.1f mm2: ", leak * 1e6);
    if (closes) {
      finding.sentence +=
          has +
          "its chordae and tissue there are not those of the patient, or the surface "
          "lacks tissue there";
    }
    if (opens) {
      finding.sentence +=
          has + "its chordae, its tissue or its free edge are not those of the patient";
    }
  }
  if (shown.narrow_area > 0) finding.sentence += words_of_narrow(shown);
  findings.push_back(std::move(finding));
}

}  // namespace mvs::core
