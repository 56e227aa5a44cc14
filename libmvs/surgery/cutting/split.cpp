// Splits of sides and triangles; the parts keep leaflet, scallop, thickness and fibre.
#include "surgery/cutting/split.h"

#include "model/valve_arrays.h"

namespace mvs::core {
namespace {

// Adds a triangle with the data of another one.
void add_triangle(Valve &valve, uint32_t like, const Tri &corners) {
  valve.triangles.push_back(corners);
  for_each_triangle_array([&](auto array) {
    auto row = (valve.*array).get()[like];
    (valve.*array).push_back(std::move(row));
  });
}

}  // namespace

uint32_t split_triangle(Surgery &s, uint32_t triangle, const std::array<double, 3> &weight) {
  const Tri tri = s.valve.triangles.get()[triangle];
  const uint32_t node = add_node(s, {tri[0], tri[1], tri[2]}, {weight[0], weight[1], weight[2]});
  s.valve.triangles[triangle] = {tri[0], tri[1], node};
  add_triangle(s.valve, triangle, {tri[1], tri[2], node});
  add_triangle(s.valve, triangle, {tri[2], tri[0], node});
  return node;
}

uint32_t split_side(Surgery &s, uint32_t a, uint32_t b, double share) {
  const uint32_t node = add_node(s, {a, b}, {1 - share, share});
  const size_t count = s.valve.triangles.size();
  for (uint32_t t = 0; t < count; ++t) {
    const Tri old = s.valve.triangles.get()[t];
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t p = old[k], q = old[(k + 1) % 3], r = old[(k + 2) % 3];
      if (!((p == a && q == b) || (p == b && q == a))) continue;
      s.valve.triangles[t] = {p, node, r};
      add_triangle(s.valve, t, {node, q, r});
    }
  }
  return node;
}

}  // namespace mvs::core
