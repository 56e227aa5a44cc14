// Vertex-to-sheet contact is continuous while the vertex slides over the facing mesh and around
// free edges.
#include <doctest/doctest.h>

#include <cmath>
#include <optional>

#include "geometry/distance.h"
#include "tests/energy/touch.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

// A large sheet at z = height(x, y) under one small triangle, whose first corner is the probe. The
// sheet has `cells` cells a side, over -8 .. 8 mm.
struct Facing {
  Model model;
  uint32_t probe;
  Positions with_probe_at(const Vec3 &p) const {
    Positions x = model.valve.rest;
    for (uint32_t k = 0; k < 3; ++k) x[probe + k] += p - model.valve.rest[probe];
    return x;
  }
};
Facing facing(uint32_t cells, const std::function<double(double x, double y)> &height) {
  Valve valve;
  add_grid(valve, cells, cells, [&](double u, double v) -> Vec3 {
    const double x = 16e-3 * u / cells - 8e-3, y = 16e-3 * v / cells - 8e-3;
    return {x, y, height(x, y)};
  });
  const auto probe = static_cast<uint32_t>(valve.rest.size());
  for (const double x : {0.0, 1.0, 0.0}) {
    const double y = valve.rest.size() == probe + 2 ? 1e-3 : 0;
    valve.rest.push_back({1e-3 * x, y, x > 0 || y > 0 ? 21e-3 : 20e-3});
  }
  valve.triangles.push_back({probe, probe + 1, probe + 2});
  valve.contact_thickness = 2e-3;
  return {model_of_sheet(valve, {}), probe};
}

// The force on the probe itself, without the sheet's vertices that contact its triangle.
struct Felt {
  double energy = 0;
  Vec3 gradient = Vec3::Zero();
};
Felt felt_by_probe(const Facing &sheet, const Vec3 &p) {
  const Positions x = sheet.with_probe_at(p);
  Touch touch(sheet.model, x, 0);
  touch.energy(x);
  Felt felt;
  for (const ContactPair &s : touch.contact_pairs()) {
    if (s.node[0] != sheet.probe || s.is_barrier) continue;
    const Barrier b = barrier(s.distance / s.range);
    felt.energy += s.strength * s.range * b.value;
    felt.gradient += s.strength * b.first * s.normal;
  }
  return felt;
}

// The flat sheet of facing() without a wedge: its free edge turns inwards.
Facing notched(uint32_t cells) {
  Facing sheet = facing(cells, [](double, double) { return 0.0; });
  Valve valve = sheet.model.valve;
  std::vector<Tri> kept;
  for (const Tri &t : valve.triangles) {
    const Vec3 middle = (valve.rest[t[0]] + valve.rest[t[1]] + valve.rest[t[2]]) / 3;
    const bool cut = middle.z() == 0 && middle.x() > 0.5e-3 && std::abs(middle.y()) < middle.x();
    if (!cut) kept.push_back(t);
  }
  valve.triangles = kept;
  valve.triangle_leaflet.clear();
  valve.triangle_scallop.clear();
  valve.triangle_thickness.clear();
  valve.triangle_fibre.clear();
  return {model_of_sheet(valve, {}), sheet.probe};
}

// The largest jump of the energy and of the force on the small triangle along a path of many short
// steps, over the largest change of the smooth parts.
void check_smooth_slide(const Facing &sheet, const Vec3 &from, const Vec3 &to) {
  constexpr int steps = 600;
  const Vec3 step = (to - from) / steps;
  // candidates of a part of the path at a time: those of the whole path would be the whole sheet
  constexpr int stretch = 30;
  std::optional<Touch> touch;
  double most = 0, force = 0;
  Vec3 last = Vec3::Zero();
  double energy = 0, worst_energy = 0;
  for (int k = 0; k <= steps; ++k) {
    const Positions x = sheet.with_probe_at(from + k * step);
    if (k % stretch == 0) touch.emplace(sheet.model, x, stretch * step.norm());
    const double e = touch->energy(x);
    const Positions all = touch->gradient(x);
    const Vec3 g = all[sheet.probe] + all[sheet.probe + 1] + all[sheet.probe + 2];
    force = std::max(force, g.norm());
    if (k > 0) {
      most = std::max(most, (g - last).norm());
      // the trapezoid rule of a force that does not jump
      worst_energy = std::max(worst_energy, std::abs(e - energy - 0.5 * (g + last).dot(step)));
    }
    last = g;
    energy = e;
  }
  REQUIRE(force > 0);
  // a continuous force changes by its slope times a step: the step is 1 / 600 of a path of a few
  // contact thicknesses, over which the force changes by some ten times itself
  CHECK(most < 0.03 * force);
  CHECK(worst_energy < 0.03 * force * step.norm());
}

}  // namespace

TEST_CASE("a_vertex_slides_over_a_mesh_without_a_jump") {
  const auto flat = [](double, double) { return 0.0; };
  const auto ridge = [](double x, double) { return -1.0 * std::abs(x); };
  const auto valley = [](double x, double) { return 0.7 * std::abs(x); };
  const auto bumps = [](double x, double y) {
    return 1e-3 * std::sin(900 * x) * std::cos(700 * y);
  };
  for (const uint32_t cells : {4u, 9u}) {
    CAPTURE(cells);
    // across nodes and edges, and past the border of the sheet
    check_smooth_slide(facing(cells, flat), {-3e-3, -2.9e-3, 1e-3}, {3.1e-3, 3e-3, 1e-3});
    check_smooth_slide(facing(cells, flat), {0, -4e-3, 0.9e-3}, {0, 4e-3, 0.9e-3});
    check_smooth_slide(facing(cells, flat), {5e-3, 1e-4, 0.9e-3}, {11e-3, 3e-4, 1.1e-3});
    check_smooth_slide(facing(cells, ridge), {-2e-3, -1e-3, 0.9e-3}, {2e-3, 1e-3, 0.9e-3});
    check_smooth_slide(facing(cells, valley), {-2e-3, -1e-3, 2.5e-3}, {2e-3, 1e-3, 2.5e-3});
    check_smooth_slide(facing(cells, bumps), {-3e-3, -2.9e-3, 2e-3}, {3.1e-3, 3e-3, 2e-3});
  }
}

