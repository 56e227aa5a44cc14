// Uniform 1:4 subdivision of triangles at the midpoints of their sides.
#include "anatomy/refine.h"

#include "base/error.h"
#include "model/valve_arrays.h"

namespace mvs::core {
namespace {

// Largest length of a list (model/checks/check_lists.cpp).
constexpr size_t list_limit = size_t{1} << 24;

template <typename T>
std::vector<T> four_times(const std::vector<T> &rows) {
  std::vector<T> four;
  four.reserve(4 * rows.size());
  for (const T &row : rows) four.insert(four.end(), 4, row);
  return four;
}

// The node at the midpoint of an edge.
uint32_t midpoint_of(const Model &old, size_t edge) {
  return static_cast<uint32_t>(old.node_count() + edge);
}

void add_midpoints(const Model &old, Valve &valve) {
  for (const auto &[a, b] : old.topology.edges) {
    const Vec3 middle = 0.5 * (old.valve.rest[a] + old.valve.rest[b]);
    valve.rest.push_back(middle);
    valve.open.push_back(middle);
    valve.loaded.push_back(middle);
    valve.origin.push_back(none);
  }
}

void split_triangles(const Model &old, Valve &valve) {
  const std::vector<Tri> &coarse = old.valve.triangles;
  std::vector<Tri> triangles;
  triangles.reserve(4 * coarse.size());
  for (size_t t = 0; t < coarse.size(); ++t) {
    const auto &[a, b, c] = coarse[t];
    const Tri &edges = old.topology.triangle_edges[t];
    const uint32_t ab = midpoint_of(old, edges[0]), bc = midpoint_of(old, edges[1]),
                   ca = midpoint_of(old, edges[2]);
    triangles.insert(triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  valve.triangles = std::move(triangles);
  for_each_triangle_array([&](auto array) { valve.*array = four_times((old.valve.*array).get()); });
}

void split_annulus(const Model &old, Valve &valve) {
  const std::vector<uint32_t> &coarse = old.valve.annulus;
  std::vector<uint32_t> annulus;
  for (size_t k = 0; k < coarse.size(); ++k) {
    const uint32_t from = coarse[k], to = coarse[(k + 1) % coarse.size()];
    const uint32_t middle = midpoint_of(old, edge_between(old.topology, from, to));
    valve.open[middle] = 0.5 * (old.valve.open[from] + old.valve.open[to]);
    valve.loaded[middle] = 0.5 * (old.valve.loaded[from] + old.valve.loaded[to]);
    annulus.insert(annulus.end(), {from, middle});
  }
  valve.annulus = std::move(annulus);
}

}  // namespace

Valve refine(const Model &model) {
  const size_t triangles = model.valve.triangles.size();
  MVS_MUST(4 * triangles <= list_limit, MVS_E_ARGUMENT, "triangles",
           "refine: %zu triangles would become %zu, the limit is %zu: this level is the finest",
           triangles, 4 * triangles, list_limit);
  Valve valve = model.valve;
  add_midpoints(model, valve);
  split_triangles(model, valve);
  split_annulus(model, valve);
  return valve;
}

}  // namespace mvs::core
