// The broad phase and its Verlet list against brute force over all pairs.
#include "collision/broad_phase.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <initializer_list>
#include <utility>

#include "base/workers.h"
#include "energy/contact.h"
#include "geometry/convex_distance.h"
#include "tests/collision/pairs.h"
#include "tests/short_run.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

bool share(const Edge &e, const Edge &f) {
  return e[0] == f[0] || e[0] == f[1] || e[1] == f[0] || e[1] == f[1];
}

template <typename Visit>
void for_edge_pairs(const Model &model, Visit &&visit) {
  const auto &edges = model.topology.edges;
  for (uint32_t i = 0; i < edges.size(); ++i) {
    for (uint32_t j = i + 1; j < edges.size(); ++j) {
      if (!share(edges[i], edges[j])) visit(i, j);
    }
  }
}

// Runs the broad phase once more on these motions.
struct MotionCase {
  const Positions &x, &to;
  double slack;
  StepMotion mode;

  Vec3 half(uint32_t i) const { return 0.5 * (to[i] - x[i]); }
  Positions middle() const { return moved(x, 0.5, moved(to, -1, x)); }
  double nearer(const std::vector<uint32_t> &a, const std::vector<uint32_t> &b) const {
    double together = 0, of_a = 0, of_b = 0;
    for (const uint32_t i : a) {
      of_a = std::max(of_a, half(i).norm());
      for (const uint32_t j : b) {
        of_b = std::max(of_b, half(j).norm());
        together = std::max(together, (half(i) - half(j)).norm());
      }
    }
    return 2 * slack + (mode == StepMotion::together ? together : of_a + of_b);
  }
  // Whether the hulls of both motions, or of their differences, are farther apart than `range`.
  bool hulls_part(const std::vector<uint32_t> &a, const std::vector<uint32_t> &b,
                  double range) const {
    Positions here, there;
    for (const uint32_t i : a) here.insert(here.end(), {x[i], to[i]});
    for (const uint32_t j : b) there.insert(there.end(), {x[j], to[j]});
    if (mode == StepMotion::together) {
      const Positions of_a = std::exchange(here, {}), of_b = std::exchange(there, {Vec3::Zero()});
      for (size_t i = 0; i < of_a.size(); ++i) {
        for (size_t j = i % 2; j < of_b.size(); j += 2) here.push_back(of_a[i] - of_b[j]);
      }
    }
    return convex_distance(here, there, 1).distance > range + 2 * slack;
  }
};

// Returns whether the lists equal those of brute force on these motions, in their order.
void check_pairs(const Model &model, const BroadPhase &broad_phase, const MotionCase &motion) {
  const double r = model.valve.contact_thickness;
  const Positions middle = motion.middle();
  const auto &barrier_list = broad_phase.barrier_candidates(),
             &contact_list = broad_phase.contact_candidates();
  const auto &list = broad_phase.barrier_edge_candidates();
  size_t k = 0, contacts = 0, pairs = 0;
  bool same = true;
  for_vertex_triangles(model, [&](uint32_t v, uint32_t t) {
    const Tri &tri = model.valve.triangles[t];
    const std::vector<uint32_t> corners(tri.begin(), tri.end());
    const double least = distance(middle, v, tri) - motion.nearer({v}, corners);
    if (least > r) return;
    const double rest = distance(model.valve.rest, v, tri), range = barrier_range(r, rest);
    const bool faces = rest >= contact_rest_distance * r;
    if (faces && !motion.hulls_part({v}, corners, r)) {
      same = same && contacts < contact_list.size() && contact_list[contacts].vertex == v &&
             contact_list[contacts].triangle == t;
      ++contacts;
    }
    if (least > range || motion.hulls_part({v}, corners, faces ? r : range)) return;
    same = same && k < barrier_list.size() && barrier_list[k].vertex == v &&
           barrier_list[k].triangle == t && barrier_list[k].range == range;
    ++k;
  });
  for_edge_pairs(model, [&](uint32_t i, uint32_t j) {
    const Edge &e = model.topology.edges[i], &f = model.topology.edges[j];
    const std::vector<uint32_t> a(e.begin(), e.end()), b(f.begin(), f.end());
    const double least = distance(middle, e, f) - motion.nearer(a, b);
    if (least > barrier_share * r) return;
    const double range = barrier_range(r, distance(model.valve.rest, e, f));
    if (least > range || motion.hulls_part(a, b, range)) return;
    same = same && pairs < list.size() && list[pairs].first == i && list[pairs].second == j &&
           list[pairs].range == range;
    ++pairs;
  });
  CHECK(same);
  CHECK(contacts == contact_list.size());
  CHECK(k == barrier_list.size());
  CHECK(pairs == list.size());
}

}  // namespace

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

