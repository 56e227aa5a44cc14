// Counting sort of the sections by row.
#include "measure/tenting/row_sections.h"

#include <array>
#include <cmath>
#include <utility>

namespace mvs::core {
namespace {

// The rows of the map with v in [low, high): first to end.
struct RowRange {
  size_t first, end;
};
RowRange rows_between(const AnnulusMap &map, double low, double high) {
  const auto place = [&](double v) {
    const double row = std::ceil((v - map.v()[0]) / map.depth());
    size_t k = static_cast<size_t>(std::clamp(row, 0.0, static_cast<double>(AnnulusMap::across)));
    while (k > 0 && map.v()[k - 1] >= v) --k;  // rounding of the quotient
    while (k < AnnulusMap::across && map.v()[k] < v) ++k;
    return k;
  };
  return {place(low), place(high)};
}

// Where the side between two nodes meets a row: u and height. The lower node comes first, so that
// both triangles at the side get the same bits.
std::pair<double, double> cut_side(const Vec3 &low, const Vec3 &high, double v) {
  const double t = (v - low[1]) / (high[1] - low[1]);
  return {low[0] + t * (high[0] - low[0]), low[2] + t * (high[2] - low[2])};
}

// The corners of a triangle by their v, those of equal v in the order of their numbers.
std::array<uint32_t, 3> by_height(const Tri &t, const std::vector<Vec3> &local) {
  std::array<uint32_t, 3> c = {t[0], t[1], t[2]};
  const auto below = [&](uint32_t a, uint32_t b) {
    return local[a][1] != local[b][1] ? local[a][1] < local[b][1] : a < b;
  };
  if (below(c[1], c[0])) std::swap(c[0], c[1]);
  if (below(c[2], c[1])) std::swap(c[1], c[2]);
  if (below(c[1], c[0])) std::swap(c[0], c[1]);
  return c;
}

}  // namespace

Sections cut_triangles(const AnnulusMap &map, const std::vector<Tri> &triangles,
                       const std::vector<Vec3> &local) {
  std::vector<RowRange> rows;
  rows.reserve(triangles.size());
  Sections sections;
  sections.first.assign(AnnulusMap::across + 1, 0);
  for (const Tri &t : triangles) {
    const auto [low, high] = std::minmax({local[t[0]][1], local[t[1]][1], local[t[2]][1]});
    rows.push_back(rows_between(map, low, high));
    for (size_t r = rows.back().first; r < rows.back().end; ++r) ++sections.first[r + 1];
  }
  for (size_t r = 0; r < AnnulusMap::across; ++r) sections.first[r + 1] += sections.first[r];
  sections.items.resize(sections.first[AnnulusMap::across]);
  std::vector<size_t> next(sections.first.begin(), sections.first.end() - 1);
  for (size_t k = 0; k < triangles.size(); ++k) {
    if (rows[k].first == rows[k].end) continue;
    const std::array<uint32_t, 3> c = by_height(triangles[k], local);
    const Vec3 &low = local[c[0]], &middle = local[c[1]], &high = local[c[2]];
    for (size_t r = rows[k].first; r < rows[k].end; ++r) {
      const double v = map.v()[r];
      const auto a = cut_side(low, high, v);
      const auto b = v < middle[1] ? cut_side(low, middle, v) : cut_side(middle, high, v);
      const auto &from = a.first <= b.first ? a : b, &to = a.first <= b.first ? b : a;
      sections.items[next[r]++] = {from.first, to.first, from.second, to.second};
    }
  }
  return sections;
}

}  // namespace mvs::core
