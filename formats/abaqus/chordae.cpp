// Conversion of trusses to cables, with the end nearer a papillary head first.
#include <algorithm>

#include "formats/abaqus/valve.h"
#include "model/compressed_rows.h"

namespace mvs::core {
namespace {

class Network {
 public:
  Network(const InpMesh &mesh, const InpProperties &properties, const InpLoad &load,
          const InpSheet &sheet);

  std::vector<InpCable> cables();
  std::vector<uint32_t> heads() const;
  size_t truss_count() const { return trusses_.size(); }

 private:
  // One truss with its nodes in the order of the file.
  struct Truss {
    Edge nodes;
    uint32_t element, section;
    double length;
  };

  bool is_inner(uint32_t node) const;
  std::vector<uint32_t> chain_from(uint32_t node, uint32_t truss) const;
  void add_chain(uint32_t first, const std::vector<uint32_t> &chain);
  uint32_t other_end(uint32_t truss, uint32_t node) const;

  const InpMesh &mesh_;
  const InpSheet &sheet_;
  std::vector<Truss> trusses_;
  std::vector<uint8_t> is_head_;
  Rows at_;  // trusses of each node
  std::vector<uint8_t> taken_;
  std::set<Edge> joined_;
  std::vector<InpCable> cables_;
};

Network::Network(const InpMesh &mesh, const InpProperties &properties, const InpLoad &load,
                 const InpSheet &sheet)
    : mesh_(mesh), sheet_(sheet), is_head_(mesh.nodes.size(), 0) {
  for (uint32_t s = 0; s < properties.trusses.size(); ++s) {
    for (const uint32_t e : properties.trusses[s].elements) {
      const Edge nodes = {mesh.elements[e].nodes[0], mesh.elements[e].nodes[1]};
      trusses_.push_back({nodes, e, s, (mesh.nodes[nodes[1]].x - mesh.nodes[nodes[0]].x).norm()});
    }
  }
  std::sort(trusses_.begin(), trusses_.end(),
            [](const Truss &l, const Truss &r) { return l.element < r.element; });
  std::vector<Edge> ends;
  for (const Truss &truss : trusses_) {
    if (truss.nodes[0] == truss.nodes[1]) {
      inp_fail(mesh.elements[truss.element].line, "truss %llu joins a node with itself",
               static_cast<unsigned long long>(mesh.elements[truss.element].number));
    }
    ends.push_back(truss.nodes);
    for (const uint32_t node : truss.nodes) {
      is_head_[node] = !sheet.holds[node] && load.moved.contains(node);
    }
  }
  at_ = rows_of(mesh.nodes.size(), ends);
  taken_.assign(trusses_.size(), 0);
}

uint32_t Network::other_end(uint32_t truss, uint32_t node) const {
  const Edge &nodes = trusses_[truss].nodes;
  return nodes[0] == node ? nodes[1] : nodes[0];
}

// Returns whether a node only joins two segments of the same cable.
bool Network::is_inner(uint32_t node) const {
  const std::span<const uint32_t> around = at_[node];
  return !sheet_.holds[node] && !is_head_[node] && around.size() == 2 &&
         trusses_[around[0]].section == trusses_[around[1]].section;
}

// Follows the trusses from the end node of a cable to its other end.
std::vector<uint32_t> Network::chain_from(uint32_t node, uint32_t truss) const {
  std::vector<uint32_t> chain = {truss};
  for (node = other_end(truss, node); is_inner(node); node = other_end(truss, node)) {
    const std::span<const uint32_t> around = at_[node];
    truss = around[0] == truss ? around[1] : around[0];
    chain.push_back(truss);
  }
  return chain;
}

// A second cable between the same ends, or a closed one, keeps its inner nodes, because the ends of
// a chord identify it.
void Network::add_chain(uint32_t first, const std::vector<uint32_t> &chain) {
  uint32_t last = first;
  double length = 0;
  for (const uint32_t truss : chain) {
    last = other_end(truss, last);
    length += trusses_[truss].length;
    taken_[truss] = 1;
  }
  const Edge ends = {std::min(first, last), std::max(first, last)};
  const Truss &truss = trusses_[chain[0]];
  if (first != last && joined_.insert(ends).second) {
    cables_.push_back({first, last, length, truss.section, truss.element});
    return;
  }
  uint32_t node = first;
  for (const uint32_t t : chain) {
    const uint32_t next = other_end(t, node);
    cables_.push_back({node, next, trusses_[t].length, trusses_[t].section, trusses_[t].element});
    node = next;
  }
}

std::vector<uint32_t> Network::heads() const {
  std::vector<uint32_t> heads;
  for (uint32_t node = 0; node < is_head_.size(); ++node) {
    if (is_head_[node]) heads.push_back(node);
  }
  return heads;
}

// Breadth-first distance of each node from a head, in cables; `none` if unreachable. Paths stop at
// the sheet.
std::vector<uint32_t> distances(const std::vector<InpCable> &cables,
                                const std::vector<uint32_t> &heads, const InpSheet &sheet) {
  std::vector<Edge> ends;
  ends.reserve(cables.size());
  for (const InpCable &cable : cables) ends.push_back({cable.a, cable.b});
  const Rows at = rows_of(sheet.holds.size(), ends);
  std::vector<uint32_t> distance(sheet.holds.size(), none), queue = heads;
  for (const uint32_t head : heads) distance[head] = 0;
  for (size_t q = 0; q < queue.size(); ++q) {
    const uint32_t node = queue[q];
    if (sheet.holds[node]) continue;
    for (const uint32_t c : at[node]) {
      const uint32_t other = cables[c].a == node ? cables[c].b : cables[c].a;
      if (distance[other] != none) continue;
      distance[other] = distance[node] + 1;
      queue.push_back(other);
    }
  }
  return distance;
}

void turn_from_heads(std::vector<InpCable> &cables, const std::vector<uint32_t> &heads,
                     const InpSheet &sheet) {
  const std::vector<uint32_t> distance = distances(cables, heads, sheet);
  const auto rank = [&](uint32_t node) {
    return std::make_tuple(static_cast<bool>(sheet.holds[node]), distance[node], node);
  };
  for (InpCable &cable : cables) {
    if (rank(cable.b) < rank(cable.a)) std::swap(cable.a, cable.b);
  }
}

std::vector<InpCable> Network::cables() {
  for (uint32_t t = 0; t < trusses_.size(); ++t) {
    for (const uint32_t node : trusses_[t].nodes) {
      if (!taken_[t] && !is_inner(node)) add_chain(node, chain_from(node, t));
    }
  }
  const auto round = std::find(taken_.begin(), taken_.end(), 0);
  if (round != taken_.end()) {
    const InpElement &element =
        mesh_.elements[trusses_[static_cast<size_t>(round - taken_.begin())].element];
    inp_fail(element.line,
             "truss %llu is part of a chain that ends nowhere: chordae lead from papillary heads, "
             "whose nodes have a *BOUNDARY, to the leaflets",
             static_cast<unsigned long long>(element.number));
  }
  return std::move(cables_);
}

}  // namespace

InpChordae make_inp_chordae(const InpMesh &mesh, const InpProperties &properties,
                            const InpLoad &load, const InpSheet &sheet, InpNotes &notes) {
  Network network(mesh, properties, load, sheet);
  InpChordae chordae{network.cables(), network.heads()};
  turn_from_heads(chordae.cables, chordae.heads, sheet);
  size_t slack = 0;
  double longest = 0;
  for (const InpCable &cable : chordae.cables) {
    const double distance = (mesh.nodes[cable.b].x - mesh.nodes[cable.a].x).norm();
    const double share = cable.rest_length / distance - 1;
    slack += share > 1e-6;
    longest = std::max(longest, share);
  }
  if (network.truss_count() > 0) {
    notes.counted("%zu trusses are %zu cables, %zu of them slack by up to %.3g %%",
                  network.truss_count(), chordae.cables.size(), slack, 100 * longest);
  }
  return chordae;
}

}  // namespace mvs::core
