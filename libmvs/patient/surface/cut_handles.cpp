// Cut along a loop, caps on both sides, membrane relaxation around them.
#include "patient/surface/cut_handles.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "model/compressed_rows.h"
#include "model/sides.h"
#include "patient/findings.h"
#include "patient/surface/boundary.h"
#include "patient/surface/fill_hole.h"
#include "patient/surface/manifold.h"
#include "patient/surface/shortest_loops.h"

namespace mvs::core {
namespace {

// m: the wall of a tunnel through tissue of 2 mm is flattened up to this distance from the cut.
constexpr double smoothed_reach = 2e-3;
constexpr int smoothings = 200;  // flattens patches of 20 vertices across

Vec3 centre_of(const LeafletSheet &surface, const std::vector<uint32_t> &loop) {
  Vec3 sum = Vec3::Zero();
  for (const uint32_t i : loop) sum += surface.x[i];
  return sum / static_cast<double>(loop.size());
}

// Opens the surface along a loop: the vertices on one side of it become new ones.
void open_along(LeafletSheet &surface, const std::vector<uint32_t> &loop) {
  std::vector<Edge> cut;
  for (size_t k = 0; k < loop.size(); ++k) {
    const uint32_t a = loop[k], b = loop[(k + 1) % loop.size()];
    cut.push_back({std::min(a, b), std::max(a, b)});
  }
  std::sort(cut.begin(), cut.end());
  std::vector<uint32_t> across = join_sides(surface.x, surface.triangles).across;
  for (uint32_t side = 0; side < across.size(); ++side) {
    const uint32_t a = side_start(surface.triangles, side), b = side_end(surface.triangles, side);
    if (std::binary_search(cut.begin(), cut.end(), Edge{std::min(a, b), std::max(a, b)})) {
      across[side] = none;
    }
  }
  separate_fans(surface, across);
}

// Moves the vertices within a distance of a point that are joined to `from` to the mean of their
// neighbours (membrane relaxation).
void relax_around(LeafletSheet &surface, const std::vector<uint32_t> &from, const Vec3 &centre,
                  double reach) {
  const Rows stars = rows_of(surface.x.size(), surface.triangles);
  const std::vector<uint32_t> empty;
  std::vector<uint8_t> reached(surface.x.size(), 0), at_boundary(surface.x.size(), 0);
  for (const std::vector<uint32_t> &loop : boundary_loops(surface)) {
    for (const uint32_t i : loop) at_boundary[i] = 1;
  }
  std::vector<uint32_t> region, open = from;
  for (const uint32_t i : from) reached[i] = 1;
  while (!open.empty()) {
    const uint32_t i = open.back();
    open.pop_back();
    region.push_back(i);
    for (const uint32_t j : neighbours_in(surface.triangles, stars[i], i)) {
      if (reached[j] != 0 || at_boundary[j] != 0) continue;
      if ((surface.x[j] - centre).norm() > reach) continue;
      reached[j] = 1;
      open.push_back(j);
    }
  }
  std::sort(region.begin(), region.end());
  std::vector<std::vector<uint32_t>> around;
  around.reserve(region.size());
  for (const uint32_t i : region) {
    around.push_back(neighbours_in(surface.triangles, stars[i], i));
  }
  for (int round = 0; round < smoothings; ++round) {
    for (size_t k = 0; k < region.size(); ++k) {
      Vec3 mean = Vec3::Zero();
      for (const uint32_t j : around[k]) mean += surface.x[j];
      surface.x[region[k]] = mean / static_cast<double>(around[k].size());
    }
  }
}

void cut(LeafletSheet &surface, const SurfaceLoop &loop) {
  const size_t before = surface.x.size();
  const Vec3 centre = centre_of(surface, loop.vertices);
  const std::vector<uint8_t> on_loop = marks_of(loop.vertices, before);
  open_along(surface, loop.vertices);
  // both new boundaries, of vertices of the loop and new ones alone; a loop with a vertex on a rim
  // makes one of them a part of that rim
  std::vector<std::vector<uint32_t>> caps;
  for (std::vector<uint32_t> &rim : boundary_loops(surface)) {
    const bool is_new = std::all_of(rim.begin(), rim.end(),
                                    [&](uint32_t i) { return i >= before || on_loop[i] != 0; });
    if (is_new) caps.push_back(std::move(rim));
  }
  for (const std::vector<uint32_t> &cap : caps) fill_hole(surface, cap);
  const double reach = loop.length / 6.283185307179586 + smoothed_reach;
  for (const std::vector<uint32_t> &cap : caps) relax_around(surface, cap, centre, reach);
}

}  // namespace

size_t cut_handles(LeafletSheet &surface, size_t kept, Findings &findings) {
  size_t handles = handle_count(surface, boundary_loops(surface).size());
  std::vector<double> lengths;
  std::string places;
  while (handles > kept) {
    const std::vector<SurfaceLoop> loops = shortest_loops(surface, longest_handle);
    if (loops.empty()) break;
    const SurfaceLoop &loop = loops[0];
    const Vec3 at = centre_of(surface, loop.vertices);
    lengths.push_back(loop.length);
    if (lengths.size() <= 6) {
      places += format("%s(%.0f, %.0f, %.0f)", places.empty() ? "" : ", ", at.x() * 1e3,
                       at.y() * 1e3, at.z() * 1e3);
    }
    cut(surface, loop);
    --handles;
  }
  if (lengths.empty()) return handles;
  const double longest = *std::max_element(lengths.begin(), lengths.end());
  findings.push_back(
      {"cut_handles", FindingSource::guessed, 0.6,
       format("%zu handles (tunnels through the tissue, or bridges of tissue), the "
              "largest %.1f mm around, were cut and closed at %s mm; if leaflets are "
              "joined wrongly there, separate them in the surface",
              lengths.size(), longest * 1e3, places.c_str()),
       lengths, "m"});
  return handles;
}

}  // namespace mvs::core
