// Sweep and union of clusters.
#include "patient/surface/weld.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/median.h"
#include "model/sides.h"
#include "patient/surface/clusters.h"

namespace mvs::core {

double median_edge(const std::vector<Vec3> &x, const std::vector<Tri> &triangles) {
  std::vector<double> length;
  length.reserve(3 * triangles.size());
  for (const Tri &t : triangles) {
    for (size_t k = 0; k < 3; ++k) {
      const double side = (x[t[(k + 1) % 3]] - x[t[k]]).norm();
      if (side > 0) length.push_back(side);
    }
  }
  if (length.empty()) return 0;
  return median_of(std::move(length));
}

std::vector<uint32_t> weld_map(const std::vector<Vec3> &x, double distance) {
  const size_t n = x.size();
  std::vector<uint32_t> order(n), parent(n);
  std::iota(order.begin(), order.end(), 0u);
  std::iota(parent.begin(), parent.end(), 0u);
  std::sort(order.begin(), order.end(), [&](uint32_t i, uint32_t j) {
    for (int k = 0; k < 3; ++k) {
      if (x[i][k] != x[j][k]) return x[i][k] < x[j][k];
    }
    return i < j;
  });
  for (size_t p = 0; p < n; ++p) {
    const uint32_t i = order[p];
    for (size_t q = p + 1; q < n && x[order[q]].x() - x[i].x() <= distance; ++q) {
      const uint32_t j = order[q];
      if ((x[j] - x[i]).squaredNorm() > distance * distance) continue;
      join(parent, i, j);
    }
  }
  for (uint32_t i = 0; i < n; ++i) parent[i] = root_of(parent, i);
  return parent;
}

void keep_triangles(LeafletSheet &sheet, const std::vector<uint8_t> &marks) {
  size_t kept = 0;
  for (size_t t = 0; t < sheet.triangles.size(); ++t) {
    if (marks[t] == 0) continue;
    sheet.triangles[kept] = sheet.triangles[t];
    sheet.label[kept++] = sheet.label[t];
  }
  sheet.triangles.resize(kept);
  sheet.label.resize(kept);
}

void drop_unused(LeafletSheet &sheet) {
  const std::vector<uint8_t> used = vertex_marks(sheet.triangles, sheet.x.size());
  std::vector<uint32_t> place(sheet.x.size(), none);
  uint32_t count = 0;
  for (uint32_t i = 0; i < sheet.x.size(); ++i) {
    if (used[i] == 0) continue;
    sheet.x[count] = sheet.x[i];
    if (!sheet.thickness.empty()) sheet.thickness[count] = sheet.thickness[i];
    place[i] = count++;
  }
  sheet.x.resize(count);
  if (!sheet.thickness.empty()) sheet.thickness.resize(count);
  for (Tri &t : sheet.triangles) {
    for (uint32_t &i : t) i = place[i];
  }
}

}  // namespace mvs::core