// The Verlet list is kept from one build to the next, and the pairs that it checks again depend on
// all earlier builds: the result must not depend on them, for any motion and any shortened step.
void check_on_the_way(const Plates &plates, bool keep_near) {
  Random random(8);
  BroadPhase broad_phase(plates.model);
  broad_phase.use_verlet_list(keep_near);
  Positions x = wavy(plates, random);
  std::vector<size_t> found;
  const int every = short_run() ? 11 : 1;  // every kind of round occurs
  for (int round = 0; round < 96; ++round) {
    const StepMotion mode = round % 5 == 4 ? StepMotion::independent : StepMotion::together;
    const double slack = round % 7 == 6 ? 0.1e-3 : 0.02e-3;
    // slow; plate against plate; with a few fast nodes; a part of the sheet; everything fast; no
    // motion
    const int kind = (round / 8) % 6;
    const Vec3 drift = random.vector(kind == 4 ? 0.4e-3 : 0.03e-3);
    Positions step(x.size(), Vec3::Zero());
    for (size_t i = 0; i < x.size(); ++i) {
      if (kind == 5 || (kind == 3 && i % plates.upper > plates.upper / 4)) continue;
      step[i] = drift + random.vector(0.02e-3);
      if (kind == 1) step[i] = Vec3(0, 0, (i < x.size() / 2) == (round > 48) ? 0.1e-3 : -0.1e-3);
      if (kind == 2 && i % 40 == 0) step[i] += random.vector(0.6e-3);
    }
    Positions to = moved(x, 1, step);
    broad_phase.build(x, to, slack, mode);
    CAPTURE(round);
    if (round % every == 0) check_pairs(plates.model, broad_phase, {x, to, slack, mode});
    for (size_t i = 0; i < x.size(); i += 13) to[i] = x[i] + random(0, 1) * step[i];
    broad_phase.build(x, to, slack, mode);
    if (round % every == 0) check_pairs(plates.model, broad_phase, {x, to, slack, mode});
    found.push_back(broad_phase.barrier_candidates().size() +
                    broad_phase.barrier_edge_candidates().size());
    // a part of the motion, as of a shortened step
    x = moved(x, random(0.3, 1), step);
  }
  std::sort(found.begin(), found.end());
  CHECK(std::unique(found.begin(), found.end()) - found.begin() > 20);
}

TEST_CASE("candidates_do_not_depend_on_earlier_positions") {
  const Plates plates = two_plates(5, 6.25e-3, 3e-3, false, [](Valve &) {});
  check_on_the_way(plates, true);
  check_on_the_way(plates, false);
}

// So fine that pairs near each other at rest have shorter barriers, and no coordinate is a round
// number.
TEST_CASE("candidates_of_a_fine_mesh_do_not_depend_on_earlier_positions") {
  const Plates plates = two_plates(5, 1.875e-3, 3e-3, false, [](Valve &valve) {
    Random random(3);
    for (auto &place : valve.rest.edit()) place += random.vector(0.03e-3);
  });
  check_on_the_way(plates, true);
  check_on_the_way(plates, false);
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

// No block of one plate is near the other when the Verlet list is built; all blocks come near
// later, by a third of the skin a step.
TEST_CASE("pairs_that_approach_from_a_distance_are_found") {
  const Plates plates = plates_for_steps();
  Random random(5);
  BroadPhase broad_phase(plates.model);
  Positions x = wavy(plates, random);
  const Vec3 step(0.03e-3, 0, -0.1e-3);
  for (size_t i = x.size() / 2; i < x.size(); ++i) x[i] -= 60 * step;
  size_t first = 0;
  for (int k = 0; k < 60; ++k) {
    Positions to = x;
    for (size_t i = x.size() / 2; i < x.size(); ++i) to[i] += step;
    broad_phase.build(x, to, 0.02e-3);
    if (k == 0) first = broad_phase.contact_candidates().size();
    CAPTURE(k);
    if (k % 6 == 5) check_pairs(plates.model, broad_phase, {x, to, 0.02e-3, StepMotion::together});
    x = to;
  }
  CHECK(broad_phase.contact_candidates().size() > first + 30);
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
