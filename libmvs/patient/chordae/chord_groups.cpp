// Leaf and head of each chord segment, by the tree of segments.
#include "patient/chordae/chord_groups.h"

#include <algorithm>

namespace mvs::core {
namespace {

const char *word_of(ChordKind kind) {
  switch (kind) {
    case ChordKind::marginal:
      return "marginal";
    case ChordKind::rough_zone:
      return "rough zone";
    case ChordKind::strut:
      return "strut";
    case ChordKind::basal:
      return "basal";
    case ChordKind::commissural:
      return "commissural";
    case ChordKind::trunk:
    case ChordKind::suture:
    case ChordKind::other:
      break;
  }
  return "other";
}

// The first segment that begins (or ends) at a node, or `none`.
uint32_t next_segment(const Model &model, uint32_t node, bool down) {
  for (const uint32_t c : model.topology.node_chords[node]) {
    const Chord &chord = model.valve.chords[c];
    if ((down ? chord.a : chord.b) == node) return c;
  }
  return none;
}

// The last segment on the way down to the leaflet, or up to the head.
uint32_t last_segment(const Model &model, uint32_t chord, bool down) {
  for (size_t steps = 0; steps < model.valve.chords.size(); ++steps) {
    const Chord &here = model.valve.chords[chord];
    const uint32_t end = down ? here.b : here.a;
    if (model.topology.node_kind[end] != NodeKind::branch) break;
    const uint32_t next = next_segment(model, end, down);
    if (next == none) break;
    chord = next;
  }
  return chord;
}

// Name of the head without its number.
std::string muscle_of(const Model &model, uint32_t node) {
  for (const Head &head : model.valve.heads) {
    if (head.node != node) continue;
    std::string name = head.name;
    while (!name.empty() && name.back() >= '0' && name.back() <= '9') name.pop_back();
    return name;
  }
  return "";
}

std::string group_name(const Model &model, uint32_t chord, ChordGrouping grouping) {
  const Chord &leaf = model.valve.chords[last_segment(model, chord, true)];
  const Chord &root = model.valve.chords[last_segment(model, chord, false)];
  std::string name = word_of(leaf.kind);
  const auto triangles = model.topology.node_triangles[leaf.b];
  if (leaf.kind != ChordKind::commissural && !triangles.empty()) {
    name = model.valve.leaflets[model.valve.triangle_leaflet[triangles[0]]].name + " " + name;
  }
  if (grouping == ChordGrouping::halves) name += ", " + muscle_of(model, root.a);
  return name;
}

}  // namespace

std::vector<ChordGroup> chord_groups(const Model &model, ChordGrouping grouping) {
  std::vector<ChordGroup> groups;
  for (uint32_t c = 0; c < model.valve.chords.size(); ++c) {
    if (model.valve.chords[c].kind == ChordKind::suture) continue;
    const std::string name = group_name(model, c, grouping);
    auto group = std::find_if(groups.begin(), groups.end(),
                              [&](const ChordGroup &g) { return g.name == name; });
    if (group == groups.end()) group = groups.insert(groups.end(), ChordGroup{name, {}});
    group->chords.push_back(c);
  }
  return groups;
}

void scale_groups(Valve &valve, const std::vector<ChordGroup> &groups,
                  const std::vector<double> &factor) {
  for (size_t k = 0; k < groups.size(); ++k) {
    for (const uint32_t c : groups[k].chords) valve.chords[c].rest_length *= factor[k];
  }
}

}  // namespace mvs::core
