#include "collision/leaf_soa.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace mvs::core {
namespace {

double farthest_of(const Vec3 &p, double farthest) {
  return std::max(farthest, p.cwiseAbs().maxCoeff());
}

CornerF to_corner(const Vec3 &p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()), 0};
}

// Bit k: lane k of one of some is the same as one of the values.
template <size_t some, size_t values>
uint32_t lanes_with(const std::array<std::array<int32_t, SweptAabb8::count>, some> &lanes,
                    const std::array<int32_t, values> &value) {
  uint32_t bits = 0;
  for (uint32_t k = 0; k < SweptAabb8::count; k += simd_width) {
    SimdMask same = {};
    for (const auto &one : lanes) {
      for (const int32_t v : value) same |= load_simd(&one[k]) == v;
    }
    bits |= bits_of(same) << k;
  }
  return bits;
}

// Calls visit(first, count) for eight after eight of some, the rest last.
template <typename Items, typename Visit>
void by_eight(const Items &items, Visit &&visit) {
  for (size_t k = 0; k < items.size(); k += SweptAabb8::count) {
    visit(k, std::min<size_t>(SweptAabb8::count, items.size() - k));
  }
}

}  // namespace

LeafSoA::LeafSoA(const Model &model, const SweptBvh &tree, const LeafParts &parts, double apart)
    : model_(&model), vertex_start_{0}, edge_start_{0} {
  double farthest = 0;
  for (const uint32_t v : parts.vertices()) farthest = farthest_of(model.valve.rest[v], farthest);
  rest_margin_ = float_margin(apart, farthest);
  // of a difference of two places, and its square and sum
  const double near = apart * (1 - 1e-5) - 8 * 0x1p-24 * farthest;
  surely_near2_ = static_cast<float>(near > 0 ? near * near : 0);
  node_.resize(model.node_count());
  triangles_.resize(tree.block_count());
  for (uint32_t block = 0; block < tree.block_count(); ++block) add_block(block, tree, parts);
  way_.resize(tree.block_count());
  placed_.assign(tree.block_count(), 0);
  begin(model.valve.rest, model.valve.rest, StepMotion::together);
  rest_ = place_all();
}

void LeafSoA::add_block(uint32_t block, const SweptBvh &tree, const LeafParts &parts) {
  const auto &rest = model_->valve.rest.get();
  Triangles &own = triangles_[block];
  own.id.fill(none);
  for (auto &corner : own.corner) corner.fill(-1);
  for (auto &axis : own.centre) axis.fill(0);
  std::vector<uint32_t> edges;
  for (uint32_t k = tree.block_start()[block]; k < tree.block_start()[block + 1]; ++k) {
    const uint32_t lane = k - tree.block_start()[block], t = tree.triangles()[k];
    const Tri &corners = model_->valve.triangles[t];
    own.id[lane] = t;
    const Vec3 centre = (rest[corners[0]] + rest[corners[1]] + rest[corners[2]]) / 3;
    for (uint32_t c = 0; c < 3; ++c) {
      own.corner[c][lane] = static_cast<int32_t>(corners[c]);
      own.centre[c][lane] = static_cast<float>(centre[c]);
    }
    edges.insert(edges.end(), parts.edges_of(t).begin(), parts.edges_of(t).end());
  }
  const auto vertices = parts.vertices_of(block);
  by_eight(vertices, [&](size_t first, size_t count) {
    Vertices &eight = vertices_.emplace_back();
    eight.id.fill(none);
    for (auto &axis : eight.rest) axis.fill(0);
    for (size_t lane = 0; lane < count; ++lane) {
      const uint32_t v = eight.id[lane] = vertices[first + lane];
      for (uint32_t c = 0; c < 3; ++c) eight.rest[c][lane] = static_cast<float>(rest[v][c]);
    }
  });
  by_eight(edges, [&](size_t first, size_t count) {
    Edges &eight = edges_.emplace_back();
    eight.id.fill(none);
    for (auto &end : eight.end) end.fill(-1);
    for (size_t lane = 0; lane < count; ++lane) {
      const uint32_t e = eight.id[lane] = edges[first + lane];
      for (uint32_t c = 0; c < 2; ++c) {
        eight.end[c][lane] = static_cast<int32_t>(model_->topology.edges[e][c]);
      }
    }
  });
  vertex_start_.push_back(static_cast<uint32_t>(vertices_.size()));
  edge_start_.push_back(static_cast<uint32_t>(edges_.size()));
}

void LeafSoA::begin(const std::vector<Vec3> &from, const std::vector<Vec3> &to, StepMotion pace) {
  ++round_;
  pace_ = pace;
  farthest_ = 0;
  for (const Vertices &eight : vertices_) {
    for (const uint32_t v : eight.id) {
      if (v == none) break;
      farthest_ = farthest_of(to[v], farthest_of(from[v], farthest_));
      node_[v] = {to_corner(from[v]), to_corner(to[v])};
    }
  }
}

const std::vector<SweptAabbF> &LeafSoA::place_all() {
  for (uint32_t block = 0; block < way_.size(); ++block) place(block);
  return way_;
}

const std::vector<SweptAabbF> &LeafSoA::place_boxes() {
  for (size_t block = 0; block < way_.size(); ++block) {
    way_[block] = {};
    for (const uint32_t t : triangles_[block].id) {
      if (t == none) break;
      for (const uint32_t i : model_->valve.triangles[t]) way_[block].add(node_[i]);
    }
    if (pace_ == StepMotion::independent) way_[block].join_ends();
  }
  return way_;
}

template <typename Nodes>
SweptAabbF LeafSoA::narrow(const Nodes &nodes) const {
  SweptAabbF way;
  for (const uint32_t i : nodes) way.add(node_[i]);
  if (pace_ == StepMotion::independent) way.join_ends();
  return way;
}

