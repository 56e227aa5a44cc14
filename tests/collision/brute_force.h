// All pairs of a model that come near during a motion, by brute force.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "collision/broad_phase.h"
#include "energy/contact.h"
#include "geometry/convex_distance.h"
#include "tests/collision/pairs.h"

namespace mvs::core::test {

inline bool share(const Edge &e, const Edge &f) {
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

// Checks that the lists equal those of brute force on these motions, in their order.
inline void check_pairs(const Model &model, const BroadPhase &broad_phase,
                        const MotionCase &motion) {
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

}  // namespace mvs::core::test
