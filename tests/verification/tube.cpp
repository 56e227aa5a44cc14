// Rows of nodes, each turned by half an edge against the row below.
#include "tests/verification/tube.h"

#include <mvs/valve.h>

#include <Eigen/Geometry>
#include <cmath>

namespace mvs::core::verification {

void make_tissue(Valve &valve, const Published &law) {
  valve.leaflets.resize(1);
  valve.leaflets[0].law = law.law;
  valve.leaflets[0].constants = law.constants;
  valve.bending_scale = 0;
}

Tube tube_drawn_out(const Published &law, double radius, const TubeMesh &mesh, double stretch) {
  const auto [around, rows, length] = mesh;
  Valve valve;
  std::vector<uint32_t> ends;
  for (uint32_t j = 0; j <= rows; ++j) {
    for (uint32_t i = 0; i < around; ++i) {
      const double angle = 2 * test::pi * (i + 0.5 * (j % 2)) / around;
      if (j == 0 || j == rows) ends.push_back(static_cast<uint32_t>(valve.rest.size()));
      valve.rest.push_back({radius * std::cos(angle), radius * std::sin(angle), length * j / rows});
    }
  }
  for (uint32_t j = 0; j < rows; ++j) {
    for (uint32_t i = 0; i < around; ++i) {
      const uint32_t next = (i + 1) % around, shift = j % 2;
      const uint32_t a = j * around + i, b = j * around + next;
      const uint32_t c = (j + 1) * around + i, d = (j + 1) * around + next;
      valve.triangles.push_back({a, b, shift == 0 ? c : d});
      valve.triangles.push_back(shift == 0 ? Tri{b, d, c} : Tri{a, d, c});
    }
  }
  for (const Tri &t : valve.triangles) {
    const Vec3 normal = (valve.rest[t[1]] - valve.rest[t[0]])
                            .cross(valve.rest[t[2]] - valve.rest[t[0]])
                            .normalized();
    valve.triangle_fibre.push_back(Vec3(Vec3::UnitZ().cross(normal).normalized()));
  }
  make_tissue(valve, law);
  Tube tube{test::model_of_sheet(valve, ends), {}};
  for (Vec3 &p : tube.model.valve.loaded) p.head<2>() *= stretch;
  tube.straight.assign(tube.model.valve.loaded.begin(), tube.model.valve.loaded.end());
  return tube;
}

}  // namespace mvs::core::verification
