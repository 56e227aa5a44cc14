// Keeping near pairs.
#include "physics/near_pairs.h"

#include <algorithm>
#include <cmath>

#include "base/distance.h"
#include "base/sheet_tree.h"
#include "physics/contact.h"

namespace mvs {
namespace {

// Of the contact thickness: how far a node may be from where it was last looked at. More, and more
// pairs are kept than can act; less, and nodes come up more often.
constexpr double skin = 0.25;
constexpr double calm = 0.2;  // of the skin: half ways up to there need no thicker one
// Of the skin: what there has to be beside a calm way for lists to be worth it.
constexpr double least_room = 0.25;
constexpr double many_fast = 0.25;  // of the nodes: where more are, the whole sheet is looked at
// So many nodes in turn are looked at, of those that have used up that much of their room.
constexpr size_t turns = 8;
constexpr double worn = 0.3;

bool has(const Tri &t, uint32_t node) {
  return t[0] == node || t[1] == node || t[2] == node;
}

double rest_distance(const Valve &valve, uint32_t v, const Tri &t) {
  const auto &x = valve.rest.get();
  return std::sqrt(closest_on_triangle(x[v], x[t[0]], x[t[1]], x[t[2]]).distance2);
}

template <typename Box>
bool near(const Box &a, const Box &b, double margin) {
  for (size_t k = 0; k < 3; ++k) {
    if (a.low[k] - b.high[k] > margin || b.low[k] - a.high[k] > margin) return false;
  }
  return true;
}

// The largest squared distance of a point in one from a point in the other.
template <typename Box>
double farthest2(const Box &a, const Box &b) {
  double sum = 0;
  for (size_t k = 0; k < 3; ++k) {
    const double way = std::max(a.high[k] - b.low[k], b.high[k] - a.low[k]);
    sum += way * way;
  }
  return sum;
}

template <typename Box, typename Nodes>
Box box_around(const Nodes &nodes, const std::vector<Vec3> &x, double more) {
  Box box;
  for (size_t k = 0; k < 3; ++k) box.low[k] = box.high[k] = x[nodes[0]][static_cast<int>(k)];
  for (const uint32_t i : nodes) {
    for (size_t k = 0; k < 3; ++k) {
      const double at = x[i][static_cast<int>(k)];
      box.low[k] = std::min(box.low[k], at);
      box.high[k] = std::max(box.high[k], at);
    }
  }
  for (size_t k = 0; k < 3; ++k) {
    box.low[k] -= more;
    box.high[k] += more;
  }
  return box;
}

template <typename Box>
Box both(const Box &a, const Box &b) {
  Box box;
  for (size_t k = 0; k < 3; ++k) {
    box.low[k] = std::min(a.low[k], b.low[k]);
    box.high[k] = std::max(a.high[k], b.high[k]);
  }
  return box;
}

bool before(const NearTriangle &p, const NearTriangle &q) {
  return p.vertex != q.vertex ? p.vertex < q.vertex : p.triangle < q.triangle;
}

bool before(const NearEdges &p, const NearEdges &q) {
  return p.first != q.first ? p.first < q.first : p.second < q.second;
}

// Sorts what is new into what there is, in the memory of `spare`.
template <typename Pairs>
void sort_in(Pairs &pairs, Pairs &fresh, Pairs &spare) {
  const auto less = [](const auto &p, const auto &q) { return before(p, q); };
  std::sort(fresh.begin(), fresh.end(), less);
  spare.resize(pairs.size() + fresh.size());
  std::merge(pairs.begin(), pairs.end(), fresh.begin(), fresh.end(), spare.begin(), less);
  pairs.swap(spare);
}

}  // namespace

NearPairs::NearPairs(const Model &model)
    : model_(&model),
      thickness_(model.valve.contact_thickness),
      skin_(skin * model.valve.contact_thickness),
      calm_(calm * skin_) {
  const Valve &valve = model.valve;
  const auto &triangles = valve.triangles.get();
  moved_.assign(model.node_count(), 0);
  triangle_moved_.assign(triangles.size(), 0);
  edge_moved_.assign(model.topology.edges.size(), 0);
  edge_box_.resize(edge_moved_.size());
  std::vector<uint8_t> edge_taken(edge_moved_.size(), 0), vertex_taken(model.node_count(), 0);
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    vertex_start_.push_back(static_cast<uint32_t>(owned_vertex_.size()));
    edge_start_.push_back(static_cast<uint32_t>(owned_edge_.size()));
    for (const uint32_t v : triangles[t]) {
      if (!vertex_taken[v]) owned_vertex_.push_back(v);
      vertex_taken[v] = 1;
    }
    for (const uint32_t e : model.topology.triangle_edges[t]) {
      if (!edge_taken[e]) owned_edge_.push_back(e);
      edge_taken[e] = 1;
    }
  }
  vertex_start_.push_back(static_cast<uint32_t>(owned_vertex_.size()));
  edge_start_.push_back(static_cast<uint32_t>(owned_edge_.size()));
  for (const SheetBranch &b : sheet_tree(valve.rest, triangles)) {
    tree_.push_back({{}, {}, false, b.right, b.after, b.triangle});
    if (b.right != none) continue;
    for (uint32_t k = vertex_start_[b.triangle]; k < vertex_start_[b.triangle + 1]; ++k) {
      sheet_.push_back(owned_vertex_[k]);
    }
  }
  for (size_t i = tree_.size(); i-- > 0;) {
    Branch &b = tree_[i];
    b.rest = b.right == none ? box_around<Box>(triangles[b.triangle], valve.rest.get(), 0)
                             : both(tree_[i + 1].rest, tree_[b.right].rest);
  }
  // as much as a closed valve keeps, so that a live step seldom allocates
  for (auto *pairs : {&triangles_, &new_triangles_, &all_triangles_}) {
    pairs->reserve(8 * sheet_.size());
  }
  for (auto *pairs : {&edges_, &new_edges_, &all_edges_}) pairs->reserve(4 * edge_moved_.size());
}

