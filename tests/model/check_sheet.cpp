// Model checks of the sheet: triangles, manifold surface, winding, annulus.
#include <doctest/doctest.h>
#include <cmath>
#include <utility>
#include <vector>

#include "model/checks/check.h"
#include "model/model.h"
#include "tests/model/spoiled.h"

using namespace mvs::core;
using namespace mvs::core::spoiled;

namespace {

// Adds an isolated triangle of leaflet A.
void add_triangle(Valve &valve, const Tri &triangle) {
  valve.triangles.push_back(triangle);
  valve.triangle_leaflet.push_back(0);
}

}  // namespace

TEST_CASE("bad_triangles_are_named") {
  check_fault("triangle 96 names a node twice", 1, [](Valve &v) {
    add_triangle(v, {edge_row, edge_row, edge_row + 1});
  });
  check_fault("triangle 0 has no area", 1, [](Valve &v) {
    // corner 16 onto the side 0-1: triangle 0 collapses, its neighbours stretch
    v.rest[small_segments] = 0.5 * (v.rest[0] + v.rest[1]);
  });
  check_fault("triangle 96 has the same nodes as triangle 7", 1, [](Valve &v) {
    add_triangle(v, {v.triangles[7][2], v.triangles[7][1], v.triangles[7][0]});
  });
  check_fault("lie at the same place", 1, [](Valve &v) {
    const Chord &chord = v.chords[3];
    v.rest.push_back(v.rest[chord.b]);  // a patch that is not welded
    const uint32_t n = static_cast<uint32_t>(v.rest.size());
    v.rest.push_back(v.rest[chord.b] + Vec3(0, 0, -1e-3));
    v.rest.push_back(v.rest[chord.b] + Vec3(1e-3, 0, -1e-3));
    add_triangle(v, {n - 1, n, n + 1});
  });
  check_fault("has no fibre direction in its plane", 1, [](Valve &v) {
    v.triangle_fibre = make_model(v)->valve.triangle_fibre;
    v.triangle_fibre[2] = Vec3::Zero();
  });
  check_fault("has no fibre direction", 1, [](Valve &v) {
    v.triangle_fibre = make_model(v)->valve.triangle_fibre;
    v.triangle_fibre[2][0] = not_a_number;
  });
  check_fault("lies in leaflet P, but its scallop A2 does not", small_segments * 3, [](Valve &v) {
    v.scallops = {{0, "A2", 0}};
    v.triangle_scallop.assign(v.triangles.size(), 0);
  });
}

TEST_CASE("a_surface_that_is_no_sheet_is_named") {
  check_fault("joins 3 triangles", 1, [](Valve &v) {
    v.rest.push_back({0, 0, -4e-3});
    add_triangle(v, {small_segments, small_segments + 1, head + 4});
  });
  // as a component of its own it is not attached to the annulus either
  check_fault("touch in one point only", 2, [](Valve &v) {
    const Vec3 p = v.rest[edge_row + 1];
    v.rest.push_back(p + Vec3(0, 0, -2e-3));
    v.rest.push_back(p + Vec3(1e-3, 0, -2e-3));
    add_triangle(v, {edge_row + 1, head + 4, head + 5});
  });
  check_fault("is not attached", 1, [](Valve &v) {
    for (const double x : {0.0, 1e-3, 2e-3}) v.rest.push_back({x, x * x * 100, -10e-3});
    add_triangle(v, {head + 4, head + 5, head + 6});
  });
}

TEST_CASE("winding_faults_name_the_triangles_of_the_other_winding") {
  check_fault("triangle 20 is wound against its neighbours", 1,
              [](Valve &v) { std::swap(v.triangles[20][0], v.triangles[20][1]); });
  check_fault("triangle 0 is wound against its neighbours", 1,
              [](Valve &v) { std::swap(v.triangles[0][0], v.triangles[0][1]); });
  check_fault("the sheet faces the ventricle", 1, [](Valve &v) {
    for (Tri &t : v.triangles) std::swap(t[0], t[1]);
  });
  // a strip of five squares with its ends joined crosswise
  Valve strip;
  for (int k = 0; k < 5; ++k) {
    const double turn = 2 * std::acos(-1.0) * k / 5, half = turn / 2;
    const Vec3 out(std::cos(turn), std::sin(turn), 0);
    const Vec3 across = std::cos(half) * Vec3(0, 0, 1) + std::sin(half) * out;
    strip.rest.push_back(0.02 * out + 4e-3 * across);
    strip.rest.push_back(0.02 * out - 4e-3 * across);
  }
  for (uint32_t k = 0; k < 5; ++k) {
    const uint32_t a = 2 * k, b = a + 1, c = k < 4 ? a + 2 : 1, d = k < 4 ? a + 3 : 0;
    strip.triangles.push_back({a, b, c});
    strip.triangles.push_back({b, d, c});
  }
  strip.triangle_leaflet.assign(10, 0);
  strip.leaflets = {{0, "A"}};
  strip.annulus = {0, 2, 4, 6, 8, 1, 3, 5, 7, 9};
  const std::vector<Fault> faults = find_faults(strip);
  REQUIRE(faults.size() == 1);
  CHECK(faults[0].sentence.find("Moebius") != std::string::npos);
}

TEST_CASE("an_annulus_that_is_not_a_boundary_loop_is_named") {
  check_fault("the annulus has 2 nodes", 1, [](Valve &v) { v.annulus.resize(2); });
  check_fault("annulus node 0 appears more than once", 1, [](Valve &v) { v.annulus.push_back(0); });
  check_fault("is no corner of a triangle", 1, [](Valve &v) { v.annulus.push_back(head + 1); });
  check_fault("no edge joins them", 1, [](Valve &v) { v.annulus.erase(v.annulus.begin() + 4); });
  check_fault("no edge joins them", 2, [](Valve &v) { std::swap(v.annulus[4], v.annulus[5]); });
  check_fault("the annulus runs through the sheet", small_segments, [](Valve &v) {
    for (uint32_t &node : v.annulus) node += small_segments;
  });
}
