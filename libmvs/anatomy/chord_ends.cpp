// Breadth-first searches over chord segments, from all heads down and from each chord both ways.
#include "anatomy/chord_ends.h"

#include <algorithm>
#include <map>

namespace mvs::core {
namespace {

// Chord segments as a graph.
class ChordTree {
 public:
  explicit ChordTree(const Model &model);

  // The nodes above (up) or below a chord with its own end there: along segments that lead towards,
  // or away from, the heads.
  std::vector<uint32_t> reached(const Chord &chord, bool up) const;

 private:
  bool is_sheet(uint32_t node) const {
    const NodeKind kind = model_->topology.node_kind[node];
    return kind == NodeKind::leaflet || kind == NodeKind::annulus;
  }
  template <typename Visit>
  void for_each_neighbour(uint32_t node, Visit visit) const {
    for (const uint32_t c : model_->topology.node_chords[node]) {
      const Chord &chord = model_->valve.chords[c];
      visit(chord.a == node ? chord.b : chord.a);
    }
  }

  const Model *model_;
  std::vector<uint32_t> depth_;  // segments from the nearest head to each node; `none`: no head
};

ChordTree::ChordTree(const Model &model) : model_(&model), depth_(model.node_count(), none) {
  std::vector<uint32_t> queue;
  for (const Head &head : model.valve.heads) {
    depth_[head.node] = 0;
    queue.push_back(head.node);
  }
  for (size_t k = 0; k < queue.size(); ++k) {
    const uint32_t here = queue[k];
    if (is_sheet(here)) continue;
    for_each_neighbour(here, [&](uint32_t next) {
      if (depth_[next] != none) return;
      depth_[next] = depth_[here] + 1;
      queue.push_back(next);
    });
  }
}

std::vector<uint32_t> ChordTree::reached(const Chord &chord, bool up) const {
  const auto is_further = [&](uint32_t a, uint32_t b) {
    return up ? depth_[a] < depth_[b] : depth_[a] > depth_[b];
  };
  std::vector<uint32_t> queue;
  const auto add = [&](uint32_t node) {
    if (std::find(queue.begin(), queue.end(), node) == queue.end()) queue.push_back(node);
  };
  if (!is_further(chord.b, chord.a)) add(chord.a);
  if (!is_further(chord.a, chord.b)) add(chord.b);
  for (size_t k = 0; k < queue.size(); ++k) {
    const uint32_t here = queue[k];
    if (is_sheet(here)) continue;
    for_each_neighbour(here, [&](uint32_t next) {
      if (is_further(next, here)) add(next);
    });
  }
  return queue;
}

// The part of a scallop in the triangles around a node. Of equal counts the larger area wins: the
// order of scallops would treat the two sides of a symmetric valve differently.
struct Vote {
  uint32_t triangles = 0;
  double area = 0;

  bool operator<(const Vote &other) const {
    return triangles != other.triangles ? triangles < other.triangles : area < other.area;
  }
};

// The scallop of each node that holds a chord: its index, by node.
std::map<uint32_t, uint32_t> scallops_of_nodes(const Model &model) {
  const Valve &valve = model.valve;
  std::map<uint32_t, uint32_t> found;
  for (uint32_t node = 0; node < model.node_count(); ++node) {
    if (model.topology.node_chords[node].empty()) continue;
    std::vector<Vote> votes(valve.scallops.size());
    for (const uint32_t t : model.topology.node_triangles[node]) {
      Vote &vote = votes[valve.triangle_scallop[t]];
      ++vote.triangles;
      vote.area += model.rest_area[t];
    }
    const auto most = std::max_element(votes.begin(), votes.end());
    if (most != votes.end() && most->triangles > 0) {
      found[node] = static_cast<uint32_t>(most - votes.begin());
    }
  }
  return found;
}

// Joins the names of the parts at these nodes, each once, in the order of the parts.
template <typename Parts>
std::string joined(const Parts &parts, const std::map<uint32_t, uint32_t> &part_of_node,
                   const std::vector<uint32_t> &nodes) {
  std::vector<uint8_t> there(parts.size());
  for (const uint32_t node : nodes) {
    const auto at = part_of_node.find(node);
    if (at != part_of_node.end()) there[at->second] = 1;
  }
  std::string out;
  for (size_t k = 0; k < parts.size(); ++k) {
    if (there[k]) out += (out.empty() ? "" : "+") + parts[k].name;
  }
  return out;
}

}  // namespace

ChordEnds find_chord_ends(const Model &model) {
  const Valve &valve = model.valve;
  const ChordTree tree(model);
  const std::map<uint32_t, uint32_t> scallops = scallops_of_nodes(model);
  std::map<uint32_t, uint32_t> heads;
  for (uint32_t h = 0; h < valve.heads.size(); ++h) heads[valve.heads[h].node] = h;
  ChordEnds ends;
  for (const Chord &chord : valve.chords) {
    ends.heads.push_back(joined(valve.heads, heads, tree.reached(chord, true)));
    ends.scallops.push_back(joined(valve.scallops, scallops, tree.reached(chord, false)));
  }
  return ends;
}

}  // namespace mvs::core
