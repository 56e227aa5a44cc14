// Strain, tension and working range of each chord from the positions of its ends.
#include "measure/tissue/chords.h"

#include <mvs/snapshot.h>

#include <algorithm>
#include <limits>

#include "model/chord_law.h"

namespace mvs::core {
namespace {

// Sum of the tensions at a node, each directed towards the other end of its chord.
Vec3 pull_on(uint32_t node, const Model &model, const std::vector<Vec3> &x,
             const std::vector<double> &tension) {
  const Rows &rows = model.topology.node_chords;
  Vec3 sum = Vec3::Zero();
  for (uint32_t i = rows.start[node]; i < rows.start[node + 1]; ++i) {
    const Chord &chord = model.valve.chords[rows.items[i]];
    const Vec3 along = x[chord.other_end(node)] - x[node];
    sum += tension[rows.items[i]] * along.normalized();
  }
  return sum;
}

// Flags of the limits that a chord exceeds.
uint8_t flags_of(const Chord &chord, double strain, double tension) {
  const ChordLimits limits = chord_limits(chord.kind);
  uint8_t flags = 0;
  if (strain > limits.strain) flags |= MVS_CHORD_FLAG_OVER_STRAIN;
  if (tension > limits.tension) flags |= MVS_CHORD_FLAG_OVER_TENSION;
  return flags;
}

}  // namespace

ChordLimits chord_limits(ChordKind kind) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  // working strain 4.3 +- 3.4 %: mean and two standard deviations
  constexpr double strain = 0.111;
  if (kind == ChordKind::suture) return {infinite, infinite};
  // twice the working tension: strut about 1 N, others up to 0.4 N; a trunk carries several
  if (kind == ChordKind::strut || kind == ChordKind::trunk) return {strain, 2.0};
  return {strain, 0.8};
}

ChordMeasures measure_chords(const Model &model, const std::vector<Vec3> &x) {
  ChordMeasures measures;
  for (const Chord &chord : model.valve.chords) {
    const double strain =
        ((x[chord.b] - x[chord.a]).norm() - chord.rest_length) / chord.rest_length;
    const double tension = chord_tension(model.valve, chord, strain);
    measures.strain.push_back(strain);
    measures.tension.push_back(tension);
    measures.flags.push_back(flags_of(chord, strain, tension));
    measures.over_strain += (measures.flags.back() & MVS_CHORD_FLAG_OVER_STRAIN) != 0;
    measures.over_tension += (measures.flags.back() & MVS_CHORD_FLAG_OVER_TENSION) != 0;
    if (chord.kind == ChordKind::suture) continue;  // stitches are no chordae
    measures.max_strain = std::max(measures.max_strain, strain);
    measures.max_tension = std::max(measures.max_tension, tension);
  }
  for (const Head &head : model.valve.heads) {
    measures.head_force.push_back(pull_on(head.node, model, x, measures.tension));
  }
  return measures;
}

}  // namespace mvs::core
