// Models: completed parts, derived quantities, and the hash.
#include "model/model.h"

#include <doctest/doctest.h>
#include <Eigen/Geometry>
#include <functional>
#include <limits>
#include <numeric>
#include <set>

#include "tests/about.h"
#include "tests/model/small_valve.h"

using namespace mvs::core;
using mvs::core::test::about;

namespace {

std::array<uint64_t, 2> fresh_hash(const ModelPtr &model) {
  return hash_of(*model, initial_state(*model));
}

constexpr double rounding = 1e-12;  // relative, of a sum of some hundred doubles

}  // namespace

TEST_CASE("parts_get_ids_and_names") {
  const ModelPtr model = make_model(small_valve());
  const Valve &valve = model->valve;
  std::set<Id> ids;
  std::set<std::string> names;
  for (const Leaflet &part : valve.leaflets) ids.insert(part.id);
  for (const Scallop &part : valve.scallops) ids.insert(part.id);
  for (const Head &part : valve.heads) ids.insert(part.id);
  for (const Chord &part : valve.chords) {
    ids.insert(part.id);
    names.insert(part.name);
  }
  CHECK(ids.size() == 2 + 2 + 2 + 12);
  CHECK(*ids.begin() == 1);
  CHECK(*ids.rbegin() + 1 == valve.next_id);
  CHECK(names.size() == 12);
  CHECK(valve.scallops[1].name == "P");
  CHECK(valve.scallops[1].leaflet == 1);
  CHECK(valve.heads[0].name == "PM1");
  CHECK(valve.chords[0].name == "PM1/1");  // a trunk is named after its head
  CHECK(valve.chords[1].name == "A/1");
}

TEST_CASE("given_names_and_ids_are_kept_and_unique") {
  Valve valve = small_valve();
  valve.heads[1].name = "PM1";
  valve.chords[5].name = "A/1";
  valve.chords[5].id = 3;
  const ModelPtr model = make_model(valve);
  CHECK(model->valve.heads[0].name == "PM2");
  CHECK(model->valve.chords[1].name == "A/2");
  CHECK(model->valve.chords[5].id == 3);
  CHECK(model->valve.leaflets[0].id == 4);
  Valve again = model->valve;
  again.chords[0].id = 0;
  CHECK(make_model(again)->valve.chords[0].id == model->valve.next_id);
}

TEST_CASE("completing_twice_changes_nothing") {
  const ModelPtr once = make_model(small_valve());
  CHECK(fresh_hash(make_model(once->valve)) == fresh_hash(once));
}

TEST_CASE("fibres_run_around_the_valve_in_the_plane_of_their_triangle") {
  const ModelPtr model = make_model(small_valve());
  const Valve &valve = model->valve;
  for (size_t t = 0; t < valve.triangles.size(); ++t) {
    const Vec3 &a = valve.rest[valve.triangles[t][0]], &b = valve.rest[valve.triangles[t][1]],
               &c = valve.rest[valve.triangles[t][2]];
    const Vec3 normal = (b - a).cross(c - a).normalized(), middle = (a + b + c) / 3;
    const Vec3 &fibre = valve.triangle_fibre[t];
    CHECK(fibre.norm() == about(1, rounding));
    CHECK(std::abs(fibre.dot(normal)) < 1e-12);  // rounding of a unit vector
    // on a funnel of 16 sides the centroid of a triangle is at most half a side off the fibre's
    // angle
    const Vec3 around = Vec3(0, 0, 1).cross(middle).normalized();
    CHECK(std::abs(fibre.dot(around)) > std::cos(std::acos(-1.0) / small_segments));
  }
}

TEST_CASE("given_fibres_are_projected_into_the_plane_and_normalised") {
  Valve valve = small_valve();
  valve.triangle_fibre.assign(valve.triangles.size(), Vec3(0.1, 0.2, -3));
  const ModelPtr model = make_model(valve);
  for (const Vec3 &fibre : model->valve.triangle_fibre) {
    CHECK(fibre.norm() == about(1, rounding));
    CHECK(fibre[2] < 0);
  }
  CHECK(fresh_hash(make_model(model->valve)) == fresh_hash(model));
}

TEST_CASE("areas_and_lengths_are_those_of_the_funnel") {
  const ModelPtr model = make_model(small_valve());
  // each ring is a row of flat trapezia between two regular polygons
  double expected = 0;
  const double pi = std::acos(-1.0), half = pi / small_segments;
  for (uint32_t row = 0; row + 1 < small_rows; ++row) {
    const double r = 15e-3 - 2e-3 * row, q = r - 2e-3;
    const double height = std::hypot(2e-3 * std::cos(half), 6e-3);
    expected += small_segments * (r + q) * std::sin(half) * height;
  }
  const auto sum = [](const std::vector<double> &v) {
    return std::accumulate(v.begin(), v.end(), 0.0);
  };
  CHECK(sum(model->rest_area) == about(expected, rounding));
  CHECK(sum(model->vertex_area) == about(expected, rounding));
  for (size_t e = 0; e < model->topology.edges.size(); ++e) {
    const Edge &edge = model->topology.edges[e];
    CHECK(model->rest_length[e] ==
          (model->valve.rest[edge[0]] - model->valve.rest[edge[1]]).norm());
  }
}

