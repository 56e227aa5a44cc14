// The uniform grid: boxes are counted into cells, and each pair is taken in the one cell that holds
// the lowest corner of what the two boxes share.
#include "base/grid.h"

#include <algorithm>
#include <cmath>

namespace mvs {
namespace {

struct Grid {
  Vec3 origin;
  double inverse_cell;
  std::array<int, 3> size;

  std::array<int, 3> cell_of(const Vec3 &p) const {
    std::array<int, 3> c;
    for (int k = 0; k < 3; ++k) {
      c[k] = std::clamp(static_cast<int>((p[k] - origin[k]) * inverse_cell), 0, size[k] - 1);
    }
    return c;
  }
  size_t index(int i, int j, int k) const {
    return (static_cast<size_t>(k) * size[1] + j) * size[0] + i;
  }
};

// Cells as wide as the mean box, but no more of them than a few per box.
Grid fit(const std::vector<Vec3> &low, const std::vector<Vec3> &high) {
  Vec3 lowest = low[0], highest = high[0];
  double mean = 0;
  for (size_t i = 0; i < low.size(); ++i) {
    lowest = lowest.cwiseMin(low[i]);
    highest = highest.cwiseMax(high[i]);
    mean += (high[i] - low[i]).maxCoeff();
  }
  mean /= static_cast<double>(low.size());
  const Vec3 extent = highest - lowest;
  double cell = std::max(mean, extent.maxCoeff() / 512);
  if (!(cell > 0)) cell = 1;
  const double most = 8.0 * static_cast<double>(low.size()) + 64;
  auto count = [&](double width) {
    return (std::floor(extent[0] / width) + 1) * (std::floor(extent[1] / width) + 1) *
           (std::floor(extent[2] / width) + 1);
  };
  while (count(cell) > most) cell *= 1.25;
  Grid grid{lowest, 1 / cell, {}};
  for (int k = 0; k < 3; ++k) grid.size[k] = static_cast<int>(extent[k] / cell) + 1;
  return grid;
}

template <typename Visit>
void for_cells(const Grid &grid, const Vec3 &low, const Vec3 &high, Visit &&visit) {
  const auto a = grid.cell_of(low), b = grid.cell_of(high);
  for (int k = a[2]; k <= b[2]; ++k) {
    for (int j = a[1]; j <= b[1]; ++j) {
      for (int i = a[0]; i <= b[0]; ++i) visit(grid.index(i, j, k));
    }
  }
}

// Which boxes reach into each cell, ascending.
struct Cells {
  Grid grid;
  std::vector<uint32_t> start, item;

  Cells(const std::vector<Vec3> &low, const std::vector<Vec3> &high) : grid(fit(low, high)) {
    const size_t cells = static_cast<size_t>(grid.size[0]) * grid.size[1] * grid.size[2];
    const auto n = static_cast<uint32_t>(low.size());
    start.assign(cells + 1, 0);
    for (uint32_t i = 0; i < n; ++i) {
      for_cells(grid, low[i], high[i], [&](size_t c) { ++start[c + 1]; });
    }
    for (size_t c = 0; c < cells; ++c) start[c + 1] += start[c];
    item.resize(start[cells]);
    std::vector<uint32_t> next(start.begin(), start.end() - 1);
    for (uint32_t i = 0; i < n; ++i) {
      for_cells(grid, low[i], high[i], [&](size_t c) { item[next[c]++] = i; });
    }
  }
};

}  // namespace

void overlapping_boxes(const std::vector<Vec3> &low, const std::vector<Vec3> &high,
                       std::vector<Edge> &pairs) {
  pairs.clear();
  if (low.empty()) return;
  const Cells cells(low, high);
  for (size_t c = 0; c + 1 < cells.start.size(); ++c) {
    for (uint32_t p = cells.start[c]; p < cells.start[c + 1]; ++p) {
      const uint32_t a = cells.item[p];
      for (uint32_t q = p + 1; q < cells.start[c + 1]; ++q) {
        const uint32_t b = cells.item[q];
        if ((low[a].array() > high[b].array()).any()) continue;
        if ((low[b].array() > high[a].array()).any()) continue;
        const auto home = cells.grid.cell_of(low[a].cwiseMax(low[b]));
        if (cells.grid.index(home[0], home[1], home[2]) == c) pairs.push_back({a, b});
      }
    }
  }
}

void points_in_boxes(const std::vector<Vec3> &points, const std::vector<Vec3> &low,
                     const std::vector<Vec3> &high, std::vector<Edge> &pairs) {
  pairs.clear();
  if (low.empty()) return;
  const Cells cells(low, high);
  for (uint32_t i = 0; i < points.size(); ++i) {
    const auto home = cells.grid.cell_of(points[i]);
    const size_t c = cells.grid.index(home[0], home[1], home[2]);
    for (uint32_t p = cells.start[c]; p < cells.start[c + 1]; ++p) {
      const uint32_t b = cells.item[p];
      if ((points[i].array() < low[b].array()).any()) continue;
      if ((points[i].array() > high[b].array()).any()) continue;
      pairs.push_back({i, b});
    }
  }
}

}  // namespace mvs