TEST_CASE("a_flat_sheet_counts_once_in_a_mesh_of_any_size") {
  const Vec3 p(0.13e-3, 0.29e-3, 0.8e-3);
  for (const uint32_t cells : {2u, 5u, 12u, 40u}) {
    CAPTURE(cells);
    const Facing sheet = facing(cells, [](double, double) { return 0.0; });
    const double area = sheet.model.vertex_area[sheet.probe];
    // sums of +-1 times equal numbers: rounding
    CHECK(felt_by_probe(sheet, p).gradient.z() ==
          about(0.5 * 20e3 * area * barrier(0.4).first, 1e-9));
  }
}

TEST_CASE("a_free_edge_has_the_contact_energy_of_the_rest_of_the_sheet") {
  // from well inside to past the rim, over it, beside it and around its corner; the rim is at 8 mm
  const std::vector<Vec3> places = {
      {5.1e-3, 0.2e-3, 0.9e-3},  {7.3e-3, 0.2e-3, 0.9e-3},  {7.99e-3, 3e-3, 0.9e-3},
      {8e-3, 0, 0.9e-3},         {8.01e-3, 3e-3, 0.9e-3},   {8.9e-3, 0.1e-3, 0.7e-3},
      {8.9e-3, 0.1e-3, 0},       {8.9e-3, 0.1e-3, -0.7e-3}, {7.9e-3, 7.8e-3, -0.8e-3},
      {8.5e-3, -8.7e-3, 0.6e-3}, {8e-3, -8e-3, 1.1e-3},     {9.9e-3, 1e-3, 1e-3}};
  for (const uint32_t cells : {1u, 2u, 5u, 16u}) {
    const Facing sheet = facing(cells, [](double, double) { return 0.0; });
    const double strength = 0.5 * 20e3 * sheet.model.vertex_area[sheet.probe];
    for (const Vec3 &p : places) {
      CAPTURE(cells);
      CAPTURE(p.transpose());
      const Vec3 closest(std::clamp(p.x(), -8e-3, 8e-3), std::clamp(p.y(), -8e-3, 8e-3), 0);
      const double d = (p - closest).norm();
      const Barrier b = barrier(d / 2e-3);
      const Felt felt = felt_by_probe(sheet, p);
      // sums of +-1 times equal numbers, against the strongest of them: rounding
      CHECK(std::abs(felt.energy - strength * 2e-3 * b.value) < 1e-12 * strength * 2e-3);
      CHECK((felt.gradient - strength * b.first * (p - closest) / d).norm() < 1e-12 * strength);
    }
  }
}

TEST_CASE("a_vertex_slides_around_a_free_edge_without_a_jump") {
  const auto flat = [](double, double) { return 0.0; };
  const auto curled = [](double x, double y) { return 60 * x * x - 40 * y * y; };
  for (const uint32_t cells : {4u, 9u}) {
    CAPTURE(cells);
    const Facing sheet = facing(cells, flat), bent = facing(cells, curled);
    // over the rim and past it, along it just outside, over a corner, and down beside it
    check_smooth_slide(sheet, {6e-3, 1e-4, 0.6e-3}, {11e-3, 3e-4, 0.8e-3});
    check_smooth_slide(sheet, {8.2e-3, -3e-3, 0.8e-3}, {8.1e-3, 9.5e-3, 0.8e-3});
    check_smooth_slide(sheet, {6e-3, 6.1e-3, 0.8e-3}, {10e-3, 9.9e-3, 0.8e-3});
    check_smooth_slide(sheet, {8.9e-3, 1e-4, 1.5e-3}, {8.9e-3, 3e-4, -1.5e-3});
    check_smooth_slide(bent, {6e-3, 1e-4, 4.4e-3}, {10e-3, 3e-4, 4.4e-3});
    // along the tip of a notch and across it
    check_smooth_slide(notched(cells), {-2e-3, 1e-4, 0.9e-3}, {6e-3, 3e-4, 0.9e-3});
    check_smooth_slide(notched(cells), {3e-3, -6e-3, 0.9e-3}, {2.9e-3, 6e-3, 0.9e-3});
  }
}

TEST_CASE("a_notch_counts_at_least_once") {
  const Facing sheet = notched(9);
  const double strength = 0.5 * 20e3 * sheet.model.vertex_area[sheet.probe];
  Random random(7);
  for (int k = 0; k < 200; ++k) {
    const Vec3 p{random(-1e-3, 8e-3), random(-6e-3, 6e-3), random(0.5e-3, 1.5e-3)};
    double d2 = 1;
    for (const Tri &t : sheet.model.valve.triangles) {
      if (t[0] >= sheet.probe) continue;
      const auto &x = sheet.model.valve.rest;
      d2 = std::min(d2, closest_on_triangle(p, x[t[0]], x[t[1]], x[t[2]]).distance2);
    }
    const double once = strength * 2e-3 * barrier(std::sqrt(d2) / 2e-3).value;
    const double felt = felt_by_probe(sheet, p).energy;
    CAPTURE(p.transpose());
    CHECK(felt >= once * (1 - 1e-12) - 1e-12 * strength * 2e-3);  // rounding
    CHECK(felt <= 2 * once + 1e-12 * strength * 2e-3);
  }
}
