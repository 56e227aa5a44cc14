// Fixture: random valves at rest under pressure, and random linear functionals of their positions.
#pragma once

#include <cstdint>

#include "anatomy/parametric.h"
#include "measure/tissue/chords.h"
#include "sensitivity/sensitivity.h"
#include "tests/solve/bench.h"

namespace mvs::core::test {

// Some valves do not settle so far: rounding, or a snap on the way.
struct NotAtRest {};

// N; settles end far below it, because Newton converges
inline constexpr double rest_force = 1e-10;

inline State settled(const Model &model, State state) {
  SolveOptions options;
  options.residual = rest_force;
  state.rest_tolerance = 0;
  const SolveStats stats = Solver(Backend::fastest).settle(model, state, options, nullptr);
  if (!stats.converged) throw NotAtRest();
  return state;
}

struct RandomValve {
  ModelPtr model;
  State state;
};

inline RandomValve settled(RandomValve closed) {
  closed.state = settled(*closed.model, closed.state);
  return closed;
}

inline RandomValve closed_valve(Random &random) {
  const LeafletLawId laws[] = {LeafletLawId::bilinear, LeafletLawId::fung,
                               LeafletLawId::may_newman_yin, LeafletLawId::prot,
                               LeafletLawId::spring};
  mvs_parametric_desc desc = {};
  desc.struct_size = sizeof desc;
  desc.vertices = static_cast<uint32_t>(random(200, 400));
  desc.annulus_scale = random(0.9, 1.25);
  if (random(0, 1) < 0.3) desc.shape = MVS_SHAPE_FOUNDING;
  Valve valve = make_parametric_valve(desc);
  const LeafletLawId law = laws[static_cast<size_t>(random(0, 5))];
  for (Leaflet &leaflet : valve.leaflets.edit()) {
    leaflet.law = law;
    leaflet.constants = default_constants(find_leaflet_law(law)->constants);
  }
  // the symmetry of the parametric valve
  for (Chord &chord : valve.chords.edit()) chord.rest_length *= random(0.9, 1.1);
  RandomValve made;
  made.model = make_model(valve);
  State state = initial_state(*made.model);
  state.load = {random(80, 140) * 133.322, 1};
  made.state = settled(*made.model, state);
  return made;
}

// The first valve from a seed on that comes to rest.
inline RandomValve some_valve(Random &random, uint64_t &seed) {
  for (;;) {
    try {
      random = Random(seed++);
      return closed_valve(random);
    } catch (const NotAtRest &) {
    }
  }
}

// A branch point whose chordae bear nothing has no place of its own.
inline bool is_idle(const RandomValve &closed, uint32_t node) {
  if (closed.model->topology.node_kind[node] != NodeKind::branch) return false;
  const ChordMeasures chords = measure_chords(*closed.model, closed.state.x);
  const Rows &rows = closed.model->topology.node_chords;
  for (uint32_t k = rows.start[node]; k < rows.start[node + 1]; ++k) {
    if (chords.tension[rows.items[k]] > 2 * rest_force) return false;
  }
  return true;
}

inline Quantity random_functional(const RandomValve &closed, Random &random) {
  Quantity q;
  q.weights = random.vectors(closed.model->node_count(), 1);
  for (uint32_t i = 0; i < q.weights.size(); ++i) {
    if (is_idle(closed, i)) q.weights[i].setZero();
  }
  return q;
}

}  // namespace mvs::core::test
