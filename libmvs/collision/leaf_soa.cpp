// Boxes of leaves and of their parts, and SIMD tests between two leaves.
#include "collision/leaf_soa.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace mvs::core {
namespace {

double farthest_of(const Vec3 &p, double farthest) {
  return std::max(farthest, p.cwiseAbs().maxCoeff());
}

CornerF corner_f(const Vec3 &p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()), 0};
}

// Sets bit k if entry k of one of the arrays equals one of the values.
template <size_t arrays, size_t values>
uint32_t entries_with(const std::array<Eight<int32_t>, arrays> &entries,
                      const std::array<int32_t, values> &value) {
  uint32_t bits = 0;
  for (uint32_t k = 0; k < SweptAabb8::count; k += Float4::width) {
    Float4::Mask same = {};
    for (const auto &entry : entries) {
      Float4::Mask four;
      std::memcpy(&four, &entry[k], sizeof four);
      for (const int32_t v : value) same |= four == v;
    }
    bits |= bits_of<Float4>(same) << k;
  }
  return bits;
}

uint32_t with_corner(const LeafTriangles &triangles, uint32_t vertex) {
  return entries_with<3, 1>(triangles.corner, {static_cast<int32_t>(vertex)});
}

// The edges that share a node with edge i of `of`.
uint32_t sharing_node(const LeafEdges &edges, const LeafEdges &of, uint32_t i) {
  return entries_with<2, 2>(edges.end, {of.end[0][i], of.end[1][i]});
}

// Tests the edges `of` of eight against eight others. Of the pairs within one eight, each is
// reported once.
void find_edges_of_eight(const LeafEdges &here, uint32_t of, const LeafEdges &there, float margin,
                         std::vector<Edge> &pairs) {
  SweptAabb8::PairBits near;
  for (uint32_t some = find_near(here.box, of, there.box, margin, near); some != 0;
       some &= some - 1) {
    const auto i = static_cast<uint32_t>(std::countr_zero(some));
    uint32_t bits = near[i] & ~sharing_node(there, here, i);
    if (&here == &there) bits &= ~((2u << i) - 1);
    for (; bits != 0; bits &= bits - 1) {
      const uint32_t e = here.id[i], f = there.id[std::countr_zero(bits)];
      pairs.push_back({std::min(e, f), std::max(e, f)});
    }
  }
}

}  // namespace

LeafSoA::LeafSoA(const Model &model, const BvhTopology &bvh, const LeafParts &parts,
                 double contact_distance)
    : model_(&model), vertex_start_{0}, edge_start_{0} {
  double farthest = 0;
  for (const uint32_t v : parts.vertices()) farthest = farthest_of(model.valve.rest[v], farthest);
  rest_margin_ = float_margin(contact_distance, farthest);
  // less the rounding of a difference of two places, of its square and of their sum
  const double near = contact_distance * (1 - 1e-5) - 8 * 0x1p-24 * farthest;
  surely_near2_ = static_cast<float>(near > 0 ? near * near : 0);
  node_.resize(model.node_count());
  triangles_.resize(bvh.leaf_count());
  for (uint32_t leaf = 0; leaf < bvh.leaf_count(); ++leaf) add_leaf(leaf, bvh, parts);
  box_.resize(bvh.leaf_count());
  updated_.assign(bvh.leaf_count(), 0);
  set_motion(model.valve.rest, model.valve.rest, StepMotion::together);
  rest_ = update_all();
}

void LeafSoA::add_leaf(uint32_t leaf, const BvhTopology &bvh, const LeafParts &parts) {
  const auto &rest = model_->valve.rest.get();
  LeafTriangles &own = triangles_[leaf];
  own.id.fill(none);
  for (auto &corner : own.corner) corner.fill(-1);
  for (auto &axis : own.centre) axis.fill(0);
  std::vector<uint32_t> edges;
  for (uint32_t k = bvh.leaf_start[leaf]; k < bvh.leaf_start[leaf + 1]; ++k) {
    const uint32_t i = k - bvh.leaf_start[leaf], t = bvh.order[k];
    const Tri &corners = model_->valve.triangles[t];
    own.id[i] = t;
    const Vec3 centre = (rest[corners[0]] + rest[corners[1]] + rest[corners[2]]) / 3;
    for (uint32_t c = 0; c < 3; ++c) {
      own.corner[c][i] = static_cast<int32_t>(corners[c]);
      own.centre[c][i] = static_cast<float>(centre[c]);
    }
    edges.insert(edges.end(), parts.edges_of(t).begin(), parts.edges_of(t).end());
  }
  add_vertices(leaf, parts);
  add_edges(edges);
}

