// Maps between mesh levels carry positions, rest shapes and velocities from one level to another.
#include "anatomy/level_map.h"

#include "solve/solver.h"
#include "tests/anatomy/levels.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

struct Pair {
  std::string name;
  ModelPtr coarse, fine;
};

// Two levels of each valve, one pair by coarsening and one by refining.
std::vector<Pair> pairs() {
  std::vector<Pair> made;
  for (const Named &one : all_kinds_of_valves()) {
    const ModelPtr &model = one.model;
    made.push_back({one.name + ", refined", model, make_model(refine(*model))});
    made.push_back(
        {one.name + ", coarsened", coarsen(*model, counted_vertices(*model) / 3).model, model});
  }
  return made;
}

// A state in rigid motion: rotated about a point, with the velocity of that rotation.
State moved(State state, const Mat3 &turn, const Vec3 &shift, const Vec3 &spin) {
  for (size_t n = 0; n < state.x.size(); ++n) {
    state.x[n] = turn * std::as_const(state.x)[n] + shift;
    state.v[n] = spin.cross(std::as_const(state.x)[n]);
  }
  return state;
}

double largest_difference(const std::vector<Vec3> &a, const std::vector<Vec3> &b) {
  double largest = 0;
  for (size_t n = 0; n < a.size(); ++n) largest = std::max(largest, (a[n] - b[n]).norm());
  return largest;
}

// Rounding of 50 mm over triangles with angles of a degree.
constexpr double rounding = 1e-15;

}  // namespace

TEST_CASE("weights_of_a_place_sum_to_one") {
  for (const Pair &one : pairs()) {
    const ModelPtr &coarse = one.coarse, &fine = one.fine;
    CAPTURE(one.name);
    const LevelMap map = make_level_map(*coarse, *fine);
    REQUIRE(map.place.size() == fine->node_count());
    REQUIRE(map.fine_of_coarse.size() == coarse->node_count());
    double worst = 0;
    for (const LevelPlace &place : map.place) {
      worst = std::max(worst, std::abs(place.weight[0] + place.weight[1] + place.weight[2] - 1));
    }
    CHECK(worst < 1e-15);
  }
}

TEST_CASE("the_rest_shape_and_rigid_motions_are_mapped_to_rounding") {
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  const Vec3 shift(0.01, -0.02, 0.005), spin(3, -1, 2);
  for (const Pair &one : pairs()) {
    const ModelPtr &coarse = one.coarse, &fine = one.fine;
    CAPTURE(one.name);
    const LevelMap map = make_level_map(*coarse, *fine);
    const State rest = to_fine(map, *coarse, *fine, initial_state(*coarse));
    CHECK(largest_difference(rest.x, fine->valve.rest) < rounding);
    const State here = moved(initial_state(*coarse), turn, shift, spin);
    const State there = moved(initial_state(*fine), turn, shift, spin);
    const State carried = to_fine(map, *coarse, *fine, here);
    CHECK(largest_difference(carried.x, there.x) < rounding);
    CHECK(largest_difference(carried.v, there.v) < 10 * rounding);  // m/s, of 0.2
  }
}

TEST_CASE("refined_vertices_are_midpoints_of_edges") {
  const ModelPtr coarse = parametric(425), fine = make_model(refine(*coarse));
  const LevelMap map = make_level_map(*coarse, *fine);
  for (size_t n = coarse->node_count(); n < fine->node_count(); ++n) {
    std::array<double, 3> weight = map.place[n].weight;
    std::sort(weight.begin(), weight.end());
    CHECK(std::abs(weight[0]) < 1e-13);  // rounding of 40 mm over sides of 1 mm
    CHECK(std::abs(weight[1] - 0.5) < 1e-13);
    CHECK(std::abs(weight[2] - 0.5) < 1e-13);
    CHECK(std::abs(map.place[n].height) < rounding);
  }
}

TEST_CASE("mapping_to_a_finer_level_and_back_gives_the_same_bits") {
  for (const Pair &one : pairs()) {
    const ModelPtr &coarse = one.coarse, &fine = one.fine;
    CAPTURE(one.name);
    const LevelMap map = make_level_map(*coarse, *fine);
    State state = initial_state(*coarse);
    for (size_t n = 0; n < state.x.size(); ++n) {
      const auto k = static_cast<double>(n);
      state.x[n] += 1e-3 * Vec3(std::sin(3 * k), std::cos(5 * k), std::sin(7 * k));
      state.v[n] = Vec3(std::cos(2 * k), 0.1, 0);
    }
    state.time = 0.25;
    state.steps = 7;
    state.load = {1000, 0.5};
    const State back = to_coarse(map, to_fine(map, *coarse, *fine, state));
    CHECK(hash_of(*coarse, back) == hash_of(*coarse, state));
    CHECK(hash_of(*coarse, transferred(*fine, transferred(*coarse, state, *fine), *coarse)) ==
          hash_of(*coarse, state));
  }
}

TEST_CASE("the_fine_annulus_is_prescribed_where_the_coarse_one_is") {
  const ModelPtr fine = dilated(), coarse = coarsen(*fine, 300).model;
  State state = initial_state(*coarse);
  state.load = {0, 0.6};
  for (const uint32_t node : coarse->valve.annulus.get()) state.x[node] = coarse->target(node, 0.6);
  const State carried = transferred(*coarse, state, *fine);
  for (const uint32_t node : fine->valve.annulus.get()) {
    CHECK(carried.x[node] == fine->target(node, 0.6));
  }
}

// Leaflets touch in the closed shape: geodesic distance keeps their vertices apart.
TEST_CASE("mapped_positions_lie_in_the_leaflet_of_their_vertex") {
  const ModelPtr fine = parametric(1700), coarse = coarsen(*fine, 400).model;
  const LevelMap map = make_level_map(*coarse, *fine);
  const double side = 4e-3;  // the longest of the coarse level
  for (size_t n = 0; n < fine->node_count(); ++n) {
    for (const uint32_t corner : map.place[n].nodes) {
      CHECK((coarse->valve.rest[corner] - fine->valve.rest[n]).norm() < side);
    }
  }
}

TEST_CASE("levels_of_different_valves_are_refused") {
  const ModelPtr a = parametric(425), b = dilated();
  const State state = initial_state(*a);
  CHECK(refusal([&] { transferred(*a, state, *b); }).find("levels") != std::string::npos);
  CHECK(refusal([&] { make_level_map(*b, *a); }).find("levels") != std::string::npos);
}

TEST_CASE("levels_close_and_the_coarse_closure_starts_the_fine_one") {
  const ModelPtr coarse = parametric(200), fine = make_model(refine(*coarse));
  Solver solver(Backend::fastest);
  State state = initial_state(*coarse);
  state.load = {120 * 133.322, 1};
  const SolveStats first = solver.settle(*coarse, state, {}, {});
  REQUIRE(first.converged);
  State carried = transferred(*coarse, state, *fine), from_rest = initial_state(*fine);
  from_rest.load = state.load;
  const SolveStats second = solver.settle(*fine, carried, {}, {});
  const SolveStats direct = solver.settle(*fine, from_rest, {}, {});
  CHECK(second.converged);
  CHECK(direct.converged);
  CHECK(find_intersections(from_rest.x, fine->valve.triangles).empty());
  MESSAGE("iterations: coarse " << first.iterations << ", fine from it " << second.iterations
                                << ", fine from rest " << direct.iterations);
}
