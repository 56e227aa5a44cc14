// The bending energy of a sheet rolled to a cylinder, on meshes of several kinds.
#include <mvs/valve.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>

#include "energy/bending.h"
#include "tests/verification/patch.h"
#include "tests/verification/study.h"

namespace mvs::core::verification {
namespace {

constexpr double side = 20e-3, curl = 100e-3;  // m, of the sheet; radius of the cylinder

enum class Kind { equilateral, right_angled, crossed, irregular };
const char *name_of(Kind kind) {
  switch (kind) {
    case Kind::equilateral:
      return "equilateral";
    case Kind::right_angled:
      return "right-angled, diagonals alike";
    case Kind::crossed:
      return "right-angled, diagonals in turn";
    default:
      return "irregular";
  }
}

Valve sheet_of(Kind kind, uint32_t cells) {
  Valve valve;
  const double cell = side / cells;
  const bool even = kind == Kind::equilateral || kind == Kind::irregular;
  test::Random random(13);
  test::add_grid(valve, cells, cells, [&](double u, double v) -> Vec3 {
    const double away = kind == Kind::irregular ? 0.2 : 0;
    const double du = random(-away, away), dv = random(-away, away);
    if (even) return {cell * (u + v / 2 + du), cell * (std::sqrt(0.75) * v + dv), 0};
    return {cell * u, cell * v, 0};
  });
  if (kind != Kind::crossed) return valve;
  for (uint32_t k = 0; k < cells * cells; ++k) {
    if ((k / cells + k % cells) % 2 == 0) continue;
    const Tri one = valve.triangles[2 * k], two = valve.triangles[2 * k + 1];  // abc, bdc
    valve.triangles[2 * k] = {one[0], two[1], one[2]};
    valve.triangles[2 * k + 1] = {one[0], one[1], two[1]};
  }
  return valve;
}

// A sheet and the directions in which it is bent.
using Shape = std::function<Vec3(const Vec3 &flat)>;

// Bending energy per area. Tissue at the border has almost no stiffness, so that every triangle
// that counts has hinges on all sides: each takes half of their energy.
double energy_per_area(Kind kind, uint32_t cells, const Shape &shape) {
  Valve valve = sheet_of(kind, cells);
  valve.leaflets.resize(1);
  Model model = test::model_of_sheet(valve, {});
  double area = 0;
  for (size_t t = 0; t < valve.triangles.size(); ++t) {
    const uint32_t cell = static_cast<uint32_t>(t) / 2, i = cell % cells, j = cell / cells;
    const bool inside = i > 0 && i + 1 < cells && j > 0 && j + 1 < cells;
    if (inside) area += model.rest_area[t];
    model.valve.triangle_thickness[t] = inside ? 1e-3 : 1e-9;
  }
  Positions x = model.valve.rest;
  for (Vec3 &p : x) p = shape(p);
  return BendingTerm(model).energy(x) / area;
}

constexpr double rigidity = 100e3 * 1e-9 / (12 * 0.75);  // D of 100 kPa and 1 mm, nu = 1/2

double energy_ratio(Kind kind, uint32_t cells, double direction) {
  const Eigen::Rotation2Dd turn(direction);
  const auto roll = [&](const Vec3 &p) -> Vec3 {
    const Eigen::Vector2d at = turn.inverse() * p.head<2>();
    const Eigen::Vector2d to = turn * Eigen::Vector2d(curl * std::sin(at[0] / curl), at[1]);
    return {to[0], to[1], curl * (1 - std::cos(at[0] / curl))};
  };
  return energy_per_area(kind, cells, roll) / (0.5 * rigidity / (curl * curl));
}

// Slightly bent both ways: z = (k1 x^2 + k2 y^2) / 2 + k12 x y.
Row curvature(const char *name, double k1, double k2, double k12) {
  const double size = 0.01;  // 1/m: slopes of 3e-4
  const double e = energy_per_area(Kind::equilateral, 20, [&](const Vec3 &p) -> Vec3 {
    const double x = p.x(), y = p.y();
    return {x, y, size * (0.5 * (k1 * x * x + k2 * y * y) + k12 * x * y)};
  });
  const double trace = k1 + k2, square = k1 * k1 + k2 * k2 + 2 * k12 * k12, nu = -1. / 3;
  return {name, 0, 0, e / (rigidity * size * size), 0.5 * ((1 - nu) * square + nu * trace * trace)};
}

Study study_of(const std::string &name, const std::string &title) {
  Study s;
  s.name = name;
  s.title = title;
  s.quantity = "bending energy over D kappa^2 / 2 per area";
  s.x = "direction of the cylinder, degrees";
  s.level = "edge, m";
  s.source = "a cylinder of 100 mm radius: D kappa^2 / 2";
  return s;
}

}  // namespace

std::vector<Study> mesh_studies() {
  Study even = study_of("bending_lattice", "Bending energy of a cylinder, equilateral triangles");
  even.expects = "2: chords for arcs";
  even.tolerance = 0.01;
  even.order_low = 1.8;
  even.order_high = 2.2;
  Study other = study_of("bending_meshes", "Bending energy of a cylinder, other triangles");
  other.expects = "none: what a hinge sees depends on the shape of its triangles at any size";
  for (const Kind kind : {Kind::equilateral, Kind::right_angled, Kind::crossed, Kind::irregular}) {
    Study &study = kind == Kind::equilateral ? even : other;
    for (const double degrees : {0.0, 30.0, 45.0, 90.0}) {
      for (const uint32_t cells : {10u, 20u, 40u}) {
        study.rows.push_back({name_of(kind), degrees, side / cells,
                              energy_ratio(kind, cells, degrees * test::pi / 180), 1});
      }
    }
  }
  Study plate = study_of("bending_plate", "Bending energy of a lattice curved both ways");
  plate.quantity = "bending energy over D kappa^2 per area";
  plate.x = plate.level = "";
  plate.source = "a plate of nu = -1/3, derived in tests/verification/bending.cpp";
  plate.expects =
      "exact for slight curvatures; tissue, nu = 1/2, has 1.5 for the dome, 0.5 for "
      "saddle and twist";
  plate.tolerance = 1e-5;  // slopes of 3e-4, squared
  plate.rows = {curvature("cylinder", 1, 0, 0), curvature("dome", 1, 1, 0),
                curvature("saddle", 1, -1, 0), curvature("twist", 0, 0, 1),
                curvature("free to curl", 1, 1. / 3, 0)};
  return {even, other, plate};
}

}  // namespace mvs::core::verification