void LeafSoA::place_block(uint32_t block) {
  placed_[block] = round_;
  Triangles &own = triangles_[block];
  SweptAabbF &all = way_[block] = {};
  for (uint32_t lane = 0; lane < SweptAabb8::count && own.id[lane] != none; ++lane) {
    const SweptAabbF way = narrow(model_->valve.triangles[own.id[lane]]);
    own.way.set(lane, way);
    all.add(way);
  }
  for (uint32_t k = vertex_start_[block]; k < vertex_start_[block + 1]; ++k) {
    Vertices &eight = vertices_[k];
    for (uint32_t lane = 0; lane < SweptAabb8::count && eight.id[lane] != none; ++lane) {
      eight.way.set(lane, narrow(std::array<uint32_t, 1>{eight.id[lane]}));
    }
  }
  for (uint32_t k = edge_start_[block]; k < edge_start_[block + 1]; ++k) {
    Edges &eight = edges_[k];
    for (uint32_t lane = 0; lane < SweptAabb8::count && eight.id[lane] != none; ++lane) {
      eight.way.set(lane, narrow(model_->topology.edges[eight.id[lane]]));
    }
  }
}

// Where all of two blocks was surely apart at rest, as leaflets are, what is within a guard faces,
// too.
void LeafSoA::meet(uint32_t a, uint32_t b, float facing, float guard, std::vector<Edge> &triangles,
                   std::vector<Edge> &edges) const {
  const bool within_guard = !surely_apart(way_[a], way_[b], guard);
  const bool asks_guard = within_guard && !surely_apart(rest_[a], rest_[b], rest_margin_);
  const float *closer = asks_guard ? &guard : nullptr;
  near_vertices(a, b, facing, closer, triangles);
  if (a != b) near_vertices(b, a, facing, closer, triangles);
  if (within_guard) near_edges(a, b, guard, edges);
}

void LeafSoA::near_vertices(uint32_t of, uint32_t in, float facing, const float *guard,
                            std::vector<Edge> &pairs) const {
  for (uint32_t k = vertex_start_[of]; k < vertex_start_[of + 1]; ++k) {
    near_vertices(vertices_[k], in, facing, guard, pairs);
  }
}

void LeafSoA::near_vertices(const Vertices &of, uint32_t in, float facing, const float *guard,
                            std::vector<Edge> &pairs) const {
  const Triangles &there = triangles_[in];
  LaneMasks near, close;
  uint32_t some = find_near(of.way, way_[in], facing);
  if (some == 0) return;
  some = find_near(of.way, some, there.way, facing, near);
  if (guard != nullptr) find_near(of.way, some, there.way, *guard, close);
  for (; some != 0; some &= some - 1) {
    const auto k = static_cast<uint32_t>(std::countr_zero(some));
    uint32_t lanes = near[k] & maybe_apart(of, k, there);
    if (guard != nullptr) lanes |= close[k];
    if (lanes != 0) lanes &= ~with_corner(there, of.id[k]);
    for (; lanes != 0; lanes &= lanes - 1) {
      pairs.push_back({of.id[k], there.id[std::countr_zero(lanes)]});
    }
  }
}

void LeafSoA::near_edges(uint32_t a, uint32_t b, float margin, std::vector<Edge> &pairs) const {
  for (uint32_t k = edge_start_[a]; k < edge_start_[a + 1]; ++k) {
    const uint32_t of = find_near(edges_[k].way, way_[b], margin);
    if (of == 0) continue;
    for (uint32_t l = a == b ? k : edge_start_[b]; l < edge_start_[b + 1]; ++l) {
      near_edges(edges_[k], of, edges_[l], margin, pairs);
    }
  }
}

// Of the lanes `of` of one; with itself, each pair comes once.
void LeafSoA::near_edges(const Edges &here, uint32_t of, const Edges &there, float margin,
                         std::vector<Edge> &pairs) {
  LaneMasks near;
  for (uint32_t some = find_near(here.way, of, there.way, margin, near); some != 0;
       some &= some - 1) {
    const auto i = static_cast<uint32_t>(std::countr_zero(some));
    uint32_t lanes = near[i] & ~sharing(there, here, i);
    if (&here == &there) lanes &= ~((2u << i) - 1);
    for (; lanes != 0; lanes &= lanes - 1) {
      const uint32_t e = here.id[i], f = there.id[std::countr_zero(lanes)];
      pairs.push_back({std::min(e, f), std::max(e, f)});
    }
  }
}

uint32_t LeafSoA::with_corner(const Triangles &triangles, uint32_t vertex) {
  return lanes_with<3, 1>(triangles.corner, {static_cast<int32_t>(vertex)});
}

uint32_t LeafSoA::sharing(const Edges &edges, const Edges &of, uint32_t lane) {
  return lanes_with<2, 2>(edges.end, {of.end[0][lane], of.end[1][lane]});
}

// The lanes that are not surely near at rest.
uint32_t LeafSoA::maybe_apart(const Vertices &of, uint32_t lane, const Triangles &in) const {
  uint32_t bits = 0;
  for (uint32_t k = 0; k < SweptAabb8::count; k += simd_width) {
    const SimdFloat x = load_simd(&in.centre[0][k]) - of.rest[0][lane];
    const SimdFloat y = load_simd(&in.centre[1][k]) - of.rest[1][lane];
    const SimdFloat z = load_simd(&in.centre[2][k]) - of.rest[2][lane];
    bits |= bits_of(x * x + y * y + z * z >= surely_near2_) << k;
  }
  return bits;
}

}  // namespace mvs::core
