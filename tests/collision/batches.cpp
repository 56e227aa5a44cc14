// Batches against one at a time: the hierarchy of swept boxes and the SIMD batch of them beside
// boxes in double precision, batched distances beside scalar ones.
#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <vector>

#include "geometry/distance.h"
#include "geometry/distance_batch.h"
#include "geometry/swept_aabb_batch.h"
#include "geometry/swept_bvh.h"
#include "tests/collision/pairs.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

// Boxes around a set of nodes at both ends of their motion. For independent nodes both are the box
// of the whole motion.
struct SweptAabb {
  struct Box {
    std::array<double, 3> low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
    void add(const double *p) {
      for (int k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], p[k]);
        high[k] = std::max(high[k], p[k]);
      }
    }
    void add(const Box &other) {
      add(other.low.data());
      add(other.high.data());
    }
  };
  Box start, end;

  void add(const SweptAabb &other) {
    start.add(other.start);
    end.add(other.end);
  }

  template <typename Nodes>
  static SweptAabb of(const Nodes &nodes, const std::vector<Vec3> &x, const std::vector<Vec3> &to,
                      StepMotion mode) {
    SweptAabb box;
    for (const uint32_t i : nodes) {
      box.start.add(x[i].data());
      box.end.add(to[i].data());
    }
    if (mode == StepMotion::independent) {
      box.start.add(box.end);
      box.end = box.start;
    }
    return box;
  }
};

// Returns whether two swept boxes keep more than `margin` apart. Their sides move no faster than
// linearly towards each other, so that a gap along one axis at both ends is a gap all the time.
bool apart(const SweptAabb &a, const SweptAabb &b, double margin) {
  for (uint32_t k = 0; k < 3; ++k) {
    if (a.start.low[k] - b.start.high[k] > margin && a.end.low[k] - b.end.high[k] > margin) {
      return true;
    }
    if (b.start.low[k] - a.start.high[k] > margin && b.end.low[k] - a.end.high[k] > margin) {
      return true;
    }
  }
  return false;
}

// A motion of all nodes.
struct BoxMotion {
  const Positions &x, &to;
  StepMotion mode;
};

CornerF to_corner(const Vec3 &p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()), 0};
}

template <typename Nodes>
SweptAabbF swept_box(const Nodes &nodes, const BoxMotion &motion) {
  SweptAabbF swept;
  for (const uint32_t i : nodes) {
    swept.add(SweptPointF{to_corner(motion.x[i]), to_corner(motion.to[i])});
  }
  if (motion.mode == StepMotion::independent) swept.join_ends();
  return swept;
}

double farthest(const BoxMotion &motion) {
  double most = 0;
  for (const Positions *places : {&motion.x, &motion.to}) {
    for (const Vec3 &p : *places) most = std::max(most, p.cwiseAbs().maxCoeff());
  }
  return most;
}

// n triangles with random positions in a cube, each with a motion of its own.
struct Scattered {
  Positions x, to;
  std::vector<Tri> triangles;

  Scattered(uint32_t n, Random &random) : x(random.vectors(size_t{3} * n, 1)) {
    for (uint32_t t = 0; t < n; ++t) triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    for (uint32_t i = 0; i < x.size(); ++i) x[i] = x[i - i % 3] + random.vector(0.1);
    to = moved(x, 1, random.vectors(x.size(), 0.2));
  }
};

}  // namespace

TEST_CASE("a_bvh_of_moving_triangles_finds_the_pairs_of_brute_force") {
  Random random(1);
  for (const uint32_t n : {0u, 1u, 2u, 60u, 200u}) {
    const Scattered sheet(n, random);
    SweptBvh tree(sheet.x, sheet.triangles);
    const auto &start = tree.topology().leaf_start;
    std::vector<uint32_t> block_of(n);
    std::vector<uint8_t> still(tree.topology().leaf_count());
    for (uint32_t b = 0; b < tree.topology().leaf_count(); ++b) {
      CHECK(start[b + 1] - start[b] <= SweptAabb8::count);
      still[b] = b % 3 == 0;
      for (uint32_t k = start[b]; k < start[b + 1]; ++k) block_of[tree.topology().order[k]] = b;
    }
    for (const StepMotion mode : {StepMotion::together, StepMotion::independent}) {
      const BoxMotion motion = {sheet.x, sheet.to, mode};
      std::vector<SweptAabbF> blocks(tree.topology().leaf_count());
      for (uint32_t t = 0; t < n; ++t) {
        blocks[block_of[t]].add(swept_box(sheet.triangles[t], motion));
      }
      tree.refit(blocks, still);
      std::vector<Edge> found;
      tree.for_near_leaves(float_margin(0.05, farthest(motion)), [&](uint32_t a, uint32_t b) {
        CHECK_FALSE((still[a] && still[b]));
        found.push_back({std::min(a, b), std::max(a, b)});
      });
      std::sort(found.begin(), found.end());
      CHECK(std::adjacent_find(found.begin(), found.end()) == found.end());
      bool all = true;
      for (uint32_t a = 0; a < n; ++a) {
        for (uint32_t b = a + 1; b < n; ++b) {
          const Edge pair = {std::min(block_of[a], block_of[b]),
                             std::max(block_of[a], block_of[b])};
          if ((still[pair[0]] && still[pair[1]]) ||
              apart(SweptAabb::of(sheet.triangles[a], sheet.x, sheet.to, mode),
                    SweptAabb::of(sheet.triangles[b], sheet.x, sheet.to, mode), 0.05)) {
            continue;
          }
          all = all && std::binary_search(found.begin(), found.end(), pair);
        }
      }
      CHECK(all);
    }
  }
}

