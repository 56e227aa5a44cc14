// Harmonic function by conjugate gradients, then transport along its gradient.
#include "patient/coordinates.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "geometry/triangle_bvh.h"
#include "model/compressed_rows.h"
#include "model/sides.h"

namespace mvs::core {
namespace {

// A symmetric weighted graph over the edges of the sheet.
struct EdgeWeights {
  std::vector<Edge> edge;
  std::vector<double> weight;
};

// Cotangent weights (Pinkall & Polthier 1993), at least 0.05 (1 / sqrt(3) for equilateral
// triangles), so that the maximum principle holds: no vertex inside is an extremum.
EdgeWeights cotangent_weights(const LeafletSheet &sheet) {
  constexpr double least = 0.05;
  EdgeWeights weights;
  const std::vector<Side> sides = sorted_sides(sheet.triangles);
  for_each_edge(sides, [&](size_t first, size_t last) {
    double sum = 0;
    for (size_t s = first; s < last; ++s) {
      const Tri &t = sheet.triangles[sides[s].triangle];
      const Vec3 &a = sheet.x[sides[s].edge[0]], &b = sheet.x[sides[s].edge[1]];
      const Vec3 &c = sheet.x[opposite_corner(t, sides[s].edge)];
      const double area = (a - c).cross(b - c).norm();
      if (area > 0) sum += 0.5 * (a - c).dot(b - c) / area;
    }
    weights.edge.push_back(sides[first].edge);
    weights.weight.push_back(std::clamp(sum, least, 1 / least));
  });
  return weights;
}

// Laplacian of `u`, zero where `held`.
void apply(const EdgeWeights &weights, const std::vector<uint8_t> &held,
           const std::vector<double> &u, std::vector<double> &out) {
  std::fill(out.begin(), out.end(), 0);
  for (size_t e = 0; e < weights.edge.size(); ++e) {
    const auto [i, j] = weights.edge[e];
    const double flow = weights.weight[e] * (u[i] - u[j]);
    out[i] += flow;
    out[j] -= flow;
  }
  for (size_t i = 0; i < out.size(); ++i) {
    if (held[i]) out[i] = 0;
  }
}

double dot(const std::vector<double> &a, const std::vector<double> &b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

// The harmonic function with the given values where `held`: conjugate gradients with the diagonal
// as preconditioner (Saad 2003, algorithm 9.1).
void make_harmonic(const EdgeWeights &weights, const std::vector<uint8_t> &held,
                   std::vector<double> &u) {
  const size_t n = u.size();
  std::vector<double> diagonal(n, 0), residual(n), direction(n), image(n), scaled(n);
  for (size_t e = 0; e < weights.edge.size(); ++e) {
    for (const uint32_t i : weights.edge[e]) diagonal[i] += weights.weight[e];
  }
  apply(weights, held, u, residual);
  for (double &r : residual) r = -r;
  const auto precondition = [&] {
    for (size_t i = 0; i < n; ++i) scaled[i] = diagonal[i] > 0 ? residual[i] / diagonal[i] : 0;
  };
  precondition();
  direction = scaled;
  double product = dot(residual, scaled);
  // 1e-13 of the first residual: a rotated sheet gets the same lengths to 1 nm
  const double enough = 1e-26 * product;
  for (size_t k = 0; k < 10 * n && product > enough; ++k) {
    apply(weights, held, direction, image);
    const double step = product / dot(direction, image);
    for (size_t i = 0; i < n; ++i) {
      u[i] += step * direction[i];
      residual[i] -= step * image[i];
    }
    precondition();
    const double next = dot(residual, scaled);
    for (size_t i = 0; i < n; ++i) direction[i] = scaled[i] + next / product * direction[i];
    product = next;
  }
}

// Where the fibre through a vertex leaves the triangles around it: the point a + share (b - a).
struct FibreStep {
  uint32_t a = none, b = none;
  double share = 0;
  double length = 0;  // m
};

// The gradient of a linear function on a triangle.
Vec3 gradient(const LeafletSheet &sheet, const std::vector<double> &u, const Tri &t) {
  const Vec3 e1 = sheet.x[t[1]] - sheet.x[t[0]], e2 = sheet.x[t[2]] - sheet.x[t[0]];
  const Vec3 normal = e1.cross(e2);
  const double area2 = normal.squaredNorm();
  if (area2 == 0) return Vec3::Zero();
  return ((u[t[1]] - u[t[0]]) * e2.cross(normal) + (u[t[2]] - u[t[0]]) * normal.cross(e1)) / area2;
}

// The step from a vertex along `sign` times the gradient: through the opposite side of one of its
// triangles, else along the edge that leads farthest per length.
FibreStep fibre_step(const LeafletSheet &sheet, const std::vector<double> &u,
                     std::span<const uint32_t> star, uint32_t vertex, double sign) {
  // relative: of two equal ways, as on a symmetric sheet, the first is taken, whatever the rounding
  constexpr double tie = 1e-6;
  // of the whole way from rim to rim, which is 1: a smaller rise is an error of the solution
  constexpr double least_gain = 1e-9;
  FibreStep best;
  double steepest = 0;
  const auto offer = [&](uint32_t a, uint32_t b, double share) {
    const Vec3 q = sheet.x[a] + share * (sheet.x[b] - sheet.x[a]);
    const double gain = sign * (u[a] + share * (u[b] - u[a]) - u[vertex]);
    const double length = (q - sheet.x[vertex]).norm();
    if (length <= 0 || gain <= least_gain || gain / length <= (1 + tie) * steepest) return;
    steepest = gain / length;
    best = {a, b, share, length};
  };
  for (const uint32_t t : star) {
    const Tri &tri = sheet.triangles[t];
    const size_t k = static_cast<size_t>(std::find(tri.begin(), tri.end(), vertex) - tri.begin());
    const uint32_t a = tri[(k + 1) % 3], b = tri[(k + 2) % 3];
    offer(a, b, 0);
    offer(b, a, 0);
    const Vec3 way = sign * gradient(sheet, u, tri);
    const Vec3 ea = sheet.x[a] - sheet.x[vertex], eb = sheet.x[b] - sheet.x[vertex];
    const Vec3 normal = ea.cross(eb);
    const double at_a = ea.cross(way).dot(normal), at_b = way.cross(eb).dot(normal);
    // the ray passes between both corners
    if (at_a > 0 && at_b > 0) offer(a, b, at_a / (at_a + at_b));
  }
  return best;
}

// Steps for vertices without one, to their nearest neighbour that has one or is held, from ring to
// ring. A triangle with two sides on a rim has such a corner: all around it is the value of the
// rim.
void complete_steps(const LeafletSheet &sheet, const Rows &stars, const std::vector<uint8_t> &held,
                    std::vector<FibreStep> &step) {
  for (bool any = true; any;) {
    any = false;
    const std::vector<FibreStep> before = step;
    for (uint32_t i = 0; i < step.size(); ++i) {
      if (held[i] != 0 || before[i].a != none) continue;
      for (const uint32_t j : neighbours_in(sheet.triangles, stars[i], i)) {
        if (held[j] == 0 && before[j].a == none) continue;
        const double length = (sheet.x[j] - sheet.x[i]).norm();
        if (step[i].a == none || length < step[i].length) step[i] = {j, j, 0, length};
      }
      any = any || step[i].a != none;
    }
  }
}

// Carries a length and a foot along the fibres: values where `held` stay. A vertex may depend on
// one that comes later in the order, so passes are repeated until nothing moves.
struct Transport {
  std::vector<double> length, foot;
};
Transport carry(const LeafletSheet &sheet, const std::vector<double> &u, const Rows &stars,
                double sign, const std::vector<uint8_t> &held, const std::vector<double> &foot,
                double loop) {
  const size_t n = u.size();
  std::vector<uint32_t> order(n);
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](uint32_t i, uint32_t j) { return sign * u[i] > sign * u[j]; });
  std::vector<FibreStep> step(n);
  for (uint32_t i = 0; i < n; ++i) {
    if (!held[i]) step[i] = fibre_step(sheet, u, stars[i], i, sign);
  }
  complete_steps(sheet, stars, held, step);
  Transport t{std::vector<double>(n, 0), foot};
  constexpr int most_passes = 100;
  constexpr double still = 1e-9;  // m
  double moved = 1;
  for (int pass = 0; pass < most_passes && moved > still; ++pass) {
    moved = 0;
    for (const uint32_t i : order) {
      const FibreStep &s = step[i];
      if (s.a == none) continue;
      const double length = s.length + t.length[s.a] + s.share * (t.length[s.b] - t.length[s.a]);
      const double way = s.share * around(t.foot[s.a], t.foot[s.b], loop);
      moved = std::max(moved, std::abs(length - t.length[i]));
      t.length[i] = length;
      t.foot[i] = wrapped(t.foot[s.a] + way, loop);
    }
  }
  return t;
}

// Arc length of each annulus vertex; the sum is the length of the loop.
double number_annulus(const LeafletSheet &sheet, const SheetRims &rims, std::vector<double> &foot) {
  double s = 0;
  for (size_t k = 0; k < rims.annulus.size(); ++k) {
    const uint32_t a = rims.annulus[k], b = rims.annulus[(k + 1) % rims.annulus.size()];
    foot[a] = s;
    s += (sheet.x[b] - sheet.x[a]).norm();
  }
  return s;
}

}  // namespace

