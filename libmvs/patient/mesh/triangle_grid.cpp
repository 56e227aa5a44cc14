// Cells of a uniform grid; separation by one direction before the exact test.
#include "patient/mesh/triangle_grid.h"

#include <cmath>

#include "geometry/intersect.h"

namespace mvs::core {
namespace {

constexpr double most_cells = 262144;  // 6 MB of empty lists

// Relative to squared lengths: far above the rounding of the products below (1e-15), far below a
// distance that matters.
constexpr double separation_margin = 1e-9;

// Whether a plane normal to the difference of the centroids separates two triangles.
bool centroids_separate(const std::array<Vec3, 3> &s, const std::array<Vec3, 3> &t) {
  const Vec3 &origin = s[0];
  const Vec3 way = (s[0] - t[0]) + (s[1] - t[1]) + (s[2] - t[2]);
  double least = 0, most = (t[0] - origin).dot(way);
  for (size_t k = 1; k < 3; ++k) {
    least = std::min(least, (s[k] - origin).dot(way));
    most = std::max(most, (t[k] - origin).dot(way));
  }
  return least - most > separation_margin * way.squaredNorm();
}

// Whether a plane through the common corner p separates triangles p a b and p c d.
bool bisectors_separate(const Vec3 &p, const Vec3 &a, const Vec3 &b, const Vec3 &c, const Vec3 &d) {
  const Vec3 pa = a - p, pb = b - p, pc = c - p, pd = d - p;
  const Vec3 first = pa + pb, second = pc + pd;
  const double n1 = first.norm(), n2 = second.norm();
  if (n1 == 0 || n2 == 0) return false;
  const Vec3 way = first / n1 - second / n2;
  const double margin = separation_margin * (n1 + n2);
  return std::min(pa.dot(way), pb.dot(way)) > margin &&
         std::max(pc.dot(way), pd.dot(way)) < -margin;
}

}  // namespace

bool mesh_triangles_cross(const std::vector<Vec3> &x, const Tri &first, const Tri &second) {
  uint32_t shared = 0, i = 0, j = 0;
  for (uint32_t k = 0; k < 3; ++k) {
    for (uint32_t l = 0; l < 3; ++l) {
      if (first[k] != second[l]) continue;
      ++shared;
      i = k;
      j = l;
    }
  }
  if (shared == 0 && centroids_separate({x[first[0]], x[first[1]], x[first[2]]},
                                        {x[second[0]], x[second[1]], x[second[2]]})) {
    return false;
  }
  if (shared == 1 && bisectors_separate(x[first[i]], x[first[(i + 1) % 3]], x[first[(i + 2) % 3]],
                                        x[second[(j + 1) % 3]], x[second[(j + 2) % 3]])) {
    return false;
  }
  return triangles_cross(x, first, second);
}

TriangleGrid::TriangleGrid(const std::vector<Vec3> &x, const std::vector<Tri> &triangles,
                           double cell)
    : cell_(cell) {
  const Aabb box = aabb_of(x);
  origin_ = box.low;
  const Vec3 extent = box.high - box.low;
  const auto cells_of = [&](int k) { return std::floor(extent[k] / cell_) + 1; };
  while (cells_of(0) * cells_of(1) * cells_of(2) > most_cells) cell_ *= 1.25;
  for (int k = 0; k < 3; ++k) count_[static_cast<size_t>(k)] = static_cast<uint32_t>(cells_of(k));
  cells_.resize(static_cast<size_t>(count_[0]) * count_[1] * count_[2]);
  entries_.reserve(triangles.size());
  for (uint32_t t = 0; t < triangles.size(); ++t) insert(t, aabb_of(x, triangles[t]));
}

TriangleGrid::Range TriangleGrid::range_of(const Aabb &box) const {
  Range range;
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<size_t>(k);
    const double last = count_[axis] - 1;
    const auto cell_at = [&](double v) {
      return static_cast<uint32_t>(std::clamp(std::floor((v - origin_[k]) / cell_), 0.0, last));
    };
    range.low[axis] = cell_at(box.low[k]);
    range.high[axis] = cell_at(box.high[k]);
  }
  return range;
}

void TriangleGrid::insert(uint32_t triangle, const Aabb &box) {
  if (triangle >= entries_.size()) entries_.resize(triangle + 1);
  const Range range = range_of(box);
  entries_[triangle] = {box, range};
  for (uint32_t i = range.low[0]; i <= range.high[0]; ++i) {
    for (uint32_t j = range.low[1]; j <= range.high[1]; ++j) {
      for (uint32_t k = range.low[2]; k <= range.high[2]; ++k) {
        cells_[index(i, j, k)].push_back(triangle);
      }
    }
  }
}

void TriangleGrid::remove(uint32_t triangle) {
  const Range &range = entries_[triangle].range;
  for (uint32_t i = range.low[0]; i <= range.high[0]; ++i) {
    for (uint32_t j = range.low[1]; j <= range.high[1]; ++j) {
      for (uint32_t k = range.low[2]; k <= range.high[2]; ++k) {
        std::vector<uint32_t> &cell = cells_[index(i, j, k)];
        const auto at = std::find(cell.begin(), cell.end(), triangle);
        *at = cell.back();
        cell.pop_back();
      }
    }
  }
}

}  // namespace mvs::core
