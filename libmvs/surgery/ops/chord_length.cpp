// Operation chord_length: changes the rest length of a chord.
#include <cmath>

#include "base/error.h"
#include "surgery/surgery.h"

namespace mvs::core {
namespace {

// Returns the rest length at which the chord, with its present stretch, ends where its leaflet end
// was dragged to.
double dragged_length(const Surgery &s, const Chord &chord, const mvs_point &to) {
  const Vec3 target(to.at[0], to.at[1], to.at[2]);
  const std::vector<Vec3> &x = s.state.x;
  const double now = (x[chord.b] - x[chord.a]).norm();
  const double stretch = std::max(now / chord.rest_length, 1.0);
  const double length = (target - x[chord.a]).norm() / stretch;
  MVS_MUST(length >= 1e-4 && length <= 0.2, MVS_E_OP, "chord " + chord.name,
           "chord_length: chord %s would be %g m long where it was dragged to: 1e-4 to 0.2 m are "
           "possible",
           chord.name.c_str(), length);
  return length;
}

}  // namespace

void operate(Surgery &s, const mvs_op_chord_length &op) {
  Chord &chord = s.valve.chords[chord_of(s, op.chord)];
  const int given = (op.length != 0) + (op.factor != 0) + (op.drag_to.given != 0);
  MVS_MUST(
      given == 1, MVS_E_ARGUMENT, "chord " + chord.name,
      "chord_length: chord %s is given %d of length, factor and drag_to: exactly one is needed",
      chord.name.c_str(), given);
  const double before = chord.rest_length;
  double length = op.length != 0 ? op.length : op.factor * before;
  if (op.drag_to.given) length = dragged_length(s, chord, op.drag_to);
  MVS_MUST(length >= 1e-4 && length <= 0.2, MVS_E_OP, "chord " + chord.name,
           "chord_length: chord %s would be %g m long: 1e-4 to 0.2 m are possible",
           chord.name.c_str(), length);
  chord.rest_length = length;
  s.title = format("%s chord %s to %.1f mm (%.0f %%)", length < before ? "Shorten" : "Lengthen",
                   chord.name.c_str(), 1e3 * length, 100 * length / before);
}

}  // namespace mvs::core