bool NearPairs::follow(const std::vector<Vec3> &middle, const std::vector<Vec3> &half,
                       double slack) {
  const double room = skin_ * (1 - 1e-9) - calm_ - slack;  // so that rounding does not count
  if (!(room > least_room * skin_) || too_fast(half)) return false;
  if (!find_moved(middle, half, room)) return true;
  move_boxes();
  forget_moved();
  find_facing();
  find_guarded();
  merge();
  return true;
}

// What a node on its way wants of its skin above skin_.
double NearPairs::wanted(const Vec3 &half) const {
  const double square = half.squaredNorm();
  return square <= calm_ * calm_ ? 0 : std::sqrt(square) - calm_;
}

bool NearPairs::too_fast(const std::vector<Vec3> &half) const {
  size_t fast = 0;
  for (const uint32_t i : sheet_) fast += !(half[i].squaredNorm() <= calm_ * calm_);
  return static_cast<double>(fast) > many_fast * static_cast<double>(sheet_.size());
}

// Marks the nodes to be looked at again and takes their places.
bool NearPairs::find_moved(const std::vector<Vec3> &middle, const std::vector<Vec3> &half,
                           double room) {
  const bool first = place_.empty();
  if (first) {
    place_ = middle;
    extra_.assign(middle.size(), 0);
  }
  bool any = first;
  const auto quota = static_cast<uint32_t>(sheet_.size() / turns);
  for (uint32_t k = 0; k < sheet_.size(); ++k) {
    const uint32_t i = sheet_[k];
    const bool its_turn = (k + sheet_.size() - turn_) % sheet_.size() < quota;
    const double used = its_turn ? worn * room : room, more = wanted(half[i]);
    const bool fits = more <= extra_[i] && (!its_turn || extra_[i] <= 2 * more);
    // not a number is far from anywhere
    moved_[i] = first || !fits || !((middle[i] - place_[i]).squaredNorm() <= used * used);
    if (!moved_[i]) continue;
    place_[i] = middle[i];
    extra_[i] = 1.5 * more;
    any = true;
  }
  if (!sheet_.empty()) turn_ = (turn_ + quota) % static_cast<uint32_t>(sheet_.size());
  return any;
}

