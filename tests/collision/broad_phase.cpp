// The broad phase against brute force over all pairs.
#include "collision/broad_phase.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <initializer_list>
#include <utility>

#include "base/workers.h"
#include "tests/collision/brute_force.h"
#include "tests/collision/pairs.h"

using namespace mvs::core;
using namespace mvs::core::test;

TEST_CASE("candidates_are_exactly_the_pairs_whose_motions_come_near") {
  const Plates plates = plates_for_steps();
  Random random(2);
  for (const StepMotion mode : {StepMotion::together, StepMotion::independent}) {
    const Positions x = wavy(plates, random);
    const Positions to = moved(x, 1, random.vectors(x.size(), 0.4e-3));
    BroadPhase broad_phase(plates.model);
    broad_phase.build(x, to, 0.05e-3, mode);
    check_pairs(plates.model, broad_phase, {x, to, 0.05e-3, mode});
    CHECK(broad_phase.contact_candidates().size() > 30);
    CHECK(broad_phase.barrier_candidates().size() > 30);
    CHECK(broad_phase.barrier_edge_candidates().size() > 30);
  }
}

// Lists of a search alone, of one shared by threads, and of the Verlet list. The turned sheet has a
// hierarchy and blocks of its own. No coordinate is a round number, so that no distance is on a
// limit, where rounding would decide.
TEST_CASE("candidates_are_the_same_in_every_frame_of_reference") {
  const auto rough = [](Valve &valve) {
    Random random(3);
    for (auto &place : valve.rest.edit()) place += random.vector(0.03e-3);
  };
  const Motion turn = some_motion();
  const Plates here = two_plates(8, 10e-3, 3e-3, false, rough);
  const Plates there = two_plates(8, 10e-3, 3e-3, false, [&](Valve &valve) {
    rough(valve);
    valve.rest = turn(valve.rest);
  });
  Workers workers(2);
  const auto same_pair = [](const VertexTriangle &p, const VertexTriangle &q) {
    return p.vertex == q.vertex && p.triangle == q.triangle;
  };
  size_t pairs = 0;
  for (const bool uses_verlet_list : {false, true}) {
    BroadPhase of_here(here.model), of_there(there.model);
    of_here.use_verlet_list(uses_verlet_list);
    of_there.use_verlet_list(uses_verlet_list);
    if (!uses_verlet_list) of_there.use_workers(&workers);
    Random random(17);
    const Positions x = wavy(here, random);
    for (int round = 0; round < 12; ++round) {
      CAPTURE(uses_verlet_list);
      CAPTURE(round);
      const StepMotion mode = round % 4 == 3 ? StepMotion::independent : StepMotion::together;
      // the Verlet list is used from the second small step in a row
      const double longest = round < 4 ? 0.5e-3 : 0.06e-3;
      const Positions to = moved(x, 1, random.vectors(x.size(), longest));
      of_here.build(x, to, 0.02e-3, mode);
      of_there.build(turn(x), turn(to), 0.02e-3, mode);
      CHECK(std::ranges::equal(of_here.contact_candidates(), of_there.contact_candidates(),
                               same_pair));
      CHECK(std::ranges::equal(of_here.barrier_candidates(), of_there.barrier_candidates(),
                               same_pair));
      CHECK(std::ranges::equal(of_here.barrier_edge_candidates(),
                               of_there.barrier_edge_candidates(),
                               [](const EdgeEdge &p, const EdgeEdge &q) {
                                 return p.first == q.first && p.second == q.second;
                               }));
      pairs += of_here.barrier_candidates().size();
    }
  }
  CHECK(pairs > 1000);
}

