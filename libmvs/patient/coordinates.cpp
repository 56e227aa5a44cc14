// Harmonic function, then transport along its gradient.
#include "patient/coordinates.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "geometry/triangle_bvh.h"
#include "model/compressed_rows.h"
#include "model/sides.h"
#include "patient/fibres.h"
#include "patient/harmonic_function.h"

namespace mvs::core {
namespace {

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
  make_harmonic(sheet, held, u);
  c.annulus_length = number_annulus(sheet, rims, foot);
  const Rows stars = rows_of(n, sheet.triangles);
  const std::vector<uint8_t> at_annulus = marks_of(rims.annulus, n);
  const std::vector<uint8_t> at_edge = marks_of(rims.free_edge, n);
  FibreTransport down = carry_along_fibres(sheet, u, stars, -1, at_annulus, foot, c.annulus_length);
  const FibreTransport up = carry_along_fibres(sheet, u, stars, 1, at_edge, foot, c.annulus_length);
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
