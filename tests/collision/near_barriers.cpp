// Near barrier candidates: a candidate that is left out could neither act nor need a limit.
#include "collision/near_barriers.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "collision/approach.h"
#include "tests/collision/pairs.h"
#include "tests/model/small_valve.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

bool contains(const std::vector<VertexTriangle> &list, const VertexTriangle &c) {
  return std::any_of(list.begin(), list.end(), [&](const VertexTriangle &d) {
    return d.vertex == c.vertex && d.triangle == c.triangle && d.range == c.range;
  });
}

bool contains(const std::vector<EdgeEdge> &list, const EdgeEdge &c) {
  return std::any_of(list.begin(), list.end(), [&](const EdgeEdge &d) {
    return d.first == c.first && d.second == c.second && d.range == c.range;
  });
}

struct Seen {
  size_t kept = 0, left_out = 0;
};

// Checks every candidate by its distance at x and the lengths of the step of its nodes.
void check_selection(const Model &model, const BroadPhase &broad_phase, const NearBarriers &near,
                     const Positions &x, const Positions &dx, Seen &seen) {
  const auto length = [&](const auto &nodes) {
    double longest = 0;
    for (const uint32_t i : nodes) longest = std::max(longest, dx[i].norm());
    return longest;
  };
  const auto check = [&](bool kept, double distance, double range, double approach) {
    ++(kept ? seen.kept : seen.left_out);
    if (!kept) CHECK((distance > range && approach <= usable_share * (distance - range)));
  };
  for (const VertexTriangle &c : broad_phase.barrier_candidates()) {
    const Tri &t = model.valve.triangles[c.triangle];
    check(contains(near.triangles(), c), distance(x, c.vertex, t), c.range,
          dx[c.vertex].norm() + length(t));
  }
  for (const EdgeEdge &c : broad_phase.barrier_edge_candidates()) {
    const Edge &e = model.topology.edges[c.first], &f = model.topology.edges[c.second];
    check(contains(near.edges(), c), distance(x, e, f), c.range, length(e) + length(f));
  }
  const auto by_vertex = [](const VertexTriangle &a, const VertexTriangle &b) {
    return a.vertex != b.vertex ? a.vertex < b.vertex : a.triangle < b.triangle;
  };
  CHECK(std::is_sorted(near.triangles().begin(), near.triangles().end(), by_vertex));
}

}  // namespace

TEST_CASE("no_barrier_candidate_that_could_act_is_left_out") {
  const Plates plates = plates_for_steps();
  const Model &model = plates.model;
  Random random(3);
  Seen seen;
  for (int round = 0; round < 10; ++round) {
    NearBarriers near(0);
    const Positions x = wavy(plates, random);
    BroadPhase broad_phase(model);
    Positions to = x;
    for (Vec3 &p : to) p += random.vector(0.1e-3);
    broad_phase.build(x, to, 0.3e-3);
    for (const double share : {0.0, 0.3, 0.4, 1.0}) {
      Positions here = x, dx(x.size());
      for (size_t i = 0; i < x.size(); ++i) {
        here[i] += share * (to[i] - x[i]) + random.vector(0.02e-3);
        dx[i] = random.vector(i % 5 == 0 ? 0.05e-3 : 1e-6);
      }
      near.select(model, broad_phase, here, &dx);
      check_selection(model, broad_phase, near, here, dx, seen);
      near.select(model, broad_phase, here);
      check_selection(model, broad_phase, near, here, Positions(x.size(), Vec3::Zero()), seen);
    }
  }
  CHECK(seen.kept > 1000);
  CHECK(seen.left_out > 1000);
}

TEST_CASE("other_lists_and_short_ones_are_not_mistaken") {
  const Plates plates = plates_for_steps();
  Random random(4);
  NearBarriers near(0), whole(1u << 30);
  for (int round = 0; round < 3; ++round) {
    const Positions x = wavy(plates, random);
    BroadPhase broad_phase(plates.model);  // often at the address of the one before
    broad_phase.build(x, x, 0.3e-3);
    Seen seen;
    near.select(plates.model, broad_phase, x);
    check_selection(plates.model, broad_phase, near, x, Positions(x.size(), Vec3::Zero()), seen);
    whole.select(plates.model, broad_phase, x);
    CHECK(&whole.triangles() == &broad_phase.barrier_candidates());
    CHECK(&whole.edges() == &broad_phase.barrier_edge_candidates());
  }
}