template <typename Nodes>
double NearPairs::extra_of(const Nodes &nodes) const {
  double most = 0;
  for (const uint32_t i : nodes) most = std::max(most, extra_[i]);
  return most;
}

template <typename Nodes>
NearPairs::Box NearPairs::box_of(const Nodes &nodes) const {
  return box_around<Box>(nodes, place_, extra_of(nodes));
}

void NearPairs::move_boxes() {
  const auto &triangles = model_->valve.triangles.get();
  const auto &edges = model_->topology.edges.get();
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    const auto [i, j, k] = triangles[t];
    triangle_moved_[t] = moved_[i] | moved_[j] | moved_[k];
  }
  for (uint32_t e = 0; e < edges.size(); ++e) {
    edge_moved_[e] = moved_[edges[e][0]] | moved_[edges[e][1]];
    if (edge_moved_[e]) edge_box_[e] = box_of(edges[e]);
  }
  for (size_t i = tree_.size(); i-- > 0;) {
    Branch &b = tree_[i];
    const bool leaf = b.right == none;
    b.moved = leaf ? triangle_moved_[b.triangle] : tree_[i + 1].moved || tree_[b.right].moved;
    if (!b.moved) continue;
    b.box = leaf ? box_of(triangles[b.triangle]) : both(tree_[i + 1].box, tree_[b.right].box);
  }
}

void NearPairs::forget_moved() {
  std::erase_if(triangles_, [&](const NearTriangle &p) {
    return moved_[p.vertex] || triangle_moved_[p.triangle];
  });
  std::erase_if(edges_,
                [&](const NearEdges &p) { return edge_moved_[p.first] || edge_moved_[p.second]; });
}

// Visits the pairs of triangles below a branch that are within a margin of each other and of which
// one has moved, but for those below branches to skip.
template <typename Skip, typename Visit>
void NearPairs::within(uint32_t i, double margin, const Skip &skip, const Visit &visit) const {
  const Branch &b = tree_[i];
  if (b.right == none || !b.moved || skip(b, b)) return;
  within(i + 1, margin, skip, visit);
  within(b.right, margin, skip, visit);
  between(i + 1, b.right, margin, skip, visit);
}

template <typename Skip, typename Visit>
void NearPairs::between(uint32_t i, uint32_t j, double margin, const Skip &skip,
                        const Visit &visit) const {
  const Branch &a = tree_[i], &b = tree_[j];
  if ((!a.moved && !b.moved) || !near(a.box, b.box, margin) || skip(a, b)) return;
  if (a.right == none && b.right == none) {
    visit(a.triangle, b.triangle);
  } else if (b.right == none || (a.right != none && a.after - i >= b.after - j)) {
    between(i + 1, j, margin, skip, visit);
    between(a.right, j, margin, skip, visit);
  } else {
    between(i, j + 1, margin, skip, visit);
    between(i, b.right, margin, skip, visit);
  }
}

// What was near in the rest shape does not face: whole patches of sheet are skipped.
void NearPairs::find_facing() {
  new_triangles_.clear();
  if (tree_.empty()) return;
  const double needed = facing_rest_distance * thickness_;
  const auto skip = [&](const Branch &a, const Branch &b) {
    return farthest2(a.rest, b.rest) < needed * needed;
  };
  within(0, thickness_ + 2 * skin_, skip, [&](uint32_t a, uint32_t b) {
    take_facing(a, b);
    take_facing(b, a);
  });
}

