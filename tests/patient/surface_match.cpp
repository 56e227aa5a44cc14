// Matches of a closed surface in pieces.
#include "patient/fit/surface_match.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "patient/fit/closure.h"
#include "tests/about.h"
#include "tests/patient/patient_valve.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

constexpr double mm = 1e-3;

}  // namespace

TEST_CASE("each_piece_of_a_closed_surface_may_be_wound_either_way") {
  const Valve valve = patient_valve(430);
  Solver solver(Backend::fastest);
  const ModelPtr model = make_model(valve);
  const std::vector<Vec3> x = close_open(solver, model, systole).state.x;
  // the leaflets by themselves, as labels have them: points of the posterior one are copies
  ClosedSurface apart{x, {}};
  apart.points.insert(apart.points.end(), x.begin(), x.end());
  for (size_t t = 0; t < valve.triangles.size(); ++t) {
    Tri corners = valve.triangles[t];
    if (valve.triangle_leaflet[t] == 1) {
      for (uint32_t &i : corners) i += static_cast<uint32_t>(x.size());
      // a tenth of a millimetre higher, so that nothing is welded
      for (const uint32_t i : corners) apart.points[i] = x[i - x.size()] + Vec3(0, 0, 0.1 * mm);
    }
    apart.triangles.push_back(corners);
  }
  const double as_wound = distance_from(apart, *model, x);
  CHECK(as_wound < 0.11 * mm);
  for (const uint32_t turned : {0u, 1u}) {
    ClosedSurface given = apart;
    for (size_t t = 0; t < given.triangles.size(); ++t) {
      if (valve.triangle_leaflet[t] == turned) {
        std::swap(given.triangles[t][1], given.triangles[t][2]);
      }
    }
    CAPTURE(turned);
    // the same matches, but for rounding of normals
    CHECK(distance_from(given, *model, x) == about(as_wound, 1e-9));
  }
  // within a piece, and without common points
  ClosedSurface mixed{{}, {}};
  for (size_t t = 0; t < valve.triangles.size(); ++t) {
    const auto first = static_cast<uint32_t>(mixed.points.size());
    for (const uint32_t i : valve.triangles[t]) mixed.points.push_back(x[i]);
    mixed.triangles.push_back(t % 3 == 0 ? Tri{first, first + 2, first + 1}
                                         : Tri{first, first + 1, first + 2});
  }
  CHECK(distance_from(mixed, *model, x) < 1e-6 * mm);
}
