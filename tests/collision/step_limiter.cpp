// Conservative CCD: a limited step never leads through a sheet.
#include "collision/step_limiter.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "energy/contact.h"
#include "geometry/intersect.h"
#include "tests/collision/pairs.h"
#include "tests/model/small_valve.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

// Invariant of every limited step: no crossing, and no pair loses more than 90 % of its distance.
void check_motion(const Model &model, const BroadPhase &broad_phase, const Positions &x,
                  const Positions &dx) {
  for (const double share : {0.2, 0.5, 0.7, 0.9, 1.0}) {
    const Positions y = moved(x, share, dx);
    CHECK(find_intersections(y, model.valve.triangles).empty());
    double least = 1;
    for (const VertexTriangle &c : broad_phase.barrier_candidates()) {
      const Tri &t = model.valve.triangles[c.triangle];
      least = std::min(least, distance(y, c.vertex, t) / distance(x, c.vertex, t));
    }
    for (const EdgeEdge &c : broad_phase.barrier_edge_candidates()) {
      const Edge &e = model.topology.edges[c.first], &f = model.topology.edges[c.second];
      least = std::min(least, distance(y, e, f) / distance(x, e, f));
    }
    CHECK(least > 0.1 * (1 - 1e-9));  // rounding of a distance
  }
}

// The end position of the upper plate when it is pressed down for many steps.
Positions pressed(const Plates &plates, Positions x) {
  for (int round = 0; round < 60; ++round) {
    Positions dx(x.size(), Vec3::Zero());
    for (size_t i = plates.upper; i < x.size(); ++i) dx[i] = {0, 0, -1e-3};
    BroadPhase broad_phase(plates.model);
    StepLimiter().limit(plates.model, x, 0, broad_phase, dx);
    x = moved(x, 1, dx);
  }
  return x;
}

double nearest(const Model &model, const Positions &x) {
  double least = 1;
  for_vertex_triangles(model, [&](uint32_t v, uint32_t t) {
    least = std::min(least, distance(x, v, model.valve.triangles[t]));
  });
  return least;
}

}  // namespace

TEST_CASE("no_step_of_any_size_leads_through_a_sheet") {
  const Plates plates = plates_for_steps();
  const Model &model = plates.model;
  int cut = 0, wild = 0;
  for (uint64_t seed = 1; seed <= 24; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const Positions x = wavy(plates, random);
    if (!find_intersections(x, model.valve.triangles).empty()) continue;
    Positions dx = random.vectors(x.size(), seed % 2 == 0 ? 2e-3 : 0.3e-3);
    // half of them press the plates through each other as a whole
    for (size_t i = 0; seed % 4 < 2 && i < dx.size(); ++i) {
      dx[i].z() += i < plates.upper ? 1e-3 : -1e-3;
    }
    const Positions wanted = dx;
    BroadPhase broad_phase(model);
    wild += !find_intersections(moved(x, 1, dx), model.valve.triangles).empty();
    StepLimiter().limit(model, x, 0, broad_phase, dx);
    CHECK(largest(dx) > 0);
    cut += farthest(dx, wanted) > 0;
    check_motion(model, broad_phase, x, dx);
  }
  // some of the steps must have been limited
  CHECK(wild > 12);
  CHECK(cut >= wild);
}

TEST_CASE("a_crumpling_valve_never_crosses_itself") {
  const ModelPtr model = make_model(small_valve());
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    Random random(seed);
    Positions x = model->valve.rest;
    for (int step = 0; step < 12; ++step) {
      Positions dx = random.vectors(x.size(), 1.5e-3);
      for (size_t i = 0; i < x.size(); ++i) {
        dx[i].head<2>() -= 0.15 * x[i].head<2>();  // towards the axis
        if (model->topology.fixed[i]) dx[i].setZero();
      }
      BroadPhase broad_phase(*model);
      StepLimiter().limit(*model, x, 0, broad_phase, dx);
      check_motion(*model, broad_phase, x, dx);
      x = moved(x, 1, dx);
    }
  }
}