void LeafSoA::add_vertices(uint32_t leaf, const LeafParts &parts) {
  const auto vertices = parts.vertices_of(leaf);
  for (size_t k = 0; k < vertices.size(); ++k) {
    const size_t i = k % SweptAabb8::count;
    if (i == 0) {
      vertices_.emplace_back().id.fill(none);
      for (auto &axis : vertices_.back().rest) axis.fill(0);
    }
    vertices_.back().id[i] = vertices[k];
    for (uint32_t c = 0; c < 3; ++c) {
      vertices_.back().rest[c][i] = static_cast<float>(model_->valve.rest[vertices[k]][c]);
    }
  }
  vertex_start_.push_back(static_cast<uint32_t>(vertices_.size()));
}

void LeafSoA::add_edges(const std::vector<uint32_t> &edges) {
  for (size_t k = 0; k < edges.size(); ++k) {
    const size_t i = k % SweptAabb8::count;
    if (i == 0) {
      edges_.emplace_back().id.fill(none);
      for (auto &end : edges_.back().end) end.fill(-1);
    }
    edges_.back().id[i] = edges[k];
    for (uint32_t c = 0; c < 2; ++c) {
      edges_.back().end[c][i] = static_cast<int32_t>(model_->topology.edges[edges[k]][c]);
    }
  }
  edge_start_.push_back(static_cast<uint32_t>(edges_.size()));
}

void LeafSoA::set_motion(const std::vector<Vec3> &from, const std::vector<Vec3> &to,
                         StepMotion mode) {
  ++motion_count_;
  mode_ = mode;
  farthest_ = 0;
  for (const LeafVertices &eight : vertices_) {
    for (const uint32_t v : eight.id) {
      if (v == none) break;
      farthest_ = farthest_of(to[v], farthest_of(from[v], farthest_));
      node_[v] = {corner_f(from[v]), corner_f(to[v])};
    }
  }
}

const std::vector<SweptAabbF> &LeafSoA::update_all(Workers *workers) {
  const auto update_part = [&](uint32_t part, uint32_t parts) {
    const uint32_t end = begin_of_part(part + 1, parts, box_.size());
    for (uint32_t leaf = begin_of_part(part, parts, box_.size()); leaf < end; ++leaf) update(leaf);
  };
  if (workers == nullptr) {
    update_part(0, 1);
  } else {
    const uint32_t parts = 2 * workers->width();
    workers->parallel_for(parts, [&](uint32_t part) { update_part(part, parts); });
  }
  return box_;
}

const std::vector<SweptAabbF> &LeafSoA::update_boxes() {
  for (size_t leaf = 0; leaf < box_.size(); ++leaf) {
    box_[leaf] = {};
    for (const uint32_t t : triangles_[leaf].id) {
      if (t == none) break;
      for (const uint32_t i : model_->valve.triangles[t]) box_[leaf].add(node_[i]);
    }
    if (mode_ == StepMotion::independent) box_[leaf].join_ends();
  }
  return box_;
}

template <typename Nodes>
SweptAabbF LeafSoA::swept_box(const Nodes &nodes) const {
  SweptAabbF box;
  for (const uint32_t i : nodes) box.add(node_[i]);
  if (mode_ == StepMotion::independent) box.join_ends();
  return box;
}