// Finds every near pair, and no pair that single precision can prove to be farther; empty entries
// of the SIMD batch are near no box.
TEST_CASE("a_simd_batch_of_swept_boxes_finds_the_same_near_pairs_as_scalar_boxes") {
  Random random(6);
  for (const StepMotion mode : {StepMotion::together, StepMotion::independent}) {
    size_t found = 0;
    for (int round = 0; round < 200; ++round) {
      const Scattered sheet(13, random);
      const BoxMotion motion = {sheet.x, sheet.to, mode};
      const double margin = random(0, 0.5);
      SweptAabb8 here, there;
      SweptAabbF box;
      for (uint32_t t = 0; t < 13; ++t) {
        const SweptAabbF swept = swept_box(sheet.triangles[t], motion);
        (t < 8 ? here : there).set(t < 8 ? t : t - 8, swept);
        if (t >= 8) box.add(swept);
      }
      SweptAabb8::PairBits near;
      const float wide = float_margin(margin, farthest(motion));
      const uint32_t of = find_near(here, box, wide);
      const uint32_t some = find_near(here, of, there, wide, near);
      CHECK((some & ~of) == 0);
      for (uint32_t i = 0; i < 8; ++i) {
        const uint32_t bits = (some >> i & 1) != 0 ? near[i] : 0;
        CHECK(bits < 32);
        CHECK(((some >> i & 1) != 0) == (bits != 0));
        for (uint32_t j = 0; j < 5; ++j) {
          const SweptAabb a = SweptAabb::of(sheet.triangles[i], sheet.x, sheet.to, mode);
          const SweptAabb b = SweptAabb::of(sheet.triangles[8 + j], sheet.x, sheet.to, mode);
          const bool is_near = (bits >> j & 1) != 0;
          if (!apart(a, b, margin)) CHECK(is_near);
          if (is_near) CHECK_FALSE(apart(a, b, margin + 2e-6));
          found += is_near;
        }
      }
    }
    CHECK(found > 500);
  }
}

// Positions: random, coincident, coplanar, parallel, degenerate (zero length).
TEST_CASE("batched_distances_have_the_bits_of_scalar_distances") {
  Random random(9);
  const auto same = [](double a, double b) {
    return std::bit_cast<uint64_t>(a) == std::bit_cast<uint64_t>(b);
  };
  bool all = true;
  DistanceBatch rows;
  for (int round = 0; round < 400; ++round) {
    std::array<std::array<Vec3, 4>, DistanceBatch::most> pair;
    const uint32_t count = 1 + static_cast<uint32_t>(round) % DistanceBatch::most;
    for (uint32_t k = 0; k < count; ++k) {
      auto &[p, a, b, c] = pair[k];
      for (Vec3 &q : pair[k]) q = Vec3(0.01, 0.02, 0.03) + random.vector(1e-3);
      if (k % 8 == 1) c = p + (b - a);
      if (k % 8 == 2) c = p + 2 * (a - p);
      if (k % 8 == 3) a = b;
      if (k % 8 == 4) c = b = a;
      if (k % 8 == 5) p = 0.25 * a + 0.25 * b + 0.5 * c;
      if (k % 8 == 6) c = a + 0.5 * (b - a);
      if (k % 8 == 7) p = a;
      for (uint32_t i = 0; i < 4; ++i) rows.set(k, i, pair[k][i]);
    }
    measure_triangles(rows, count);
    for (uint32_t k = 0; k < count; ++k) {
      const auto &[p, a, b, c] = pair[k];
      all = all && same(rows.distance2[k], closest_on_triangle(p, a, b, c).distance2);
    }
    measure_segments(rows, count);
    for (uint32_t k = 0; k < count; ++k) {
      const auto &[p, a, b, c] = pair[k];
      all = all && same(rows.distance2[k], closest_of_segments(p, a, b, c).distance2);
    }
    for (const uint32_t split : {1u, 2u}) {
      measure_farthest(rows, count, split);
      for (uint32_t k = 0; k < count; ++k) {
        double most = 0;
        for (uint32_t i = 0; i < split; ++i) {
          for (uint32_t j = split; j < 4; ++j) {
            most = std::max(most, (pair[k][i] - pair[k][j]).squaredNorm());
          }
        }
        all = all && same(rows.distance2[k], most);
      }
    }
  }
  CHECK(all);
}
