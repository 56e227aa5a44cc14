// Chordae from their end points.
#include "measure/chords.h"

#include <algorithm>

#include "model/law.h"

namespace mvs {
namespace {

// The sum of the pulls on a node, each along its chord towards the other end.
Vec3 pull_on(uint32_t node, const Model &model, const std::vector<Vec3> &x,
             const std::vector<double> &tension) {
  const Rows &rows = model.topology.node_chords;
  Vec3 sum = Vec3::Zero();
  for (uint32_t i = rows.start[node]; i < rows.start[node + 1]; ++i) {
    const Chord &chord = model.valve.chords[rows.items[i]];
    const Vec3 along = x[chord.a == node ? chord.b : chord.a] - x[node];
    sum += tension[rows.items[i]] * along.normalized();
  }
  return sum;
}

}  // namespace

ChordMeasures measure_chords(const Model &model, const std::vector<Vec3> &x) {
  ChordMeasures measures;
  for (const Chord &chord : model.valve.chords) {
    const double strain =
        ((x[chord.b] - x[chord.a]).norm() - chord.rest_length) / chord.rest_length;
    const double tension = chord_tension(chord.stiffness(), strain);
    measures.strain.push_back(strain);
    measures.tension.push_back(tension);
    measures.max_strain = std::max(measures.max_strain, strain);
    measures.max_tension = std::max(measures.max_tension, tension);
  }
  for (const Head &head : model.valve.heads) {
    measures.head_force.push_back(pull_on(head.node, model, x, measures.tension));
  }
  return measures;
}

}  // namespace mvs
