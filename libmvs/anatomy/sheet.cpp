// Meshes half a parametric valve: a coarse grid, remeshed until the number of vertices fits.
#include "anatomy/sheet.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "anatomy/remesh.h"

namespace mvs::core {
namespace {

// The initial grid: fine enough for the shape, every cell divided in two triangles.
HalfSheet coarse_sheet(const Shape &shape) {
  constexpr uint32_t columns = 24, rows = 6;
  HalfSheet sheet;
  for (uint32_t i = 0; i <= columns; ++i) {
    const bool mirror = i == 0 || i == columns, column = mirror || i == columns / 2;
    for (uint32_t j = 0; j <= rows; ++j) {
      const Place place{pi * i / columns, static_cast<double>(j) / rows};
      sheet.place.push_back(place);
      sheet.x.push_back(shape.open(place));
      sheet.sides.push_back(
          static_cast<uint8_t>((column ? on_column : 0) | (mirror ? on_mirror : 0) |
                               (j == 0 ? on_annulus : 0) | (j == rows ? on_free_edge : 0)));
    }
  }
  for (uint32_t i = 0; i < columns; ++i) {
    for (uint32_t j = 0; j < rows; ++j) {
      const uint32_t a = i * (rows + 1) + j, b = a + rows + 1;
      sheet.triangles.push_back({a, a + 1, b});
      sheet.triangles.push_back({b, a + 1, b + 1});
    }
  }
  return sheet;
}

double area_of(const HalfSheet &sheet) {
  double area = 0;
  for (const auto &[a, b, c] : sheet.triangles) {
    const Vec3 e = sheet.x[b] - sheet.x[a], f = sheet.x[c] - sheet.x[a];
    area += 0.5 * std::sqrt(e.squaredNorm() * f.squaredNorm() - e.dot(f) * e.dot(f));
  }
  return area;
}

// Number of vertices of the mirrored whole.
double whole_count(const HalfSheet &sheet) {
  const auto on_it = [](uint8_t sides) { return (sides & on_mirror) != 0; };
  return 2.0 * static_cast<double>(sheet.x.size()) -
         static_cast<double>(std::count_if(sheet.sides.begin(), sheet.sides.end(), on_it));
}

// Numbers vertices along the annulus, which keeps neighbours near in memory; sets x to 0 for
// vertices on the mirror plane.
HalfSheet in_order(const HalfSheet &sheet) {
  std::vector<uint32_t> order(sheet.x.size()), number(sheet.x.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    const Place &p = sheet.place[a], &q = sheet.place[b];
    return std::tie(p.theta, p.v) < std::tie(q.theta, q.v);
  });
  HalfSheet sorted;
  for (uint32_t i : order) {
    number[i] = static_cast<uint32_t>(sorted.x.size());
    sorted.place.push_back(sheet.place[i]);
    sorted.sides.push_back(sheet.sides[i]);
    sorted.x.push_back(sheet.x[i]);
    if (sheet.sides[i] & on_mirror) sorted.x.back().x() = 0;
  }
  for (const auto &[a, b, c] : sheet.triangles) {
    Tri triangle = {number[a], number[b], number[c]};
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()),
                triangle.end());
    sorted.triangles.push_back(triangle);
  }
  std::sort(sorted.triangles.begin(), sorted.triangles.end());
  return sorted;
}

}  // namespace

HalfSheet mesh_half_sheet(const Shape &shape, uint32_t vertices) {
  constexpr int attempts = 8;
  constexpr double close_enough = 0.02;
  constexpr uint32_t trial = 1000;        // vertices of a first trial that calibrates edge length
  const double row = std::sqrt(3.0) / 2;  // a vertex of a regular sheet has row * edge^2
  HalfSheet best, sheet = coarse_sheet(shape);
  const double area = 2 * area_of(sheet);
  double best_miss = INFINITY, factor = 1;
  for (int i = 0; i < attempts && best_miss > close_enough; ++i) {
    const uint32_t wanted = i == 0 ? std::min(vertices, trial) : vertices;
    remesh(shape, factor * std::sqrt(area / (row * wanted)), sheet);
    const double ratio = whole_count(sheet) / wanted, miss = std::abs(ratio - 1);
    factor *= std::sqrt(ratio);
    if (wanted != vertices || miss >= best_miss) continue;
    best = sheet;
    best_miss = miss;
  }
  return in_order(best);
}

}  // namespace mvs::core
