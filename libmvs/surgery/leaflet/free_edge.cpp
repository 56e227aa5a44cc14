// Projection of leaflet nodes onto the free edge, parametrised by arc length.
#include "surgery/leaflet/free_edge.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "geometry/distance.h"
#include "model/seams.h"
#include "surgery/leaflet/sheet_map.h"

namespace mvs::core {
namespace {

// The part of a free edge that belongs to one leaflet.
struct Chain {
  std::vector<uint32_t> nodes;
  std::vector<uint32_t> triangle;  // at each side, one less than nodes; none: across a seam
  std::vector<double> at;          // m from the first node, at rest
};

// Takes a node into a chain. Between the nodes before and after the sides of a seam, which are
// sutured, the free edge has no length.
void append(const Model &model, uint32_t node, uint32_t triangle, Chain &chain) {
  const std::vector<Vec3> &rest = model.valve.rest;
  const double length = triangle == none ? 0 : (rest[node] - rest[chain.nodes.back()]).norm();
  chain.nodes.push_back(node);
  chain.triangle.push_back(triangle);
  chain.at.push_back(chain.at.back() + length);
}

// Returns the longest run of sides of a loop on this leaflet, without those of seams.
Chain chain_of(const Model &model, const std::vector<uint32_t> &loop, uint32_t leaflet,
               const std::vector<uint8_t> &sewn) {
  const size_t n = loop.size();
  std::vector<uint32_t> triangle;
  for (size_t k = 0; k < n; ++k) {
    const uint32_t e = edge_between(model.topology, loop[k], loop[(k + 1) % n]);
    triangle.push_back(model.topology.edge_triangles[e][0]);
  }
  const auto holds = [&](size_t k) {
    return model.valve.triangle_leaflet[triangle[k % n]] == leaflet;
  };
  size_t best = 0, most = 0;
  for (size_t first = 0; first < n; ++first) {
    size_t count = 0;
    while (count < n && holds(first + count)) ++count;
    if (count > most) {
      most = count;
      best = first;
    }
    if (count == n) break;
  }
  Chain chain;
  if (most == 0) return chain;
  bool in_seam = false;
  for (size_t k = best; k <= best + most; ++k) {
    const uint32_t node = loop[k % n];
    if (sewn[node]) {
      in_seam = true;
    } else if (chain.nodes.empty()) {
      chain.nodes = {node};
      chain.at = {0};
      in_seam = false;
    } else {
      append(model, node, in_seam ? none : triangle[(k + n - 1) % n], chain);
      in_seam = false;
    }
  }
  return chain;
}

Chain free_edge_of(const Model &model, uint32_t leaflet) {
  const Seams seams = find_seams(model);
  Chain longest;
  for (const std::vector<uint32_t> &loop : model.topology.free_edges.get()) {
    Chain chain = chain_of(model, loop, leaflet, seams.inside);
    if (!chain.nodes.empty() && (longest.nodes.empty() || chain.at.back() > longest.at.back())) {
      longest = std::move(chain);
    }
  }
  return longest;
}

// Position of the wanted share of the scallop on the chain, and the orientation of the chain: +1 if
// the share increases along it.
struct Origin {
  double at = 0, sense = 1;
  bool found = false;
};

Origin origin_on(const Model &model, const Chain &chain, uint32_t scallop, double share) {
  const SheetMap map(model);
  Origin origin;
  double least = 1e300, growth = 0;
  for (size_t k = 0; k < chain.triangle.size(); ++k) {
    if (chain.triangle[k] == none) continue;
    if (model.valve.triangle_scallop[chain.triangle[k]] != scallop) continue;
    const double a = map.along(scallop, chain.nodes[k]);
    const double b = map.along(scallop, chain.nodes[k + 1]);
    growth += b - a;
    const double t = a != b ? std::clamp((share - a) / (b - a), 0.0, 1.0) : 0;
    const double off = std::abs(a + t * (b - a) - share);
    if (off >= least) continue;
    least = off;
    origin.found = true;
    origin.at = chain.at[k] + t * (chain.at[k + 1] - chain.at[k]);
  }
  origin.sense = growth < 0 ? -1 : 1;
  return origin;
}

EdgeNode seen_from(const Model &model, const Chain &chain, const Origin &origin, uint32_t node) {
  const std::vector<Vec3> &rest = model.valve.rest;
  EdgeNode best{node, 0, 1e300};
  for (size_t k = 0; k + 1 < chain.nodes.size(); ++k) {
    if (chain.triangle[k] == none) continue;
    const Vec3 &a = rest[chain.nodes[k]], &b = rest[chain.nodes[k + 1]];
    const SegmentPoint nearest = closest_on_segment(rest[node], a, b);
    const double depth = std::sqrt(nearest.distance2);
    if (depth >= best.depth) continue;
    best.depth = depth;
    best.along = origin.sense * (chain.at[k] + nearest.s * (b - a).norm() - origin.at);
  }
  return best;
}

}  // namespace

std::vector<EdgeNode> nodes_from_free_edge(const Surgery &s, uint32_t scallop, double share) {
  const Model &model = s.before;
  const Scallop &part = model.valve.scallops[scallop];
  const Chain chain = free_edge_of(model, part.leaflet);
  const Origin origin = origin_on(model, chain, scallop, share);
  MVS_MUST(origin.found, MVS_E_OP, "scallop " + part.name, "%s: scallop %s has no free edge",
           s.op_name, part.name.c_str());
  std::vector<uint8_t> wanted(model.node_count(), 0);
  for (size_t t = 0; t < model.valve.triangles.size(); ++t) {
    if (model.valve.triangle_leaflet[t] != part.leaflet) continue;
    for (const uint32_t node : model.valve.triangles[t]) wanted[node] = 1;
  }
  for (const uint32_t node : model.valve.annulus) wanted[node] = 0;
  std::vector<EdgeNode> nodes;
  for (uint32_t n = 0; n < wanted.size(); ++n) {
    if (wanted[n]) nodes.push_back(seen_from(model, chain, origin, n));
  }
  for (EdgeNode &seen : nodes) {
    // rounding error of the distance of a node on the edge
    if (seen.depth < 1e-12) seen.depth = 0;
  }
  return nodes;
}

}  // namespace mvs::core
