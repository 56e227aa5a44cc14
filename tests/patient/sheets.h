// Sheets to remesh: disturbed, renumbered and folded ones, and a real one.
#pragma once

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <numeric>
#include <random>

#include "model/sides.h"
#include "tests/patient/parametric_sheet.h"

namespace mvs::core::test {

struct SheetWithRims {
  LeafletSheet sheet;
  SheetRims rims;
};

// Boundary loops in the order in which the triangles pass along them, the longest first.
inline std::vector<std::vector<uint32_t>> loops_by_length(const LeafletSheet &sheet) {
  std::map<uint32_t, uint32_t> next;
  const std::vector<Side> sides = sorted_sides(sheet.triangles);
  for_each_edge(sides, [&](size_t first, size_t last) {
    if (last == first + 1) {
      next[side_from(sheet.triangles, sides[first])] = side_to(sheet.triangles, sides[first]);
    }
  });
  std::vector<std::vector<uint32_t>> loops;
  while (!next.empty()) {
    loops.emplace_back();
    for (auto at = next.begin(); at != next.end();) {
      loops.back().push_back(at->first);
      const uint32_t to = at->second;
      next.erase(at);
      at = next.find(to);
    }
  }
  std::stable_sort(loops.begin(), loops.end(),
                   [](const auto &a, const auto &b) { return a.size() > b.size(); });
  return loops;
}

inline double loop_length(const LeafletSheet &sheet, const std::vector<uint32_t> &loop) {
  double length = 0;
  for (size_t k = 0; k < loop.size(); ++k) {
    length += (sheet.x[loop[(k + 1) % loop.size()]] - sheet.x[loop[k]]).norm();
  }
  return length;
}

inline double sheet_area(const LeafletSheet &sheet) {
  double area = 0;
  for (const Tri &t : sheet.triangles) area += triangle_area(sheet.x, t);
  return area;
}

inline double mean_edge(const LeafletSheet &sheet) {
  const std::vector<Side> sides = sorted_sides(sheet.triangles);
  double sum = 0, count = 0;
  for_each_edge(sides, [&](size_t first, size_t) {
    sum += (sheet.x[sides[first].edge[0]] - sheet.x[sides[first].edge[1]]).norm();
    ++count;
  });
  return sum / count;
}

// Every coordinate off by up to `size` (m), from a generator that is the same everywhere.
inline void disturb(LeafletSheet &sheet, double size, uint32_t seed) {
  std::mt19937 random(seed);
  for (Vec3 &p : sheet.x) {
    for (int k = 0; k < 3; ++k)
      p[k] += size * (2 * (static_cast<double>(random()) / 4294967295.0) - 1);
  }
}

// The same sheet with vertices and triangles in another order, turned and shifted.
inline SheetWithRims renumbered(const LeafletSheet &sheet, const SheetRims &rims, uint32_t seed) {
  std::mt19937 random(seed);
  const auto shuffled = [&](size_t n) {
    std::vector<uint32_t> order(n);
    std::iota(order.begin(), order.end(), 0u);
    for (size_t k = n; k-- > 1;) std::swap(order[k], order[random() % (k + 1)]);
    return order;
  };
  const Eigen::Quaterniond turn = Eigen::Quaterniond(0.3, -0.5, 0.7, 0.41).normalized();
  const std::vector<uint32_t> number = shuffled(sheet.x.size());
  SheetWithRims made;
  made.sheet.x.resize(sheet.x.size());
  for (size_t i = 0; i < number.size(); ++i) {
    made.sheet.x[number[i]] = turn * sheet.x[i] + Vec3(0.11, -0.07, 0.03);
  }
  for (const uint32_t t : shuffled(sheet.triangles.size())) {
    const auto &[a, b, c] = sheet.triangles[t];
    made.sheet.triangles.push_back({number[b], number[c], number[a]});
    made.sheet.label.push_back(sheet.label[t]);
  }
  made.rims = rims;
  for (auto *loop : {&made.rims.annulus, &made.rims.free_edge}) {
    for (uint32_t &v : *loop) v = number[v];
    std::rotate(loop->begin(), loop->begin() + static_cast<std::ptrdiff_t>(loop->size() / 3),
                loop->end());
  }
  return made;
}

// A surface of revolution whose profile (radius, height) is given, with `around` columns.
inline SheetWithRims revolved(const std::vector<std::array<double, 2>> &profile, uint32_t around) {
  SheetWithRims made;
  const auto rows = static_cast<uint32_t>(profile.size());
  for (uint32_t r = 0; r < rows; ++r) {
    for (uint32_t k = 0; k < around; ++k) {
      const double angle = 2 * 3.14159265358979 * (k + 0.5 * (r % 2)) / around;
      made.sheet.x.push_back(
          {profile[r][0] * std::cos(angle), profile[r][0] * std::sin(angle), profile[r][1]});
    }
  }
  for (uint32_t r = 0; r + 1 < rows; ++r) {
    for (uint32_t k = 0; k < around; ++k) {
      const uint32_t a = r * around + k, b = r * around + (k + 1) % around;
      const uint32_t c = a + around, d = b + around;
      if (r % 2 == 0) {
        made.sheet.triangles.push_back({a, b, c});
        made.sheet.triangles.push_back({b, d, c});
      } else {
        made.sheet.triangles.push_back({a, b, d});
        made.sheet.triangles.push_back({a, d, c});
      }
    }
  }
  made.sheet.label.assign(made.sheet.triangles.size(), LeafletLabel::unknown);
  for (uint32_t k = 0; k < around; ++k) {
    made.rims.annulus.push_back(k);
    made.rims.free_edge.push_back((rows - 1) * around + k);
  }
  return made;
}

// Two cylinders `gap` apart, of radius 9 mm and 5 mm high, joined at the bottom by a fold with the
// given profile from one to the other: offsets from the middle radius, and heights.
inline constexpr double wall_radius = 9e-3;
inline SheetWithRims double_wall(double gap, double edge,
                                 const std::vector<std::array<double, 2>> &fold) {
  std::vector<std::array<double, 2>> profile;
  constexpr double height = 5e-3, pi = 3.14159265358979;
  const int rows = static_cast<int>(height / edge);
  const double top = fold.front()[1];
  for (int k = rows; k > 0; --k) profile.push_back({wall_radius + 0.5 * gap, top + k * edge});
  for (const auto &[x, z] : fold) profile.push_back({wall_radius + x, z});
  for (int k = 1; k <= rows; ++k) profile.push_back({wall_radius - 0.5 * gap, top + k * edge});
  SheetWithRims made = revolved(profile, static_cast<uint32_t>(2 * pi * wall_radius / edge));
  // the outer wall is labelled anterior
  for (size_t t = 0; t < made.sheet.triangles.size(); ++t) {
    const bool outer = 2 * t < made.sheet.triangles.size();
    made.sheet.label[t] = outer ? LeafletLabel::anterior : LeafletLabel::posterior;
  }
  return made;
}

// A fold with a drop-shaped profile, 2.6 mm wide and 4 mm high.
inline SheetWithRims wall_with_bulb(double gap, double edge) {
  constexpr double size = 2e-3, pi = 3.14159265358979;
  std::vector<std::array<double, 2>> fold;
  const int parts = static_cast<int>(5.5 * size / edge);
  for (int k = 0; k <= parts; ++k) {
    const double t = 2 * pi * k / parts, half = std::sin(0.5 * t);
    fold.push_back(
        {0.5 * gap * std::cos(0.5 * t) + size * std::sin(t) * half * half, size * std::cos(t)});
  }
  return double_wall(gap, edge, fold);
}

// A fold that is a half circle as wide as the gap.
inline SheetWithRims hairpin(double gap, double edge) {
  std::vector<std::array<double, 2>> fold;
  for (int k = 0; k <= 4; ++k) {
    const double t = 3.14159265358979 * k / 4;
    fold.push_back({0.5 * gap * std::cos(t), -0.5 * gap * std::sin(t)});
  }
  return double_wall(gap, edge, fold);
}

// Empty if the file does not exist. Equal points of the triangle soup are one vertex.
inline SheetWithRims real_sheet() {
  SheetWithRims made;
  const char *folder = std::getenv("MVS_TEST_DATA");
  if (!folder) return made;
  std::ifstream in(std::string(folder) + "/real_mitral/open_1146.stl", std::ios::binary);
  if (!in) return made;
  std::array<char, 84> head;
  in.read(head.data(), 84);
  std::map<std::array<float, 3>, uint32_t> vertex;
  // 50 bytes: the normal, three corners, an attribute
  for (std::array<char, 50> facet; in.read(facet.data(), facet.size());) {
    Tri t;
    for (size_t k = 0; k < 3; ++k) {
      std::array<float, 3> p;
      std::memcpy(p.data(), facet.data() + 12 * (k + 1), sizeof p);
      const auto number = static_cast<uint32_t>(vertex.size());
      const auto [at, is_new] = vertex.insert({p, number});
      if (is_new) made.sheet.x.push_back(Vec3(p[0], p[1], p[2]) * 1e-3);
      t[k] = at->second;
    }
    made.sheet.triangles.push_back(t);
  }
  made.sheet.label.assign(made.sheet.triangles.size(), LeafletLabel::unknown);
  const auto loops = loops_by_length(made.sheet);
  const bool first = loop_length(made.sheet, loops[0]) > loop_length(made.sheet, loops[1]);
  made.rims = {loops[first ? 0 : 1], loops[first ? 1 : 0]};
  return made;
}

}  // namespace mvs::core::test