size_t sample_at(double foot, double length, size_t count) {
  return static_cast<size_t>(wrapped(foot, length) / length * static_cast<double>(count)) % count;
}

double wrapped(double s, double length) {
  const double r = s - length * std::floor(s / length);
  return r < length ? r : 0;  // rounding
}

double around(double a, double b, double length) {
  return wrapped(b - a + 0.5 * length, length) - 0.5 * length;
}

SheetCoordinates sheet_coordinates(const LeafletSheet &sheet, const SheetRims &rims) {
  const size_t n = sheet.x.size();
  SheetCoordinates c;
  std::vector<double> u(n, 0.5), foot(n, 0);
  std::vector<uint8_t> held(n, 0);
  for (const uint32_t i : rims.annulus) {
    held[i] = 1;
    u[i] = 0;
  }
  for (const uint32_t i : rims.free_edge) {
    held[i] = 1;
    u[i] = 1;
  }
  make_harmonic(cotangent_weights(sheet), held, u);
  c.annulus_length = number_annulus(sheet, rims, foot);
  const Rows stars = rows_of(n, sheet.triangles);
  const std::vector<uint8_t> at_annulus = marks_of(rims.annulus, n);
  const std::vector<uint8_t> at_edge = marks_of(rims.free_edge, n);
  Transport down = carry(sheet, u, stars, -1, at_annulus, foot, c.annulus_length);
  const Transport up = carry(sheet, u, stars, 1, at_edge, foot, c.annulus_length);
  c.foot = std::move(down.foot);
  c.height = std::move(down.length);
  c.whole.resize(n);
  c.share.resize(n);
  for (size_t i = 0; i < n; ++i) {
    c.whole[i] = c.height[i] + up.length[i];
    c.share[i] = c.whole[i] > 0 ? c.height[i] / c.whole[i] : 0;
  }
  return c;
}