TEST_CASE("a_step_is_only_shortened_and_only_where_sheets_meet") {
  const Plates plates = plates_for_steps();
  const Model &model = plates.model;
  // the plates meet at one corner and are 3 mm apart at the other
  Positions x = model.valve.rest;
  for (size_t i = plates.upper; i < x.size(); ++i) x[i].z() = 0.3e-3 + 0.25 * x[i].x();
  Positions dx(x.size(), Vec3::Zero());
  for (size_t i = plates.upper; i < x.size(); ++i) dx[i] = {0, 0, -0.8e-3};
  const Positions wanted = dx;
  BroadPhase broad_phase(model);
  StepLimiter().limit(model, x, 0, broad_phase, dx);
  CHECK(dx[plates.upper].norm() < 0.5 * wanted[plates.upper].norm());
  check_motion(model, broad_phase, x, dx);
  int uncut = 0;
  for (size_t i = 0; i < x.size(); ++i) {
    // each node keeps its direction: a straight line down
    CHECK(dx[i].head<2>().norm() == 0);
    CHECK(dx[i].norm() <= wanted[i].norm());
    if (i < plates.upper || x[i].x() < 6e-3) continue;
    // 1.8 mm apart and more: 0.8 mm is below nine tenths of that
    CHECK(dx[i] == wanted[i]);
    ++uncut;
  }
  CHECK(uncut > 20);
}

TEST_CASE("a_separating_step_is_not_limited") {
  const Plates plates = plates_for_steps();
  const Positions x = plates.at(0.1e-3);
  Positions dx(x.size(), Vec3::Zero());
  for (size_t i = plates.upper; i < x.size(); ++i) dx[i] = {0, 0, 1e-3};
  BroadPhase broad_phase(plates.model);
  broad_phase.build(x, moved(x, 1, dx), 0);
  CHECK(StepLimiter().limit(plates.model, x, broad_phase, dx) == 1);
}

TEST_CASE("sheets_that_move_together_are_not_limited") {
  const Plates plates = plates_for_steps();
  const Positions x = plates.at(0.1e-3);
  // a hundred times their distance, in the same direction
  Positions dx(x.size(), Vec3(0, 0, 10e-3));
  const Positions wanted = dx;
  BroadPhase broad_phase(plates.model);
  broad_phase.build(x, moved(x, 1, dx), 0);
  CHECK(StepLimiter().limit(plates.model, x, broad_phase, dx) == 1);
  CHECK(farthest(dx, wanted) == 0);
}

// The distance stays seven orders of magnitude above rounding under repeated pressing.
TEST_CASE("repeated_pressing_never_brings_a_pair_to_distance_zero") {
  const Plates plates = plates_for_steps();
  const Positions x = pressed(plates, plates.at(0.1e-3));
  CHECK(nearest(plates.model, x) >= 1e-10);
  CHECK(find_intersections(x, plates.model.valve.triangles).empty());
}

// At the distance at which a pair of edges stops, its barrier bears more than the whole pressure on
// a valve, 120 mmHg on 7 cm2: no load presses tissue together harder, so an equilibrium exists.
TEST_CASE("a_stopped_pair_has_a_barrier_stronger_than_any_load") {
  const Plates plates = plates_for_steps();
  const Model &model = plates.model;
  const double range = barrier_range(model.valve.contact_thickness, 1);
  const double least = nearest(model, pressed(plates, plates.at(0.1e-3)));
  // the strength of two edges in contact.cpp, each with a third of two triangles
  double area = 0;
  for (const double of_triangle : model.rest_area) area += of_triangle;
  const double edge_area = area / static_cast<double>(model.topology.edges.size());
  const double strength = 0.25 * model.valve.contact_stiffness * 2 * edge_area;
  CHECK(-strength * barrier(least / range).first > 120 * 133.322 * 7e-4);
}

// Parts of a needle a thousandth of the contact thickness apart: a pair that stopped before its
// barrier acts would never be in equilibrium.
TEST_CASE("a_pair_that_is_close_at_rest_stops_within_the_range_of_its_barrier") {
  const double apart = 1e-6;
  const Plates plates = two_plates(8, 10e-3, apart, false, [](Valve &) {});
  const Positions x = pressed(plates, plates.at(10 * apart));
  const double range = barrier_range(plates.model.valve.contact_thickness, apart);
  CHECK(nearest(plates.model, x) < 0.01 * range);  // a barrier is a hundred times as strong there
  CHECK(nearest(plates.model, x) > 0);
  CHECK(find_intersections(x, plates.model.valve.triangles).empty());
}