TEST_CASE("no_pair_meets_during_a_motion_without_being_a_candidate") {
  const Plates plates = plates_for_steps();
  const Model &model = plates.model;
  const double r = model.valve.contact_thickness, slack = 0.05e-3;
  Random random(12);
  size_t met = 0;
  for (int round = 0; round < 20; ++round) {
    const StepMotion mode = round % 2 == 0 ? StepMotion::together : StepMotion::independent;
    const Positions x = wavy(plates, random);
    const Positions step = random.vectors(x.size(), 1e-3);
    BroadPhase broad_phase(model);
    broad_phase.build(x, moved(x, 1, step), slack, mode);
    // random points of the motion, all nodes together or each node by itself
    Positions y = x;
    const double common = random(0, 1);
    // least squares find the fraction to a few percent of the slack, hence the nine tenths
    for (size_t i = 0; i < y.size(); ++i) {
      const double share = mode == StepMotion::together ? common : random(0, 1);
      y[i] += share * step[i] + random.vector(0.9 * slack / std::sqrt(3.0));
    }
    REQUIRE(broad_phase.valid_for(y));
    const auto &barrier_list = broad_phase.barrier_candidates(),
               &contact_list = broad_phase.contact_candidates();
    const auto listed = [](const std::vector<VertexTriangle> &list, uint32_t v, uint32_t t) {
      return std::any_of(list.begin(), list.end(),
                         [&](const VertexTriangle &c) { return c.vertex == v && c.triangle == t; });
    };
    bool all = true;
    for_vertex_triangles(model, [&](uint32_t v, uint32_t t) {
      const double now = distance(y, v, model.valve.triangles[t]);
      if (now >= r) return;
      const double rest = distance(model.valve.rest, v, model.valve.triangles[t]);
      if (rest >= contact_rest_distance * r) all = all && listed(contact_list, v, t);
      if (now >= barrier_range(r, rest)) return;
      ++met;
      all = all && listed(barrier_list, v, t);
    });
    for_edge_pairs(model, [&](uint32_t i, uint32_t j) {
      const Edge &e = model.topology.edges[i], &f = model.topology.edges[j];
      const double now = distance(y, e, f);
      if (now >= barrier_share * r || now >= barrier_range(r, distance(model.valve.rest, e, f)))
        return;
      ++met;
      const auto &list = broad_phase.barrier_edge_candidates();
      all = all && std::any_of(list.begin(), list.end(),
                               [&](const EdgeEdge &c) { return c.first == i && c.second == j; });
    });
    CHECK(all);
  }
  CHECK(met > 1000);
}

TEST_CASE("the_validity_range_of_candidates_is_known") {
  const Plates plates = plates_for_steps();
  Random random(3);
  const Positions x = wavy(plates, random);
  BroadPhase broad_phase(plates.model);
  CHECK_FALSE(broad_phase.valid_for(x));
  Positions to = x;
  to[6].z() += 1e-3;
  to[7].z() += 1e-3;
  for (const StepMotion mode : {StepMotion::together, StepMotion::independent}) {
    broad_phase.build(x, to, 1e-4, mode);
    Positions y = x;
    CHECK(broad_phase.valid_for(y));
    y[5].x() += 0.99e-4;
    y[6].z() += 0.7e-3;
    y[7].z() += 0.7e-3;
    y[6].x() += 0.99e-4;
    CHECK(broad_phase.valid_for(y));
    y[5].x() += 0.02e-4;
    CHECK_FALSE(broad_phase.valid_for(y));
    y[5] = x[5];
    y[6].x() += 0.02e-4;
    CHECK_FALSE(broad_phase.valid_for(y));
    // one node ahead of the other by more than the slack in either direction
    y[6] = to[6];
    CHECK(broad_phase.valid_for(y) == (mode == StepMotion::independent));
  }
}

// As in a solver step that is first limited, then shortened as a whole.
TEST_CASE("candidates_recall_the_first_motion_from_a_position") {
  const Plates plates = plates_for_steps();
  Random random(77);
  const Positions x = wavy(plates, random), step = random.vectors(x.size(), 0.3e-3);
  const Positions to = moved(x, 1, step), quarter = moved(x, 0.25, step);
  const double slack = 0.02e-3;
  Positions cut = to;
  for (size_t i = 0; i < cut.size(); i += 13) cut[i] = x[i];
  BroadPhase broad_phase(plates.model);
  broad_phase.build(x, x, slack);  // zero motion
  broad_phase.build(x, to, slack);
  CHECK_FALSE(broad_phase.recall(x, quarter));  // no other motion is stored
  broad_phase.build(x, cut, slack);
  CHECK_FALSE(broad_phase.recall(to, to));
  CHECK_FALSE(broad_phase.recall(x, moved(quarter, 1, random.vectors(x.size(), 0.1e-3))));
  CHECK(broad_phase.valid_for(cut));
  CHECK_FALSE(broad_phase.valid_for(quarter));
  REQUIRE(broad_phase.recall(x, quarter));
  CHECK(broad_phase.valid_for(quarter));
  CHECK(broad_phase.valid_for(to));
  check_pairs(plates.model, broad_phase, {x, to, slack, StepMotion::together});
  // the pairs found from there are complete
  broad_phase.build(x, cut, slack);
  check_pairs(plates.model, broad_phase, {x, cut, slack, StepMotion::together});
}
