// The layout of a session, once for both directions: an archive writes what it is given, or fills
// it. FORMAT.md says the same in words; a change of it is a new version of the format.
#pragma once

#include <concepts>

#include "history/history.h"

namespace mvs::core {

// Version 1 had springs with three constants, linear chordae and no curves; up to version 2 there
// were no tools, and steps had no budget; up to version 3 no steps were led, and a step left
// nothing to the next; up to version 4 a chord kept its length when it went to another head.
inline constexpr uint32_t session_version = 5;

template <typename T, typename Plain>
concept Is = std::same_as<std::remove_const_t<T>, Plain>;

template <typename Archive>
void pass(Archive &a, Is<Leaflet> auto &leaflet) {
  a.word(leaflet.id);
  a.text(leaflet.name);
  a.word(leaflet.law);
  a.number(leaflet.thickness);
  const size_t known = a.version() == 1 ? 3 : leaflet.constants.size();
  for (size_t k = 0; k < known; ++k) a.number(leaflet.constants[k]);
}

template <typename Archive>
void pass(Archive &a, Is<Scallop> auto &scallop) {
  a.word(scallop.id);
  a.text(scallop.name);
  a.word(scallop.leaflet);
}

template <typename Archive>
void pass(Archive &a, Is<Chord> auto &chord) {
  a.word(chord.id);
  a.text(chord.name);
  a.word(chord.a);
  a.word(chord.b);
  a.word(chord.kind);
  a.word(chord.law);
  a.number(chord.rest_length);
  a.number(chord.young);
  a.number(chord.area);
  if (a.version() == 1) return;
  for (auto &constant : chord.constants) a.number(constant);
}

template <typename Archive>
void pass(Archive &a, Is<ChordCurve> auto &curve) {
  a.word(curve.id);
  a.text(curve.name);
  a.array(curve.points);
}

template <typename Archive>
void pass(Archive &a, Is<Head> auto &head) {
  a.word(head.id);
  a.text(head.name);
  a.word(head.node);
}

template <typename Archive>
void pass(Archive &a, Is<Ring> auto &ring) {
  a.word(ring.id);
  a.text(ring.name);
  a.word(ring.kind);
  a.array(ring.curve);
}

template <typename Archive>
void pass(Archive &a, Is<Valve> auto &valve) {
  a.text(valve.name);
  a.word(valve.next_id);
  a.number(valve.density);
  a.number(valve.contact_thickness);
  a.number(valve.contact_stiffness);
  a.number(valve.bending_scale);
  a.array(valve.rest);
  a.array(valve.open);
  a.array(valve.loaded);
  a.array(valve.origin);
  a.array(valve.triangles);
  a.array(valve.triangle_leaflet);
  a.array(valve.triangle_scallop);
  a.array(valve.triangle_thickness);
  a.array(valve.triangle_fibre);
  a.array(valve.annulus);
  a.list(valve.leaflets);
  a.list(valve.scallops);
  a.list(valve.chords);
  a.list(valve.heads);
  a.list(valve.rings);
  if (a.version() > 1) a.list(valve.curves);
}

template <typename Archive>
void pass(Archive &a, Is<Tool> auto &tool) {
  a.word(tool.id);
  a.word(tool.kind);
  a.word(tool.node);
  a.number(tool.radius);
  a.number(tool.length);
  a.number(tool.stiffness);
  a.number(tool.max_force);
  for (auto *v : {&tool.position, &tool.axis, &tool.proxy[0], &tool.proxy[1]}) {
    for (int k = 0; k < 3; ++k) a.number((*v)[k]);
  }
}

template <typename Archive>
void pass(Archive &a, Is<SolverCache> auto &cache) {
  a.array(cache.data);
  if (cache.data.empty()) return;
  a.word(cache.version);
  a.word(cache.counter);
}

template <typename Archive>
void pass(Archive &a, Is<State> auto &state) {
  a.array(state.x);
  a.array(state.v);
  a.number(state.time);
  a.word(state.steps);
  a.number(state.load.pressure);
  a.number(state.load.boundary_fraction);
  if (a.version() < 3) return;
  a.list(state.tools);
  a.word(state.tools_made);
  if (a.version() < 4) return;
  pass(a, state.cache);
}

template <typename Archive>
void pass(Archive &a, Is<ModelState> auto &current) {
  a.model(current.model);
  pass(a, current.state);
  a.check(current);
}

template <typename Archive>
void pass(Archive &a, Is<RecordedEvent> auto &move) {
  a.choice(move.kind);
  a.word(move.solver);
  a.word(move.max_iterations);
  a.word(move.count);
  a.number(move.pressure);
  a.number(move.boundary_fraction);
  a.number(move.residual);
  a.number(move.dt);
  a.number(move.damping);
  if (a.version() > 2) {
    a.word(move.budget);
    a.list(move.tool);
  }
  if (a.version() > 3) {
    a.array(move.way);
    a.array(move.pace);
  }
  a.check(move);
}

// Behind the operation of an entry, which cannot be made empty and filled.
template <typename Archive>
void pass_rest(Archive &a, Is<HistoryEntry> auto &entry) {
  a.text(entry.title);
  a.word(entry.made);
  a.word(entry.group);
  a.text(entry.group_name);
  a.word(entry.time_ms);
  a.stack(entry.moves);
  pass(a, entry.before);
  pass(a, entry.after);
}

template <typename Archive>
void pass(Archive &a, Is<Checkpoint> auto &checkpoint) {
  a.text(checkpoint.name);
  pass(a, checkpoint.at);
  a.stack(checkpoint.past);
  a.stack(checkpoint.future);
  a.stack(checkpoint.moves);
}

template <typename Archive>
void pass(Archive &a, Is<Snapshot> auto &snapshot) {
  pass(a, snapshot.current);
  a.optional(snapshot.history.start);
  a.stack(snapshot.history.past);
  a.stack(snapshot.history.future);
  a.stack(snapshot.history.moves);
  a.optional(snapshot.history.checkpoints);
  a.word(snapshot.history.next_group);
}

}  // namespace mvs::core
