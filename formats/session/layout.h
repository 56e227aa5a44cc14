// The layout of a session, once for both directions: pass(archive, value) writes the fields of a
// value or reads them, depending on the archive. FORMAT.md describes the same layout.
#pragma once

#include <array>
#include <concepts>

#include "base/error.h"
#include "history/history.h"

namespace mvs::core {

// A file of another version is refused.
inline constexpr uint32_t session_version = 1;

template <typename T, typename Plain>
concept Is = std::same_as<std::remove_const_t<T>, Plain>;

template <typename Archive>
void pass(Archive &a, Is<Leaflet> auto &leaflet) {
  a.word(leaflet.id);
  a.text(leaflet.name);
  a.word(leaflet.law);
  a.number(leaflet.thickness);
  for (auto &constant : leaflet.constants) a.number(constant);
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
  a.list(valve.curves);
}

template <typename Archive>
void pass(Archive &a, Is<ToolBody> auto &body) {
  a.word(body.kind);
  a.number(body.radius);
  a.array(body.vertices);
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
  if (tool.kind != ToolKind::convex) return;
  for (auto *v : {&tool.proxy[2], &tool.proxy[3]}) {
    for (int k = 0; k < 3; ++k) a.number((*v)[k]);
  }
  a.shape(tool.shape);
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
  a.number(state.rest_tolerance);
  a.list(state.tools);
  a.word(state.tools_made);
  pass(a, state.cache);
}

template <typename Archive>
void pass(Archive &a, Is<ModelState> auto &current) {
  a.model(current.model);
  pass(a, current.state);
  a.check(current);
}

template <typename Archive>
void pass(Archive &a, Is<RecordedEvent> auto &event) {
  a.choice(event.kind);
  a.word(event.solver);
  a.word(event.max_iterations);
  a.word(event.count);
  a.number(event.pressure);
  a.number(event.boundary_fraction);
  a.number(event.residual);
  a.number(event.dt);
  a.number(event.damping);
  a.word(event.budget);
  a.list(event.tools);
  a.array(event.points);
  a.array(event.steps_per_row);
  a.check(event);
}

template <typename T, typename Byte>
auto &field_at(Byte *at) {
  return *reinterpret_cast<std::conditional_t<std::is_const_v<Byte>, const T, T> *>(at);
}

// A field of an operation, by its type and its address in the struct.
template <typename Archive, typename Byte>
void pass_field(Archive &a, const OpField &f, Byte *at) {
  switch (f.type) {
    case MVS_FIELD_NUMBER:
      return a.number(field_at<double>(at));
    case MVS_FIELD_COUNT:
    case MVS_FIELD_CHOICE:
      return a.word(field_at<uint32_t>(at));
    case MVS_FIELD_CHORD:
    case MVS_FIELD_HEAD:
    case MVS_FIELD_SCALLOP:
      return a.word(field_at<mvs_id>(at));
    case MVS_FIELD_SITE: {
      auto &site = field_at<mvs_site>(at);
      a.word(site.how);
      a.word(site.index);
      a.word(site.scallop);
      for (auto &u : site.u) a.number(u);
      return;
    }
    case MVS_FIELD_POINT:
      for (auto &x : field_at<mvs_point>(at).at) a.number(x);
      return a.word(field_at<mvs_point>(at).given);
    case MVS_FIELD_VECTOR:
      for (auto &x : field_at<std::array<double, 3>>(at)) a.number(x);
      return;
    case MVS_FIELD_POINTS:
      return a.points(field_at<mvs_array>(at));
    case MVS_FIELD_TEXT:
      return a.optional_text(field_at<const char *>(at));
    default:
      fail(MVS_E_INTERNAL, f.name, "a session cannot store field %s", f.name);
  }
}

// The fields after the operation of an entry, which has no empty value to read into.
template <typename Archive>
void pass_rest(Archive &a, Is<HistoryEntry> auto &entry) {
  a.text(entry.title);
  a.word(entry.made);
  a.word(entry.group);
  a.text(entry.group_name);
  a.word(entry.time_ms);
  a.list(entry.events);
  pass(a, entry.before);
  pass(a, entry.after);
}

template <typename Archive>
void pass(Archive &a, Is<Checkpoint> auto &checkpoint) {
  a.text(checkpoint.name);
  pass(a, checkpoint.at);
  a.list(checkpoint.past);
  a.list(checkpoint.future);
  a.list(checkpoint.events);
}

template <typename Archive>
void pass(Archive &a, Is<Snapshot> auto &snapshot) {
  pass(a, snapshot.current);
  a.optional(snapshot.history.start);
  a.list(snapshot.history.past);
  a.list(snapshot.history.future);
  a.list(snapshot.history.events);
  a.optional(snapshot.history.checkpoints);
  a.word(snapshot.history.next_group);
}

}  // namespace mvs::core
