// Surfaces as people have them: soup, other numbers, other orientations, and real ones.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <numeric>
#include <utility>

#include "patient/leaflet_sheet.h"
#include "tests/model/real_valves.h"

namespace mvs::core::test {

struct Surface {
  std::vector<Vec3> x;
  std::vector<Tri> triangles;
};

inline Surface surface_of(const LeafletSheet &sheet) {
  return {sheet.x, sheet.triangles};
}

// splitmix64
inline uint64_t next_random(uint64_t &state) {
  uint64_t z = state += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

// Uniform in [-1, 1].
inline double next_share(uint64_t &state) {
  return static_cast<double>(next_random(state) >> 11) * 0x1p-52 - 1;
}

// Drops the triangles around some vertices.
inline Surface without_stars(Surface s, const std::vector<uint32_t> &vertices) {
  std::erase_if(s.triangles, [&](const Tri &t) {
    return std::any_of(t.begin(), t.end(), [&](uint32_t i) {
      return std::find(vertices.begin(), vertices.end(), i) != vertices.end();
    });
  });
  return s;
}

// Three points for each triangle, with coordinates in single precision in mm, as in STL.
inline Surface soup(const Surface &surface) {
  Surface out;
  for (const Tri &t : surface.triangles) {
    const uint32_t first = static_cast<uint32_t>(out.x.size());
    for (const uint32_t i : t) {
      const Vec3 mm = surface.x[i] * 1e3;
      out.x.push_back(mm.cast<float>().cast<double>() * 1e-3);
    }
    out.triangles.push_back({first, first + 1, first + 2});
  }
  return out;
}

// Random numbers for points, a random order of triangles and of their corners.
inline Surface renumbered(const Surface &surface, uint64_t seed) {
  const auto shuffled = [&](size_t count) {
    std::vector<uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0u);
    for (size_t i = count; i > 1; --i) std::swap(order[i - 1], order[next_random(seed) % i]);
    return order;
  };
  const std::vector<uint32_t> point = shuffled(surface.x.size());
  const std::vector<uint32_t> triangle = shuffled(surface.triangles.size());
  Surface out = surface;
  for (size_t i = 0; i < point.size(); ++i) out.x[point[i]] = surface.x[i];
  for (size_t t = 0; t < triangle.size(); ++t) {
    Tri &made = out.triangles[triangle[t]];
    const size_t turn = next_random(seed) % 3;
    for (size_t k = 0; k < 3; ++k) made[k] = point[surface.triangles[t][(k + turn) % 3]];
  }
  return out;
}

// Rotated about an oblique axis and moved 0.3 m.
inline Surface moved(Surface surface, double angle) {
  const Vec3 axis = Vec3(1, 2, 3).normalized();
  for (Vec3 &p : surface.x) {
    const Vec3 turned = std::cos(angle) * p + std::sin(angle) * axis.cross(p) +
                        (1 - std::cos(angle)) * axis.dot(p) * axis;
    p = turned + Vec3(0.1, -0.2, 0.3);
  }
  return surface;
}

// The winding of every n-th triangle is turned; all with n = 1.
inline Surface flipped(Surface surface, size_t n) {
  for (size_t t = 0; t < surface.triangles.size(); t += n) {
    std::swap(surface.triangles[t][1], surface.triangles[t][2]);
  }
  return surface;
}

// A funnel of rings around z: `round` x `down` quads cut in two, radius 16 mm at the top and 8 mm
// at the bottom, 12 mm deep. Normals point to the axis and up.
inline Surface funnel(uint32_t round, uint32_t down) {
  Surface s;
  for (uint32_t j = 0; j <= down; ++j) {
    for (uint32_t i = 0; i < round; ++i) {
      const double angle = 2 * 3.14159265358979 * i / round, h = double(j) / down;
      const double r = 16e-3 - 8e-3 * h;
      s.x.push_back({r * std::cos(angle), r * std::sin(angle), -12e-3 * h});
    }
  }
  for (uint32_t j = 0; j < down; ++j) {
    for (uint32_t i = 0; i < round; ++i) {
      const uint32_t a = j * round + i, b = j * round + (i + 1) % round;
      s.triangles.push_back({a, b, b + round});
      s.triangles.push_back({a, b + round, a + round});
    }
  }
  return s;
}

// A binary STL file of the folder of real data, in m; empty if it is not there.
inline Surface real_stl(const std::string &file) {
  const char *folder = std::getenv("MVS_TEST_DATA");
  std::ifstream in((folder ? std::string(folder) : MVS_SOURCE_DIR "/../shared/data") + "/" + file,
                   std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  Surface s;
  for (size_t at = 84; at + 50 <= bytes.size(); at += 50) {
    std::array<float, 9> corner{};
    std::memcpy(corner.data(), bytes.data() + at + 12, sizeof corner);
    const uint32_t first = static_cast<uint32_t>(s.x.size());
    for (size_t k = 0; k < 3; ++k) {
      s.x.push_back(Vec3(corner[3 * k], corner[3 * k + 1], corner[3 * k + 2]) * 1e-3);
    }
    s.triangles.push_back({first, first + 1, first + 2});
  }
  return s;
}

inline const Finding *find(const Findings &findings, const std::string &name) {
  const auto at = std::find_if(findings.begin(), findings.end(),
                               [&](const Finding &f) { return f.name == name; });
  return at == findings.end() ? nullptr : &*at;
}

}  // namespace mvs::core::test