void LeafSoA::update_leaf(uint32_t leaf) {
  updated_[leaf] = motion_count_;
  LeafTriangles &own = triangles_[leaf];
  SweptAabbF &all = box_[leaf] = {};
  for (uint32_t i = 0; i < SweptAabb8::count && own.id[i] != none; ++i) {
    const SweptAabbF box = swept_box(model_->valve.triangles[own.id[i]]);
    own.box.set(i, box);
    all.add(box);
  }
  for (uint32_t k = vertex_start_[leaf]; k < vertex_start_[leaf + 1]; ++k) {
    LeafVertices &eight = vertices_[k];
    for (uint32_t i = 0; i < SweptAabb8::count && eight.id[i] != none; ++i) {
      eight.box.set(i, swept_box(std::array<uint32_t, 1>{eight.id[i]}));
    }
  }
  for (uint32_t k = edge_start_[leaf]; k < edge_start_[leaf + 1]; ++k) {
    LeafEdges &eight = edges_[k];
    for (uint32_t i = 0; i < SweptAabb8::count && eight.id[i] != none; ++i) {
      eight.box.set(i, swept_box(model_->topology.edges[eight.id[i]]));
    }
  }
}

// If all of two leaves was surely apart at rest, as two leaflets are, every pair within its barrier
// is a contact pair too, and needs no test of its own.
void LeafSoA::find_pairs(uint32_t a, uint32_t b, float contact, float barrier,
                         FoundPairs &found) const {
  const bool within_barrier = !surely_apart(box_[a], box_[b], barrier);
  const bool tests_barrier = within_barrier && !surely_apart(rest_[a], rest_[b], rest_margin_);
  const float *closer = tests_barrier ? &barrier : nullptr;
  find_triangles(a, b, contact, closer, found.triangles);
  if (a != b) find_triangles(b, a, contact, closer, found.triangles);
  if (within_barrier) find_edges(a, b, barrier, found.edges);
}

void LeafSoA::find_triangles(uint32_t of, uint32_t in, float contact, const float *barrier,
                             std::vector<Edge> &pairs) const {
  for (uint32_t k = vertex_start_[of]; k < vertex_start_[of + 1]; ++k) {
    find_triangles(vertices_[k], in, contact, barrier, pairs);
  }
}

void LeafSoA::find_triangles(const LeafVertices &of, uint32_t in, float contact,
                             const float *barrier, std::vector<Edge> &pairs) const {
  const LeafTriangles &there = triangles_[in];
  SweptAabb8::PairBits near, close;
  uint32_t some = find_near(of.box, box_[in], contact);
  if (some == 0) return;
  some = find_near(of.box, some, there.box, contact, near);
  if (barrier != nullptr) find_near(of.box, some, there.box, *barrier, close);
  for (; some != 0; some &= some - 1) {
    const auto i = static_cast<uint32_t>(std::countr_zero(some));
    uint32_t bits = near[i] & maybe_apart_at_rest(of, i, there);
    if (barrier != nullptr) bits |= close[i];
    if (bits != 0) bits &= ~with_corner(there, of.id[i]);
    for (; bits != 0; bits &= bits - 1) {
      pairs.push_back({of.id[i], there.id[std::countr_zero(bits)]});
    }
  }
}

void LeafSoA::find_edges(uint32_t a, uint32_t b, float margin, std::vector<Edge> &pairs) const {
  for (uint32_t k = edge_start_[a]; k < edge_start_[a + 1]; ++k) {
    const uint32_t of = find_near(edges_[k].box, box_[b], margin);
    if (of == 0) continue;
    for (uint32_t l = a == b ? k : edge_start_[b]; l < edge_start_[b + 1]; ++l) {
      find_edges_of_eight(edges_[k], of, edges_[l], margin, pairs);
    }
  }
}

// Clears the bits of triangles that were surely nearer than the contact distance at rest.
uint32_t LeafSoA::maybe_apart_at_rest(const LeafVertices &of, uint32_t i,
                                      const LeafTriangles &in) const {
  uint32_t bits = 0;
  for (uint32_t k = 0; k < SweptAabb8::count; k += Float4::width) {
    Float4::Value x, y, z;
    load<Float4>(x, &in.centre[0][k]);
    load<Float4>(y, &in.centre[1][k]);
    load<Float4>(z, &in.centre[2][k]);
    x = x - of.rest[0][i];
    y = y - of.rest[1][i];
    z = z - of.rest[2][i];
    bits |= bits_of<Float4>(x * x + y * y + z * z >= surely_near2_) << k;
  }
  return bits;
}

}  // namespace mvs::core
