// The children of a triangle: its three corners with the middles of their sides, and the middles.
#include "anatomy/refine.h"

#include <algorithm>

#include "base/error.h"

namespace mvs::core {
namespace {

// What a list of a valve may hold (model/check_lists.cpp).
constexpr size_t list_limit = size_t{1} << 24;

template <typename T>
std::vector<T> four_times(const std::vector<T> &rows) {
  std::vector<T> four;
  four.reserve(4 * rows.size());
  for (const T &row : rows) four.insert(four.end(), 4, row);
  return four;
}

class Refiner {
 public:
  explicit Refiner(const Model &model) : old_(model), valve_(model.valve) {}

  Valve run() {
    add_middles();
    cut_triangles();
    cut_annulus();
    return std::move(valve_);
  }

 private:
  uint32_t middle_of(size_t edge) const { return static_cast<uint32_t>(old_.node_count() + edge); }

  void add_middles() {
    for (const auto &[a, b] : old_.topology.edges) {
      const Vec3 middle = 0.5 * (old_.valve.rest[a] + old_.valve.rest[b]);
      valve_.rest.push_back(middle);
      valve_.open.push_back(middle);
      valve_.loaded.push_back(middle);
      valve_.origin.push_back(none);
    }
  }

  void cut_triangles() {
    const std::vector<Tri> &old = old_.valve.triangles;
    std::vector<Tri> triangles;
    triangles.reserve(4 * old.size());
    for (size_t t = 0; t < old.size(); ++t) {
      const auto &[a, b, c] = old[t];
      const Tri &edges = old_.topology.triangle_edges[t];
      const uint32_t ab = middle_of(edges[0]), bc = middle_of(edges[1]), ca = middle_of(edges[2]);
      triangles.insert(triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    valve_.triangles = std::move(triangles);
    valve_.triangle_leaflet = four_times(old_.valve.triangle_leaflet.get());
    valve_.triangle_scallop = four_times(old_.valve.triangle_scallop.get());
    valve_.triangle_thickness = four_times(old_.valve.triangle_thickness.get());
    valve_.triangle_fibre = four_times(old_.valve.triangle_fibre.get());
  }

  void cut_annulus() {
    const std::vector<uint32_t> &old = old_.valve.annulus;
    const std::vector<Edge> &edges = old_.topology.edges;
    std::vector<uint32_t> annulus;
    for (size_t k = 0; k < old.size(); ++k) {
      const uint32_t from = old[k], to = old[(k + 1) % old.size()];
      const Edge side = {std::min(from, to), std::max(from, to)};
      const auto edge = std::lower_bound(edges.begin(), edges.end(), side) - edges.begin();
      const uint32_t middle = middle_of(static_cast<size_t>(edge));
      valve_.open[middle] = 0.5 * (old_.valve.open[from] + old_.valve.open[to]);
      valve_.loaded[middle] = 0.5 * (old_.valve.loaded[from] + old_.valve.loaded[to]);
      annulus.insert(annulus.end(), {from, middle});
    }
    valve_.annulus = std::move(annulus);
  }

  const Model &old_;
  Valve valve_;
};

}  // namespace

Valve refine(const Model &model) {
  const size_t triangles = model.valve.triangles.size();
  MVS_MUST(4 * triangles <= list_limit, MVS_E_ARGUMENT, "triangles",
           "refine: %zu triangles would become %zu, the limit is %zu: this level is the finest",
           triangles, 4 * triangles, list_limit);
  return Refiner(model).run();
}

}  // namespace mvs::core
