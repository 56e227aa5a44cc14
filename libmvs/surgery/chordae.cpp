// What the operations on chordae share.
#include "base/error.h"
#include "model/compressed_rows.h"
#include "surgery/surgery.h"

#include <algorithm>

namespace mvs::core {
namespace {

Rows chords_at_nodes(const Valve &valve) {
  std::vector<Edge> ends;
  for (const Chord &chord : valve.chords) ends.push_back({chord.a, chord.b});
  return rows_of(valve.rest.size(), ends);
}

std::vector<uint8_t> kinds_of_nodes(const Valve &valve) {
  std::vector<uint8_t> kind(valve.rest.size(), MVS_NODE_KIND_BRANCH);
  for (const Tri &triangle : valve.triangles) {
    for (const uint32_t node : triangle) kind[node] = MVS_NODE_KIND_LEAFLET;
  }
  for (const Head &head : valve.heads) kind[head.node] = MVS_NODE_KIND_HEAD;
  return kind;
}

// Marks the chords that can be reached from the heads by branch points only.
std::vector<uint8_t> reached_from_heads(const Valve &valve, const Rows &chords_at,
                                        const std::vector<uint8_t> &kind) {
  std::vector<uint8_t> reached(valve.chords.size(), 0);
  std::vector<uint32_t> queue;
  for (uint32_t n = 0; n < kind.size(); ++n) {
    if (kind[n] == MVS_NODE_KIND_HEAD) queue.push_back(n);
  }
  std::vector<uint8_t> seen(kind.size(), 0);
  for (size_t q = 0; q < queue.size(); ++q) {
    for (const uint32_t c : chords_at[queue[q]]) {
      reached[c] = 1;
      const Chord &chord = valve.chords.get()[c];
      const uint32_t other = chord.a == queue[q] ? chord.b : chord.a;
      if (kind[other] != MVS_NODE_KIND_BRANCH || seen[other]) continue;
      seen[other] = 1;
      queue.push_back(other);
    }
  }
  return reached;
}

// Removes chords by marks, keeping the order of the others.
void keep_chords(Valve &valve, const std::vector<uint8_t> &kept) {
  std::vector<Chord> chords;
  for (size_t c = 0; c < kept.size(); ++c) {
    if (kept[c]) chords.push_back(valve.chords.get()[c]);
  }
  valve.chords = std::move(chords);
}

// One round; says whether anything went. A branch that ends in the air is reached from a head and
// not from a leaflet; one that hangs from leaflets only, the other way round.
bool prune_once(Valve &valve) {
  const Rows chords_at = chords_at_nodes(valve);
  const std::vector<uint8_t> kind = kinds_of_nodes(valve);
  const std::vector<uint8_t> from_head = reached_from_heads(valve, chords_at, kind);
  std::vector<uint8_t> kept(valve.chords.size(), 1);
  bool changed = false;
  for (size_t c = 0; c < kept.size(); ++c) {
    const Chord &chord = valve.chords.get()[c];
    if (chord.kind == MVS_CHORD_KIND_SUTURE) continue;
    bool in_the_air = false;
    for (const uint32_t node : {chord.a, chord.b}) {
      in_the_air |= kind[node] == MVS_NODE_KIND_BRANCH && chords_at[node].size() == 1;
    }
    kept[c] = from_head[c] && !in_the_air;
    changed |= !kept[c];
  }
  if (changed) keep_chords(valve, kept);
  return changed;
}

// Length along the chordae from a head to each leaflet node it holds; 0 for others.
std::vector<double> reach_of(const Valve &valve, uint32_t head_node) {
  const Rows chords_at = chords_at_nodes(valve);
  const std::vector<uint8_t> kind = kinds_of_nodes(valve);
  std::vector<double> length(valve.rest.size(), 0);
  std::vector<uint32_t> queue = {head_node};
  for (size_t q = 0; q < queue.size(); ++q) {
    for (const uint32_t c : chords_at[queue[q]]) {
      const Chord &chord = valve.chords.get()[c];
      if (chord.kind == MVS_CHORD_KIND_SUTURE) continue;
      const uint32_t other = chord.a == queue[q] ? chord.b : chord.a;
      if (length[other] > 0 || kind[other] == MVS_NODE_KIND_HEAD) continue;
      length[other] = length[queue[q]] + chord.rest_length;
      if (kind[other] == MVS_NODE_KIND_BRANCH) queue.push_back(other);
    }
  }
  for (size_t n = 0; n < length.size(); ++n) {
    if (kind[n] != MVS_NODE_KIND_LEAFLET) length[n] = 0;
  }
  return length;
}

}  // namespace

void prune_chords(Surgery &s) {
  while (prune_once(s.valve)) {
  }
  const std::vector<uint8_t> kind = kinds_of_nodes(s.valve);
  const Rows chords_at = chords_at_nodes(s.valve);
  std::vector<uint8_t> gone(kind.size(), 0);
  bool any = false;
  for (size_t n = 0; n < gone.size(); ++n) {
    gone[n] = kind[n] == MVS_NODE_KIND_BRANCH && chords_at[n].empty();
    any |= gone[n] != 0;
  }
  if (any) remove_nodes(s, gone);
}

void must_not_be_tied(const Surgery &s, uint32_t a, uint32_t b) {
  for (const Chord &chord : s.valve.chords) {
    const bool same = (chord.a == a && chord.b == b) || (chord.a == b && chord.b == a);
    MVS_MUST(!same, MVS_E_OP, "chord " + chord.name,
             "%s: chord %s joins these two places already: change its length, or choose another "
             "place",
             s.op_name, chord.name.c_str());
  }
}

// The median of five, so that one torn or stretched neighbour does not count.
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
  for (uint32_t number = 1;; ++number) {
    std::string name = scallop + "/" + std::to_string(number);
    const auto taken = [&](const Chord &chord) { return chord.name == name; };
    const std::vector<Chord> &chords = valve.chords;
    if (std::none_of(chords.begin(), chords.end(), taken)) return name;
  }
}

}  // namespace mvs::core
