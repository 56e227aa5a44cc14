// Functions shared by the operations on chordae: pruning, rest lengths, names.
#include <algorithm>
#include <charconv>

#include "base/error.h"
#include "model/topology.h"
#include "model/valve_arrays.h"
#include "surgery/surgery.h"

namespace mvs::core {
namespace {

std::vector<NodeKind> kinds_of_nodes(const Valve &valve) {
  std::vector<NodeKind> kind(valve.rest.size(), NodeKind::branch);
  for (const Tri &triangle : valve.triangles) {
    for (const uint32_t node : triangle) kind[node] = NodeKind::leaflet;
  }
  for (const Head &head : valve.heads) kind[head.node] = NodeKind::head;
  return kind;
}

// Marks the chords that a search from the heads reaches over branch points.
std::vector<uint8_t> reached_from_heads(const Valve &valve, const Rows &chords_at,
                                        const std::vector<NodeKind> &kind) {
  std::vector<uint8_t> reached(valve.chords.size(), 0);
  std::vector<uint32_t> queue;
  for (uint32_t n = 0; n < kind.size(); ++n) {
    if (kind[n] == NodeKind::head) queue.push_back(n);
  }
  std::vector<uint8_t> seen(kind.size(), 0);
  for (size_t q = 0; q < queue.size(); ++q) {
    for (const uint32_t c : chords_at[queue[q]]) {
      reached[c] = 1;
      const Chord &chord = valve.chords.get()[c];
      const uint32_t other = chord.other_end(queue[q]);
      if (kind[other] != NodeKind::branch || seen[other]) continue;
      seen[other] = 1;
      queue.push_back(other);
    }
  }
  return reached;
}

// One round of pruning; returns whether it removed chords: those that are not reached from a head,
// and those with a branch point that has no other chord.
bool prune_once(Valve &valve) {
  const Rows chords_at = chords_at_nodes(valve);
  const std::vector<NodeKind> kind = kinds_of_nodes(valve);
  const std::vector<uint8_t> from_head = reached_from_heads(valve, chords_at, kind);
  std::vector<uint8_t> removed(valve.chords.size(), 0);
  bool changed = false;
  for (size_t c = 0; c < removed.size(); ++c) {
    const Chord &chord = valve.chords.get()[c];
    if (chord.kind == ChordKind::suture) continue;
    bool has_loose_end = false;
    for (const uint32_t node : {chord.a, chord.b}) {
      has_loose_end |= kind[node] == NodeKind::branch && chords_at[node].size() == 1;
    }
    removed[c] = !from_head[c] || has_loose_end;
    changed |= removed[c] != 0;
  }
  if (changed) remove_rows(valve.chords, removed);
  return changed;
}

// Returns the length along the chordae from a head to each of its leaflet nodes; 0 for other nodes.
std::vector<double> reach_of(const Valve &valve, uint32_t head_node) {
  const Rows chords_at = chords_at_nodes(valve);
  const std::vector<NodeKind> kind = kinds_of_nodes(valve);
  std::vector<double> length(valve.rest.size(), 0);
  std::vector<uint32_t> queue = {head_node};
  for (size_t q = 0; q < queue.size(); ++q) {
    for (const uint32_t c : chords_at[queue[q]]) {
      const Chord &chord = valve.chords.get()[c];
      if (chord.kind == ChordKind::suture) continue;
      const uint32_t other = chord.other_end(queue[q]);
      if (length[other] > 0 || kind[other] == NodeKind::head) continue;
      length[other] = length[queue[q]] + chord.rest_length;
      if (kind[other] == NodeKind::branch) queue.push_back(other);
    }
  }
  for (size_t n = 0; n < length.size(); ++n) {
    if (kind[n] != NodeKind::leaflet) length[n] = 0;
  }
  return length;
}

}  // namespace

void prune_chords(Surgery &s) {
  while (prune_once(s.valve)) {
  }
  const std::vector<NodeKind> kind = kinds_of_nodes(s.valve);
  const Rows chords_at = chords_at_nodes(s.valve);
  std::vector<uint8_t> gone(kind.size(), 0);
  bool any = false;
  for (size_t n = 0; n < gone.size(); ++n) {
    gone[n] = kind[n] == NodeKind::branch && chords_at[n].empty();
    any |= gone[n] != 0;
  }
  if (any) remove_nodes(s, gone);
}

bool has_chord_named(const Surgery &s, const std::string &name) {
  const std::vector<Chord> &chords = s.valve.chords;
  return std::any_of(chords.begin(), chords.end(), [&](const Chord &c) { return c.name == name; });
}

void must_not_be_tied(const Surgery &s, uint32_t a, uint32_t b) {
  for (const Chord &chord : s.valve.chords) {
    const bool same = (chord.a == a && chord.b == b) || (chord.a == b && chord.b == a);
    MVS_MUST(!same, MVS_E_OP, "chord " + chord.name,
             "%s: chord %s joins these two places: change its length, or choose another place",
             s.op_name, chord.name.c_str());
  }
}

// Median of the five nearest, robust against one torn or stretched neighbour.
double length_like_neighbours(const Surgery &s, uint32_t head, uint32_t node) {
  const Valve &valve = s.valve;
  const std::vector<Vec3> &rest = valve.rest;
  const uint32_t from = valve.heads.get()[head].node;
  const std::vector<double> length = reach_of(valve, from);
  struct Neighbour {
    double away, tautness;
  };
  std::vector<Neighbour> all;
  for (size_t n = 0; n < length.size(); ++n) {
    if (length[n] == 0) continue;
    all.push_back({(rest[n] - rest[node]).norm(), length[n] / (rest[n] - rest[from]).norm()});
  }
  const double straight = (rest[node] - rest[from]).norm();
  if (all.empty()) return straight;
  const size_t count = std::min<size_t>(5, all.size());
  std::stable_sort(all.begin(), all.end(),
                   [](const Neighbour &a, const Neighbour &b) { return a.away < b.away; });
  std::sort(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count),
            [](const Neighbour &a, const Neighbour &b) { return a.tautness < b.tautness; });
  return straight * 0.5 * (all[(count - 1) / 2].tautness + all[count / 2].tautness);
}

std::string free_chord_name(const Surgery &s, uint32_t node) {
  const Valve &valve = s.valve;
  std::string scallop = "chord";
  for (size_t t = 0; t < valve.triangles.size(); ++t) {
    const Tri &triangle = valve.triangles.get()[t];
    if (std::find(triangle.begin(), triangle.end(), node) == triangle.end()) continue;
    scallop = valve.scallops.get()[valve.triangle_scallop.get()[t]].name;
    break;
  }
  // above all numbers in use: a removed chord's name in the plan would mislead
  const std::string prefix = scallop + "/";
  uint64_t largest = 0;
  for (const Chord &c : valve.chords.get()) {
    if (!c.name.starts_with(prefix)) continue;
    const char *end = c.name.data() + c.name.size();
    uint64_t number = 0;
    const auto read = std::from_chars(c.name.data() + prefix.size(), end, number);
    if (read.ec == std::errc() && read.ptr == end) largest = std::max(largest, number);
  }
  for (uint64_t number = largest + 1;; ++number) {
    std::string name = prefix + std::to_string(number);
    if (!has_chord_named(s, name)) return name;
  }
}

}  // namespace mvs::core
