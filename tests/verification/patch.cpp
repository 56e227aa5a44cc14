// The patch: mesh, maps, stress from the forces on its rim.
#include "tests/verification/patch.h"

#include <cmath>

#include "energy/membrane.h"
#include "energy/spring.h"

namespace mvs::core::verification {
namespace {

constexpr double side = 20e-3;

// Inner nodes of a grid, moved by up to a quarter of a cell.
void disturb(Valve &valve, const std::vector<uint32_t> &rim, double cell) {
  test::Random random(3);
  std::vector<char> outer(valve.rest.size(), 0);
  for (const uint32_t node : rim) outer[node] = 1;
  for (size_t i = 0; i < valve.rest.size(); ++i) {
    const double u = random(-0.25, 0.25), v = random(-0.25, 0.25);
    if (!outer[i]) valve.rest[i] += cell * Vec3(u, v, 0);
  }
}

}  // namespace

Patch::Patch(const Published &law, uint32_t cells)
    : Patch(law, cells, law.law == LeafletLawId::spring ? equilateral : irregular) {}

Patch::Patch(const Published &law, uint32_t cells, Mesh mesh) {
  const bool even = mesh == equilateral;
  const double cell = side / cells;
  Valve valve;
  valve.leaflets.resize(1);
  valve.leaflets[0].law = law.law;
  valve.leaflets[0].constants = law.constants;
  const uint32_t first = test::add_grid(valve, cells, cells, [&](double u, double v) -> Vec3 {
    if (even) return {cell * (u + v / 2), cell * std::sqrt(0.75) * v, 0};
    return {cell * u, cell * v, 0};
  });
  rim_ = test::rim_of_grid(first, cells, cells);
  if (!even) disturb(valve, rim_, cell);
  const test::Motion motion = test::some_motion();
  const double askew = even ? 0 : 0.4;
  fibre_ = motion.turn * Vec3(std::cos(askew), std::sin(askew), 0);
  across_ = motion.turn * Vec3(-std::sin(askew), std::cos(askew), 0);
  for (Vec3 &p : valve.rest) p = motion.turn * p;
  valve.triangle_fibre.assign(valve.triangles.size(), fibre_);
  model_ = test::model_of_sheet(valve, {});
  for (size_t t = 0; t < model_.rest_area.size(); ++t) {
    volume_ += model_.rest_area[t] * model_.valve.triangle_thickness[t];
  }
}

Eigen::Vector2d Patch::in_fibre_axes(const Vec3 &v) const {
  return {v.dot(fibre_), v.dot(across_)};
}

Positions Patch::mapped(const Mat2 &f) const {
  Positions x;
  const Vec3 origin = model_.valve.rest[0];
  for (const Vec3 &p : model_.valve.rest) {
    const Eigen::Vector2d at = f * in_fibre_axes(p - origin);
    x.push_back(origin + at[0] * fibre_ + at[1] * across_);
  }
  return x;
}

Positions Patch::forces(const Positions &x) const {
  Positions g(x.size(), Vec3::Zero());
  SpringTerm(model_).gradient(x, g);
  MembraneTerm(model_).gradient(x, g);
  return g;
}

// Volume times mean nominal stress is the sum of force (x) rest place over the rim.
Mat2 Patch::stress(const Positions &x, double &inner) const {
  Positions g = forces(x);
  Mat2 sum = Mat2::Zero();
  double rim = 0;
  for (const uint32_t node : rim_) {
    const Vec3 arm = model_.valve.rest[node] - model_.valve.rest[0];
    sum += in_fibre_axes(g[node]) * in_fibre_axes(arm).transpose();
    rim = std::max(rim, g[node].norm());
    g[node].setZero();
  }
  inner = rim > 0 ? test::largest(g) / rim : 0;
  return sum / volume_;
}

double Patch::edge() const {
  return mean_edge(model_);
}

}  // namespace mvs::core::verification
