// Skins as label maps of images give them.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "geometry/aabb.h"
#include "geometry/triangle_bvh.h"
#include "model/compressed_rows.h"
#include "model/sides.h"
#include "tests/patient/surfaces.h"

namespace mvs::core::test {

using Cell = std::array<int, 3>;

// The faces between cells of `size` m with inside(cell) and others, two triangles each, wound with
// normals outward; cells are 0 to count - 1, those at the ends are outside. Bodies that touch along
// an edge share it: four triangles meet there.
template <typename Inside>
Surface cell_surface(const Vec3 &low, double size, const Cell &count, Inside inside) {
  Surface s;
  std::map<Cell, uint32_t> corners;
  const auto corner = [&](const Cell &c) {
    const auto [at, made] = corners.insert({c, static_cast<uint32_t>(s.x.size())});
    if (made) s.x.push_back(low + size * (Vec3(c[0], c[1], c[2]) - Vec3::Constant(0.5)));
    return at->second;
  };
  const auto add_faces = [&](const Cell &c) {
    for (size_t axis = 0; axis < 3; ++axis) {
      Cell before = c;
      --before[axis];
      const bool here = inside(c);
      if (inside(before) == here) continue;
      std::array<Cell, 4> face = {c, c, c, c};
      ++face[1][(axis + 1) % 3];
      ++face[2][(axis + 1) % 3];
      ++face[2][(axis + 2) % 3];
      ++face[3][(axis + 2) % 3];
      if (here) std::swap(face[1], face[3]);
      const uint32_t a = corner(face[0]), b = corner(face[1]), d = corner(face[2]);
      s.triangles.push_back({a, b, d});
      s.triangles.push_back({a, d, corner(face[3])});
    }
  };
  for (int k = 1; k < count[2]; ++k) {
    for (int j = 1; j < count[1]; ++j) {
      for (int i = 1; i < count[0]; ++i) add_faces({i, j, k});
    }
  }
  return s;
}

// The boundary of the voxels (of `size` m) whose centres are nearer than half a thickness to a
// sheet, after some rounds of Taubin's filter.
inline Surface voxel_skin(const LeafletSheet &mid, double size, double thickness, int smoothings) {
  const TriangleBvh bvh(mid.triangles, mid.x);
  Aabb box;
  for (const Vec3 &p : mid.x) box.add(p);
  const Vec3 low = box.low - Vec3::Constant(3 * size + thickness);
  const Vec3 cells = (box.high - box.low + Vec3::Constant(2 * thickness)) / size;
  Cell count{};
  for (int k = 0; k < 3; ++k) count[static_cast<size_t>(k)] = static_cast<int>(cells[k]) + 6;
  std::map<Cell, bool> known;  // each cell is asked for six times
  Surface s = cell_surface(low, size, count, [&](const Cell &c) {
    const auto [at, made] = known.insert({c, false});
    if (made) at->second = bvh.is_within(low + size * Vec3(c[0], c[1], c[2]), 0.5 * thickness);
    return at->second;
  });
  const Rows stars = rows_of(s.x.size(), s.triangles);
  for (int step = 0; step < 2 * smoothings; ++step) {
    const std::vector<Vec3> from = s.x;
    for (uint32_t i = 0; i < s.x.size(); ++i) {
      const std::vector<uint32_t> around = neighbours_in(s.triangles, stars[i], i);
      Vec3 mean = Vec3::Zero();
      for (const uint32_t j : around) mean += from[j];
      mean /= static_cast<double>(around.size());
      s.x[i] += (step % 2 == 0 ? 0.33 : -0.34) * (mean - from[i]);
    }
  }
  return s;
}

}  // namespace mvs::core::test
