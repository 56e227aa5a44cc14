// The confidence up to which each finding is doubtful.
#include "patient/doubtful.h"

namespace mvs::core {
namespace {

// Guesses that were right are 40 % and more sure, on generated, real and labelled valves; wrong
// ones were up to 21 %. Given points are 97 to 100 % sure beside a surface that they fit. A closed
// surface 1.45 mm (RMS) from the fitted valve has a third. A mesh has 1, or 0.1 with flat
// triangles. A finding that is there only where something is wrong is doubtful at every confidence.
// Holes that may be notches, second orifices or perforations have a half or less. Crossings that
// moved points by 2.7 mm have a third.
struct Doubt {
  const char *name;
  double guessed, given;
};
constexpr Doubt doubts[] = {
    {"annulus", 0.25, 0.5},      {"commissures", 0.25, 0.5}, {"anterior", 0.25, 0.5},
    {"closed_fit", 0.33, 0.33},  {"shown_gaps", 0.33, 0.33}, {"tall_leaflets", 1, 1},
    {"far_tissue", 1, 1},        {"annulus_length", 1, 1},   {"rough_surface", 1, 1},
    {"leak_at_rest", 1, 1},      {"thin_contact", 1, 1},     {"annulus_motion", 0.1, 0},
    {"closed_annulus", 0.33, 0}, {"papillary_tips", 0, 0.5}, {"filled_holes", 0.5, 0},
    {"mesh", 0.33, 0.33},        {"crossings", 0.33, 0.33}};

}  // namespace

bool is_doubtful(const Finding &finding) {
  for (const Doubt &doubt : doubts) {
    if (finding.name != doubt.name) continue;
    const bool given = finding.source == FindingSource::given;
    return finding.confidence <= (given ? doubt.given : doubt.guessed);
  }
  return false;
}

}  // namespace mvs::core