void NearPairs::find_guarded() {
  new_edges_.clear();
  if (tree_.empty()) return;
  within(
      0, guard_share * thickness_ + 2 * skin_, [](const Branch &, const Branch &) { return false; },
      [&](uint32_t a, uint32_t b) {
        take_guarded(a, b);
        take_guarded(b, a);
        take_edges(a, b);
      });
}

void NearPairs::take_facing(uint32_t owner, uint32_t triangle) {
  const Tri &t = model_->valve.triangles[triangle];
  const double skins = 2 * skin_ + extra_of(t);
  for (uint32_t k = vertex_start_[owner]; k < vertex_start_[owner + 1]; ++k) {
    const uint32_t v = owned_vertex_[k];
    if ((!moved_[v] && !triangle_moved_[triangle]) || has(t, v)) continue;
    const auto p = closest_on_triangle(place_[v], place_[t[0]], place_[t[1]], place_[t[2]]);
    const double longest = thickness_ + skins + extra_[v];
    if (p.distance2 > longest * longest || !apart_at_rest(v, triangle)) continue;
    new_triangles_.push_back({v, triangle, guard_share * thickness_, true});
  }
}

void NearPairs::take_guarded(uint32_t owner, uint32_t triangle) {
  const Tri &t = model_->valve.triangles[triangle];
  const double skins = 2 * skin_ + extra_of(t);
  for (uint32_t k = vertex_start_[owner]; k < vertex_start_[owner + 1]; ++k) {
    const uint32_t v = owned_vertex_[k];
    if ((!moved_[v] && !triangle_moved_[triangle]) || has(t, v)) continue;
    const auto p = closest_on_triangle(place_[v], place_[t[0]], place_[t[1]], place_[t[2]]);
    const double distance = std::sqrt(p.distance2) - skins - extra_[v];
    if (distance > guard_share * thickness_ || apart_at_rest(v, triangle)) continue;
    const double guard = guard_range(thickness_, rest_distance(model_->valve, v, t));
    if (distance <= guard) new_triangles_.push_back({v, triangle, guard, false});
  }
}

void NearPairs::take_edges(uint32_t a, uint32_t b) {
  for (uint32_t k = edge_start_[a]; k < edge_start_[a + 1]; ++k) {
    for (uint32_t l = edge_start_[b]; l < edge_start_[b + 1]; ++l) {
      const auto [i, j] = std::minmax(owned_edge_[k], owned_edge_[l]);
      take_edge_pair(i, j);
    }
  }
}

// The lower one first: the rounding of their distance depends on it.
void NearPairs::take_edge_pair(uint32_t i, uint32_t j) {
  const double longest = guard_share * thickness_;
  if (!edge_moved_[i] && !edge_moved_[j]) return;
  const Edge &e = model_->topology.edges[i], &f = model_->topology.edges[j];
  if (e[0] == f[0] || e[0] == f[1] || e[1] == f[0] || e[1] == f[1]) return;
  if (!near(edge_box_[i], edge_box_[j], longest + 2 * skin_)) return;
  const auto p = closest_of_segments(place_[e[0]], place_[e[1]], place_[f[0]], place_[f[1]]);
  const double distance = std::sqrt(p.distance2) - 2 * skin_ - extra_of(e) - extra_of(f);
  if (distance > longest) return;
  const auto &rest = model_->valve.rest.get();
  const auto r = closest_of_segments(rest[e[0]], rest[e[1]], rest[f[0]], rest[f[1]]);
  const double guard = guard_range(thickness_, std::sqrt(r.distance2));
  if (distance <= guard) new_edges_.push_back({i, j, guard});
}

bool NearPairs::apart_at_rest(uint32_t vertex, uint32_t triangle) const {
  const Tri &t = model_->valve.triangles[triangle];
  return rest_distance(model_->valve, vertex, t) >= facing_rest_distance * thickness_;
}

void NearPairs::merge() {
  sort_in(triangles_, new_triangles_, all_triangles_);
  sort_in(edges_, new_edges_, all_edges_);
}

}  // namespace mvs
