// Measures of scallops and commissures, and the parts of the orifice.
#include "measure/regions/regions.h"

#include <doctest/doctest.h>
#include <mvs/sim.h>

#include <Eigen/Geometry>
#include <cmath>
#include <set>
#include <string>

#include "anatomy/parametric.h"
#include "measure/annulus/frame.h"
#include "measure/tenting/tenting_billow.h"
#include "solve/solver.h"
#include "tests/measure/shapes.h"

namespace mvs::core::test {
namespace {

constexpr double mm = 1e-3;

struct Measured {
  ModelPtr model;
  RegionMap map;
  Coaptation coaptation;
  Orifice orifice;
  OrificeParts parts;
  std::vector<RegionMeasures> regions;

  Measured(ModelPtr model_in, const std::vector<Vec3> &x)
      : model(std::move(model_in)),
        map(*model),
        coaptation(measure_coaptation(*model, x)),
        orifice(measure_orifice(*model, x)),
        parts(find_orifice_parts(*model, x, map, orifice)),
        regions(measure_regions(*model, x, map, coaptation, parts, atrial_surface(*model, x))) {}

  const RegionMeasures &of(const std::string &name) const {
    for (size_t k = 0; k < map.size(); ++k) {
      if (map.name(k) == name) return regions[k];
    }
    FAIL("no region " << name);
    return regions[0];
  }
  double sum(double RegionMeasures::*value) const {
    double total = 0;
    for (size_t k = 0; k < map.scallops(); ++k) total += regions[k].*value;
    return total;
  }
  double largest(double RegionMeasures::*value) const {
    double found = 0;
    for (size_t k = 0; k < map.scallops(); ++k) found = std::max(found, regions[k].*value);
    return found;
  }
};

struct Closed {
  ModelPtr model;
  std::vector<Vec3> x;
};

// The default valve, its annulus scaled, without the chordae whose names begin so.
Closed close_valve(double annulus_scale, const std::string &cut) {
  mvs_parametric_desc desc{};
  desc.struct_size = sizeof desc;
  desc.shape = MVS_SHAPE_FOUNDING;  // its leaks and straight chordae are known
  desc.annulus_scale = annulus_scale;
  Valve valve = make_parametric_valve(desc);
  if (!cut.empty()) {
    std::vector<Chord> kept;
    for (const Chord &chord : valve.chords) {
      if (chord.name.rfind(cut, 0) != 0) kept.push_back(chord);
    }
    CHECK(kept.size() < valve.chords.size());
    valve.chords.assign(kept.begin(), kept.end());
  }
  Closed closed;
  closed.model = make_model(valve);
  State state = initial_state(*closed.model);
  state.load = {120 * 133.322, 1};
  CHECK(Solver(Backend::fastest).settle(*closed.model, state, {}, nullptr).converged);
  closed.x = state.x;
  return closed;
}
const Closed &healthy() {
  static const Closed closed = close_valve(1, "");
  return closed;
}
const Closed &dilated() {
  static const Closed closed = close_valve(1.2, "");
  return closed;
}

std::set<std::string> parts_of(const std::string &names) {
  std::set<std::string> found;
  for (size_t from = 0; from < names.size();) {
    const size_t to = std::min(names.find('+', from), names.size());
    found.insert(names.substr(from, to - from));
    from = to + 1;
  }
  return found;
}

}  // namespace

TEST_CASE("scallops_add_up_to_the_valve") {
  for (const Closed *closed : {&healthy(), &dilated()}) {
    const Measured m(closed->model, closed->x);
    const TentingBillow whole = measure_tenting_billow(*closed->model, closed->x);
    constexpr double rounding = 1e-12;  // of sums in another order
    CHECK(m.map.scallops() == 6);
    CHECK(m.map.size() == 8);
    CHECK(m.map.name(6) + m.map.name(7) == "A1-P1A3-P3");
    CHECK(m.sum(&RegionMeasures::coaptation_area) == about(m.coaptation.area, rounding));
    CHECK(std::abs(m.sum(&RegionMeasures::orifice_area) - m.orifice.area) <=
          rounding * m.orifice.area);
    CHECK(m.sum(&RegionMeasures::billow_volume) == about(whole.billow_volume, rounding));
    CHECK(m.sum(&RegionMeasures::tenting_volume) == about(whole.tenting_volume, rounding));
    CHECK(m.largest(&RegionMeasures::billow_height) == whole.billow_height);
    CHECK(m.largest(&RegionMeasures::tenting_height) == whole.tenting_height);
  }
}

TEST_CASE("the_lengths_of_scallops_have_the_mean_and_minimum_of_the_line") {
  const Measured m(healthy().model, healthy().x);
  double least = 1, most = 0;
  for (const char *name : {"A1", "A2", "A3"}) {
    const RegionMeasures &r = m.of(name);
    CHECK(r.coaptation_length_min <= r.coaptation_length_mean);
    least = std::min(least, r.coaptation_length_mean);
    most = std::max(most, r.coaptation_length_mean);
  }
  CHECK(least < m.coaptation.length_mean);
  CHECK(m.coaptation.length_mean < most);
  CHECK(most < m.coaptation.length_max);
  // a symmetric valve; its borders of scallops are edges, and places are 0.13 mm apart
  CHECK(m.of("A1").coaptation_length_mean == about(m.of("A3").coaptation_length_mean, 0.02));
}

TEST_CASE("a_rigid_motion_changes_no_region") {
  for (const Closed *closed : {&healthy(), &dilated()}) {
    const Measured still(closed->model, closed->x);
    const Measured there(closed->model, moved(closed->x, some_rigid_motion()));
    REQUIRE(there.parts.parts.size() == still.parts.parts.size());
    for (size_t k = 0; k < still.map.size(); ++k) {
      const RegionMeasures &a = still.regions[k], &b = there.regions[k];
      CHECK(std::abs(a.coaptation_area - b.coaptation_area) < 1e-12);
      CHECK(std::abs(a.coaptation_length_mean - b.coaptation_length_mean) < 1e-9);
      CHECK(std::abs(a.billow_height - b.billow_height) < 1e-9);
      // a cell in the crevice between two leaflets is as near to one as to the other, and
      // rounding decides: 0.02 mm2 at up to 10 mm, and the slope of the crevice over a cell
      CHECK(std::abs(a.tenting_height - b.tenting_height) < 0.2 * mm);
      CHECK(std::abs(a.tenting_volume - b.tenting_volume) < 1e-9);
      CHECK(std::abs(a.billow_volume - b.billow_volume) < 1e-9);
      // rounding may choose other diagonals of the samples of the orifice
      CHECK(std::abs(a.orifice_area - b.orifice_area) <= 0.02 * still.orifice.area);
      CHECK(std::abs(a.gap - b.gap) < 0.1 * mm);
    }
  }
}

// The default valve is its own mirror image, with places of the coaptation line as near to a
// scallop as to its neighbour, or to tissue of a commissure as to other tissue: rounding may not
// decide.
TEST_CASE("a_rigid_motion_changes_no_coaptation_length_of_the_default_valve") {
  mvs_parametric_desc desc{};
  desc.struct_size = sizeof desc;
  const ModelPtr model = make_model(make_parametric_valve(desc));
  State state = initial_state(*model);
  state.load = {120 * 133.322, 1};
  CHECK(Solver(Backend::fastest).settle(*model, state, {}, nullptr).converged);
  const RegionMap map(*model);
  const auto regions = [&](const std::vector<Vec3> &x) {
    return measure_regions(*model, x, map, measure_coaptation(*model, x), {},
                           atrial_surface(*model, x));
  };
  const std::vector<RegionMeasures> still = regions(state.x);
  for (int k = 0; k < 6; ++k) {
    const Eigen::AngleAxisd turn(0.3 + k, Vec3(1, k, 0.2 * k * k).normalized());
    const std::vector<RegionMeasures> there =
        regions(moved(state.x, [&](const Vec3 &p) -> Vec3 { return turn * p; }));
    for (size_t r = 0; r < still.size(); ++r) {
      CAPTURE(map.name(r));
      CHECK(still[r].coaptation_length_mean > 0);
      // rounding of positions of 30 mm, times the slope of a share over 0.1 mm
      CHECK(std::abs(there[r].coaptation_length_mean - still[r].coaptation_length_mean) < 1e-9);
      CHECK(std::abs(there[r].coaptation_length_min - still[r].coaptation_length_min) < 1e-9);
    }
  }
}

TEST_CASE("a_sealed_valve_has_no_parts_and_no_gap") {
  const Measured m(healthy().model, healthy().x);
  CHECK(m.parts.parts.empty());
  CHECK(m.parts.of_triangle.empty());
  CHECK(m.largest(&RegionMeasures::gap) == 0);
  CHECK(m.sum(&RegionMeasures::orifice_area) == 0);
}

TEST_CASE("a_round_hole_has_its_width_centre_and_direction") {
  const double radius = 4 * mm;
  Sheet sheet = disc(16 * mm, radius, [](double, double) { return 0; });
  sheet.around = 72;
  const ModelPtr model = model_of(sheet);
  const Measured m(model, model->valve.rest);
  REQUIRE(m.parts.parts.size() == 1);
  const OrificePart &part = m.parts.parts[0];
  CHECK(part.area == about(m.orifice.area, 1e-12));
  CHECK(part.triangles == m.orifice.triangles.size());
  // the nearest sample to the centre is within their distance, a twelfth of a triangle's side
  CHECK(part.gap == about(2 * radius, 0.03));
  CHECK(part.gap <= 2 * radius);
  CHECK(part.centroid.norm() < 0.01 * mm);
  CHECK(part.direction[2] == about(1, 1e-6));
  // half of the hole is beside either leaflet
  CHECK(m.of("A").orifice_area == about(0.5 * m.orifice.area, 0.02));
  CHECK(part.anterior == "A");
  CHECK(part.posterior == "P");
  // each is a tenth of the rim
  CHECK(part.commissures == "A-P anterolateral+A-P posteromedial");
}

TEST_CASE("two_gaps_are_two_parts_whose_areas_add_up") {
  const ModelPtr model = model_of(two_gaps(2 * mm, 3 * mm));
  const Measured m(model, model->valve.rest);
  REQUIRE(m.parts.parts.size() == 2);
  CHECK(m.parts.parts[0].area + m.parts.parts[1].area == about(m.orifice.area, 1e-12));
  CHECK(m.parts.parts[0].area > m.parts.parts[1].area);
  CHECK(m.parts.parts[0].centroid[1] > 0);  // the larger gap
  CHECK(m.parts.parts[1].centroid[1] < 0);
  for (size_t t = 0; t < m.orifice.triangles.size(); ++t) {
    const Tri &c = m.orifice.triangles[t];
    const double y = m.orifice.vertices[c[0]][1] + m.orifice.vertices[c[1]][1];
    CHECK((y > 0) == (m.parts.of_triangle[t] == 0));
  }
}

// A gap hardly wider than the contact thickness had three openings within 2 mm, and the jet of one,
// a single triangle that hung on the others by a point, went into the ventricle.
TEST_CASE("pieces_of_an_orifice_that_touch_in_a_point_are_one_opening_into_the_atrium") {
  Sheet sheet = disc(16 * mm, 4 * mm, [](double, double) { return 0; });
  const ModelPtr model = model_of(sheet);
  Orifice orifice;
  orifice.vertices = {{0, 0, 0},       {1 * mm, 0, 0},        {0, 1 * mm, 0},
                      {-1 * mm, 0, 0}, {-1 * mm, -1 * mm, 0}, {2 * mm, 0.5 * mm, 0},
                      {2 * mm, 0, 0}};
  // two that face the atrium and touch in a point; a smaller one, at a point of theirs, that does
  // not; none has an edge in common with another one
  orifice.triangles = {{0, 1, 2}, {0, 3, 4}, {1, 5, 6}};
  const RegionMap map(*model);
  const OrificeParts found = find_orifice_parts(*model, model->valve.rest, map, orifice);
  REQUIRE(found.parts.size() == 1);
  CHECK(found.parts[0].triangles == 3);
  CHECK(found.parts[0].direction[2] == about(1, 1e-12));
}

// Of leaflets that meet. Over a prolapsed leaflet a jet leaves along the other one, and may go
// down.
TEST_CASE("jets_of_dilated_valves_go_into_the_atrium") {
  for (const double scale : {1.15, 1.2, 1.3}) {
    const Closed closed = close_valve(scale, "");
    const Measured m(closed.model, closed.x);
    CHECK(!m.parts.parts.empty());
    for (const OrificePart &part : m.parts.parts) {
      CHECK((valve_frame(*closed.model, closed.x).axes * part.direction)[2] > 0);
    }
  }
}

TEST_CASE("a_dilated_annulus_leaks_in_the_middle_into_the_atrium") {
  const Measured m(dilated().model, dilated().x);
  REQUIRE(m.parts.parts.size() >= 1);
  const OrificePart &part = m.parts.parts[0];
  CHECK(parts_of(part.anterior).count("A2") == 1);
  CHECK(parts_of(part.posterior).count("P2") == 1);
  CHECK(m.of("A2").orifice_area == m.largest(&RegionMeasures::orifice_area));
  CHECK(m.of("P2").orifice_area > m.of("P1").orifice_area);
  CHECK(m.of("A2").gap > dilated().model->valve.contact_thickness);
  CHECK(m.of("A2").coaptation_length_mean <
        Measured(healthy().model, healthy().x).of("A2").coaptation_length_mean);
  const Frame frame = valve_frame(*dilated().model, dilated().x);
  CHECK(part.direction.norm() == about(1, 1e-12));
  CHECK((frame.axes * part.direction)[2] > 0.5);
}

TEST_CASE("a_scallop_without_chordae_prolapses_and_leaks_there") {
  const Closed flail = close_valve(1, "P3/");
  const Measured m(flail.model, flail.x), before(healthy().model, healthy().x);
  CHECK(m.of("P3").billow_height == m.largest(&RegionMeasures::billow_height));
  CHECK(m.of("P3").billow_height > before.of("P3").billow_height + 1 * mm);
  CHECK(m.of("P1").billow_height < before.of("P1").billow_height + 1 * mm);
  REQUIRE(m.parts.parts.size() >= 1);
  CHECK(parts_of(m.parts.parts[0].posterior).count("P3") == 1);
  CHECK(parts_of(m.parts.parts[0].posterior).count("P1") == 0);
  CHECK(m.of("P3").orifice_area > m.of("P1").orifice_area);
}

}  // namespace mvs::core::test