SheetPlace place_on(const LeafletSheet &sheet, const SheetCoordinates &coordinates, const Vec3 &p) {
  const TriangleBvh bvh(sheet.triangles, sheet.x);
  const TriangleBvh::Hit hit = bvh.closest(p);
  const Tri &t = sheet.triangles[hit.triangle];
  const TrianglePoint on = bvh.closest_on(hit.triangle, p);
  SheetPlace place{coordinates.foot[t[0]], 0, std::sqrt(hit.distance2)};
  double shift = 0;
  for (size_t k = 0; k < 3; ++k) {
    place.share += on.weight[k] * coordinates.share[t[k]];
    shift += on.weight[k] *
             around(coordinates.foot[t[0]], coordinates.foot[t[k]], coordinates.annulus_length);
  }
  place.foot = wrapped(place.foot + shift, coordinates.annulus_length);
  return place;
}

double triangle_foot(const SheetCoordinates &coordinates, const Tri &triangle) {
  const std::vector<double> &foot = coordinates.foot;
  const double length = coordinates.annulus_length;
  const double shift = around(foot[triangle[0]], foot[triangle[1]], length) +
                       around(foot[triangle[0]], foot[triangle[2]], length);
  return wrapped(foot[triangle[0]] + shift / 3, length);
}

std::vector<double> height_profile(const SheetRims &rims, const SheetCoordinates &coordinates,
                                   size_t count) {
  // along the free edge, feet go around the annulus once; near fans and notches several edge
  // vertices share a foot, so each sample takes the mean over the edge's stretch within its width,
  // and samples that no stretch covers take the mean of their neighbours
  const double width = coordinates.annulus_length / static_cast<double>(count);
  std::vector<double> sum(count, 0), weight(count, 0);
  const size_t n = rims.free_edge.size();
  for (size_t k = 0; k < n; ++k) {
    const uint32_t a = rims.free_edge[k], b = rims.free_edge[(k + 1) % n];
    const double from = coordinates.foot[a];
    const double way = around(from, coordinates.foot[b], coordinates.annulus_length);
    const int parts = 1 + static_cast<int>(2 * std::abs(way) / width);
    for (int q = 0; q < parts; ++q) {
      const double share = (q + 0.5) / parts;
      const double s = wrapped(from + share * way, coordinates.annulus_length);
      const size_t cell = std::min(count - 1, static_cast<size_t>(s / width));
      const double part = (std::abs(way) + 1e-6 * width) / parts;
      sum[cell] += part * ((1 - share) * coordinates.whole[a] + share * coordinates.whole[b]);
      weight[cell] += part;
    }
  }
  MVS_MUST(*std::max_element(weight.begin(), weight.end()) > 0, MVS_E_OP, "free edge",
           "the free edge has no length: give the leaflets as a surface between annulus and free "
           "edge");
  for (size_t round = 0; round < count; ++round) {
    bool open = false;
    std::vector<double> next_sum = sum, next_weight = weight;
    for (size_t k = 0; k < count; ++k) {
      if (weight[k] > 0) continue;
      open = true;
      for (const size_t j : {(k + count - 1) % count, (k + 1) % count}) {
        if (weight[j] == 0) continue;
        next_sum[k] += sum[j] / weight[j];
        next_weight[k] += 1;
      }
    }
    if (!open) break;
    sum = std::move(next_sum);
    weight = std::move(next_weight);
  }
  for (size_t k = 0; k < count; ++k) sum[k] /= weight[k];
  return sum;
}

}  // namespace mvs::core
