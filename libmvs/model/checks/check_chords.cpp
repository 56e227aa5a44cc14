// Checks the nodes that chordae and papillary heads join.
#include <algorithm>

#include "model/checks/checks.h"
#include "model/topology.h"

namespace mvs::core {
namespace {

enum Role : uint8_t { role_branch, role_sheet, role_head };

std::string chord_part(const Valve &valve, size_t c) {
  return part_name("chord", valve.chords[c].name, c);
}

std::vector<uint8_t> roles_of(const Valve &valve, const Sheet &sheet, Faults &faults) {
  std::vector<uint8_t> role(valve.rest.size(), role_branch);
  for (size_t n = 0; n < role.size(); ++n) {
    if (sheet.is_vertex[n]) role[n] = role_sheet;
  }
  for (size_t h = 0; h < valve.heads.size(); ++h) {
    const uint32_t node = valve.heads[h].node;
    const std::string part = format("papillary head %zu", h);
    if (role[node] == role_sheet) {
      faults.add(part, "papillary head %zu is node %u of the sheet: give it a node of its own", h,
                 node);
    } else if (role[node] == role_head) {
      faults.add(part, "papillary head %zu is at node %u, which is another head", h, node);
    } else {
      role[node] = role_head;
    }
  }
  return role;
}

void check_chord_ends(const Valve &valve, const std::vector<uint8_t> &role, size_t c,
                      Faults &faults) {
  const Chord &chord = valve.chords[c];
  const std::string part = chord_part(valve, c);
  if (chord.a == chord.b) {
    faults.add(part, "%s leads from node %u to itself", part.c_str(), chord.a);
  } else if (role[chord.a] == role_head && role[chord.b] == role_head) {
    faults.add(part, "%s joins two papillary heads: it has to lead to the sheet", part.c_str());
  } else if (chord.kind == ChordKind::suture &&
             (role[chord.a] != role_sheet || role[chord.b] != role_sheet)) {
    faults.add(part, "%s is a suture: it has to join two nodes of the sheet", part.c_str());
  } else if (chord.kind != ChordKind::suture && role[chord.a] == role_sheet &&
             role[chord.b] == role_sheet) {
    faults.add(part, "%s joins two nodes of the sheet: it has to lead to a papillary head",
               part.c_str());
  } else if ((valve.rest[chord.a] - valve.rest[chord.b]).norm() < 1e-8) {
    faults.add(part, "%s has no length: its nodes %u and %u lie at the same place", part.c_str(),
               chord.a, chord.b);
  }
}

void check_duplicate_chords(const Valve &valve, Faults &faults) {
  struct Ends {
    Edge nodes;
    size_t chord;
  };
  std::vector<Ends> ends;
  for (size_t c = 0; c < valve.chords.size(); ++c) {
    const auto [low, high] = std::minmax(valve.chords[c].a, valve.chords[c].b);
    ends.push_back({{low, high}, c});
  }
  std::sort(ends.begin(), ends.end(), [](const Ends &l, const Ends &r) {
    return l.nodes != r.nodes ? l.nodes < r.nodes : l.chord < r.chord;
  });
  for (size_t k = 1; k < ends.size(); ++k) {
    if (ends[k].nodes != ends[k - 1].nodes) continue;
    const std::string part = chord_part(valve, ends[k].chord);
    faults.add(part, "%s joins the same nodes as %s: remove one, or add up their areas",
               part.c_str(), chord_part(valve, ends[k - 1].chord).c_str());
  }
}

// Breadth-first search from chord `first` over branch nodes; reports a tree that reaches no
// papillary head or no leaflet.
void visit_tree(const Valve &valve, const std::vector<uint8_t> &role, const Rows &chords_at,
                size_t first, std::vector<uint8_t> &visited, Faults &faults) {
  std::vector<uint32_t> queue = {static_cast<uint32_t>(first)};
  visited[first] = 1;
  bool reached[3] = {false, false, false};
  for (size_t q = 0; q < queue.size(); ++q) {
    for (const uint32_t node : {valve.chords[queue[q]].a, valve.chords[queue[q]].b}) {
      reached[role[node]] = true;
      if (role[node] != role_branch) continue;
      for (const uint32_t c : chords_at[node]) {
        if (visited[c]) continue;
        visited[c] = 1;
        queue.push_back(c);
      }
    }
  }
  // a chord without a branch node is checked in check_chord_ends
  if (!reached[role_branch]) return;
  const std::string part = chord_part(valve, first);
  if (!reached[role_head]) {
    faults.add(part, "%s and what it branches into reach no papillary head", part.c_str());
  }
  if (!reached[role_sheet]) {
    faults.add(part, "%s and what it branches into reach no leaflet", part.c_str());
  }
}

void check_branch_nodes(const std::vector<uint8_t> &role, const Rows &chords_at, Faults &faults) {
  for (uint32_t n = 0; n < role.size(); ++n) {
    if (role[n] != role_branch) continue;
    const size_t count = chords_at[n].size();
    if (count == 0) {
      faults.add(format("node %u", n),
                 "node %u belongs to no triangle, chord or papillary head: remove it", n);
    } else if (count == 1) {
      faults.add(format("node %u", n),
                 "%s ends at node %u, which is neither sheet nor papillary head",
                 format("chord %u", chords_at[n][0]).c_str(), n);
    }
  }
}

}  // namespace

void check_chords(const Valve &valve, const Sheet &sheet, Faults &faults) {
  const std::vector<uint8_t> role = roles_of(valve, sheet, faults);
  for (size_t c = 0; c < valve.chords.size(); ++c) {
    check_chord_ends(valve, role, c, faults);
  }
  check_duplicate_chords(valve, faults);
  const Rows chords_at = chords_at_nodes(valve);
  std::vector<uint8_t> visited(valve.chords.size(), 0);
  for (size_t c = 0; c < valve.chords.size(); ++c) {
    if (!visited[c]) visit_tree(valve, role, chords_at, c, visited, faults);
  }
  check_branch_nodes(role, chords_at, faults);
}

}  // namespace mvs::core