TEST_CASE("mass_is_that_of_sheet_and_chordae") {
  Valve valve = small_valve();
  valve.triangle_thickness.assign(valve.triangles.size(), 2e-3);
  const ModelPtr model = make_model(valve);
  double expected = 0, lumped = 0;
  for (const double area : model->rest_area) expected += 1060 * 2e-3 * area;
  for (const Chord &chord : model->valve.chords) {
    expected += 1060 * chord.area * chord.rest_length;
  }
  for (const double mass : model->node_mass) lumped += mass;
  CHECK(lumped == about(expected, rounding));
  // a branch point carries half of its three segments
  double half = 0;
  for (int c = 0; c < 3; ++c)
    half += 0.5 * 1060 * model->valve.chords[c].area * model->valve.chords[c].rest_length;
  CHECK(model->node_mass[small_rows * small_segments + 1] == about(half, rounding));
}

TEST_CASE("a_new_valve_rests_without_load") {
  const ModelPtr model = make_model(small_valve());
  const State state = initial_state(*model);
  CHECK(state.x == model->valve.rest);
  for (const Vec3 &v : state.v) CHECK(v == Vec3::Zero());
  CHECK(state.load.pressure == 0);
  CHECK(state.load.boundary_fraction == 0);
}

TEST_CASE("prescribed_nodes_move_from_open_to_loaded") {
  Valve valve = small_valve();
  valve.loaded = valve.rest;
  valve.loaded[3] += Vec3(1e-3, 0, -2e-3);
  const ModelPtr model = make_model(valve);
  CHECK(model->target(3, 0) == valve.rest[3]);
  CHECK((model->target(3, 1) - valve.loaded[3]).norm() < 1e-17);  // one rounding of 15 mm
  CHECK((model->target(3, 0.5) - valve.rest[3] - Vec3(0.5e-3, 0, -1e-3)).norm() < 1e-17);
}

TEST_CASE("the_hash_depends_on_every_input") {
  const ModelPtr base = make_model(small_valve());
  const State start = initial_state(*base);
  std::set<std::array<uint64_t, 2>> hashes = {hash_of(*base, start)};
  size_t expected = 1;
  const auto model_differs = [&](const std::function<void(Model &)> &change) {
    Model model = *base;
    change(model);
    hashes.insert(hash_of(model, start));
    CHECK(hashes.size() == ++expected);
  };
  model_differs([](Model &m) { m.valve.name = "other"; });
  model_differs([](Model &m) { m.valve.rest[7][1] = std::nextafter(m.valve.rest[7][1], 1.0); });
  model_differs([](Model &m) { m.valve.loaded[7][1] += 1e-3; });
  model_differs([](Model &m) { std::swap(m.valve.triangles[0], m.valve.triangles[1]); });
  model_differs([](Model &m) { m.valve.triangle_leaflet[0] = 1; });
  model_differs([](Model &m) { m.valve.triangle_scallop[0] = 1; });
  model_differs([](Model &m) { m.valve.triangle_thickness[0] = 2e-3; });
  model_differs([](Model &m) { m.valve.triangle_fibre[0] *= -1; });
  model_differs([](Model &m) { std::swap(m.valve.annulus[0], m.valve.annulus[1]); });
  model_differs([](Model &m) { m.valve.leaflets[0].name = "B"; });
  model_differs([](Model &m) { m.valve.leaflets[0].id = 99; });
  model_differs([](Model &m) { m.valve.leaflets[0].law = LeafletLawId::bilinear; });
  model_differs([](Model &m) { m.valve.leaflets[0].thickness = 2e-3; });
  model_differs([](Model &m) { m.valve.leaflets[0].constants[0] = 2e5; });
  model_differs([](Model &m) { m.valve.leaflets[0].constants[1] = 2e6; });
  model_differs([](Model &m) { m.valve.leaflets[0].constants[2] = 0.2; });
  model_differs([](Model &m) { m.valve.scallops[0].leaflet = 1; });
  model_differs([](Model &m) { m.valve.chords[0].rest_length *= 1.25; });
  model_differs([](Model &m) { m.valve.chords[0].young *= 1.25; });
  model_differs([](Model &m) { m.valve.chords[0].area *= 1.25; });
  model_differs([](Model &m) { std::swap(m.valve.chords[0].a, m.valve.chords[0].b); });
  model_differs([](Model &m) { m.valve.chords[0].kind = ChordKind::commissural; });
  model_differs([](Model &m) { m.valve.chords.pop_back(); });
  model_differs([](Model &m) { m.valve.heads[0].name = "left"; });
  model_differs([](Model &m) { m.valve.heads[0].node = 1; });
  model_differs([](Model &m) { m.valve.density = 1000; });
  model_differs([](Model &m) { m.valve.contact_thickness *= 1.25; });
  model_differs([](Model &m) { m.valve.contact_stiffness = 1e3; });
  model_differs([](Model &m) { m.valve.bending_scale = 0; });
  model_differs([](Model &m) { m.valve.next_id += 1; });
  const auto state_differs = [&](const std::function<void(State &)> &change) {
    State state = start;
    change(state);
    hashes.insert(hash_of(*base, state));
    CHECK(hashes.size() == ++expected);
  };
  state_differs([](State &s) { s.x[3][0] += 1e-3; });
  state_differs([](State &s) { std::swap(s.x[3], s.x[4]); });
  state_differs([](State &s) { s.v[3][0] = 1; });
  state_differs([](State &s) { s.v[3][0] = -0.0; });  // not the zero it was: bits count
  state_differs([](State &s) { s.time = 1; });
  state_differs([](State &s) { s.steps = 1; });
  state_differs([](State &s) { s.load.pressure = 1; });
  state_differs([](State &s) { s.load.boundary_fraction = 1; });
}

TEST_CASE("the_hash_is_the_same_for_a_copy") {
  const ModelPtr model = make_model(small_valve());
  // NOLINTNEXTLINE(performance-unnecessary-copy-initialization): the copy's hash is tested
  const Model copy = *model;
  CHECK(hash_of(copy, initial_state(copy)) == fresh_hash(model));
}
