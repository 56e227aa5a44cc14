// Strain, stress and chord tension against closed forms and virtual work.
#include <doctest/doctest.h>
#include <mvs/snapshot.h>

#include <Eigen/Geometry>
#include <cmath>

#include "measure/tissue/chords.h"
#include "measure/tissue/strain.h"
#include "measure/tissue/tensors.h"
#include "tests/measure/shapes.h"

namespace mvs::core::test {
namespace {

Sheet flat_ring() {
  return disc(18e-3, 6e-3, [](double, double) { return 0.0; });
}

// The energy of the springs of model.md section 2: A t times the integral of stress over strain,
// for each side of each triangle.
double spring_energy(const Model &model, const std::vector<Vec3> &x) {
  const Valve &valve = model.valve;
  double sum = 0;
  for (size_t t = 0; t < valve.triangles.size(); ++t) {
    const Bilinear law(valve.leaflets[valve.triangle_leaflet[t]].constants);
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = valve.triangles[t][k], b = valve.triangles[t][(k + 1) % 3];
      const double rest = (valve.rest[b] - valve.rest[a]).norm();
      const double e = (x[b] - x[a]).norm() / rest - 1;
      sum += model.rest_area[t] * valve.triangle_thickness[t] * law.energy(e);
    }
  }
  return sum;
}

Valve valve_with_chords() {
  Valve valve = valve_of(flat_ring());
  for (const uint32_t node : {580u, 590u, 600u}) {
    Chord chord;
    chord.a = valve.heads[node == 600 ? 1 : 0].node;
    chord.b = node;
    chord.rest_length = (valve.rest[chord.a] - valve.rest[node]).norm();
    valve.chords.push_back(chord);
  }
  return valve;
}

}  // namespace

TEST_CASE("uniform_stretch_is_measured_in_every_triangle") {
  const ModelPtr model = model_of(flat_ring());
  const RigidMotion motion = some_rigid_motion();
  const Strain strain = measure_strain(*model, moved(model->valve.rest, [&](const Vec3 &p) {
    return motion({1.2 * p[0], 0.9 * p[1], p[2]});
  }));
  for (const auto &stretch : strain.stretch) {
    // rounding of coordinates of 0.3 m against sides of 1 mm
    CHECK(stretch[0] == about(1.2, 1e-12));
    CHECK(stretch[1] == about(0.9, 1e-12));
  }
  CHECK(strain.max_strain == about(0.2, 1e-11));
  double area = 0;
  for (const double rest : model->rest_area) area += rest;
  CHECK(strain.leaflet_area == about(1.2 * 0.9 * area, 1e-12));
}

TEST_CASE("a_valve_at_rest_is_free_of_strain_and_stress") {
  const ModelPtr model = model_of(flat_ring());
  const Strain strain = measure_strain(*model, moved(model->valve.rest, some_rigid_motion()));
  CHECK(strain.max_strain < 1e-12);  // rounding, as above
  CHECK(strain.max_stress < 1e-12 * 6e6);
}

TEST_CASE("equilateral_triangles_stretched_evenly_carry_one_and_a_half_sigma_lambda") {
  Sheet sheet;
  sheet.around = 6;
  sheet.rings = 1;
  // outer corners stand on the sides of a hexagon: half of the triangles are equilateral
  sheet.at = [](double angle, double s) -> Vec3 {
    const double r = s > 0 ? 10e-3 : std::sqrt(3.0) * 10e-3;
    const double turned = s > 0 ? angle : angle + pi / 6;
    return {r * std::cos(turned), r * std::sin(turned), 0};
  };
  const ModelPtr model = model_of(sheet);
  const double stretch = 1.1, sigma = 100e3 * 0.1;
  const Strain strain = measure_strain(
      *model, moved(model->valve.rest, [&](const Vec3 &p) { return Vec3(stretch * p); }));
  size_t equilateral = 0;
  for (size_t t = 0; t < model->valve.triangles.size(); ++t) {
    // any triangle: the trace of the sum of three n n^T is 3
    CHECK(strain.stress[t][0] + strain.stress[t][1] == about(3 * sigma * stretch, 1e-12));
    const Tri &triangle = model->valve.triangles[t];
    double shortest = 1, longest = 0;
    for (size_t k = 0; k < 3; ++k) {
      const double length =
          (model->valve.rest[triangle[k]] - model->valve.rest[triangle[(k + 1) % 3]]).norm();
      shortest = std::min(shortest, length);
      longest = std::max(longest, length);
    }
    if (longest - shortest > 1e-9) continue;
    ++equilateral;
    CHECK(strain.stress[t][0] == about(1.5 * sigma * stretch, 1e-12));
    CHECK(strain.stress[t][1] == about(1.5 * sigma * stretch, 1e-12));
  }
  CHECK(equilateral == 6);
}

TEST_CASE("stress_does_the_work_of_the_springs") {
  const ModelPtr model = model_of(flat_ring());
  // beyond the kink in places, compressed in others
  const std::vector<Vec3> x = moved(model->valve.rest, [](const Vec3 &p) {
    return Vec3(1.1 * p[0] + 12 * p[0] * p[0], 0.95 * p[1] + 5 * p[0] * p[1], 20 * p[1] * p[1]);
  });
  const Strain strain = measure_strain(*model, x);
  CHECK(strain.max_strain > 0.3);
  double work = 0;
  for (size_t t = 0; t < strain.stress.size(); ++t) {
    work += model->rest_area[t] * model->valve.triangle_thickness[t] *
            (strain.stress[t][0] + strain.stress[t][1]);
  }
  const double step = 1e-6;
  const auto energy_at = [&](double scale) {
    return spring_energy(*model, moved(x, [&](const Vec3 &p) { return Vec3(scale * p); }));
  };
  const double expected = (energy_at(1 + step) - energy_at(1 - step)) / (2 * step);
  // a kink crossed within the step is wrong by step * 6 MPa / 0.1 MPa = 6e-5 of that side's share
  CHECK(work == about(expected, 1e-6));
}

// The sheet is stretched by 1.2 along a fibre at angle 0.3 to x and by 0.9 across it.
TEST_CASE("tensors_are_those_of_a_homogeneous_stretch_in_the_fibre_frame") {
  Valve valve = valve_of(flat_ring());
  const double angle = 0.3;
  const Vec3 fibre(std::cos(angle), std::sin(angle), 0),
      across(-std::sin(angle), std::cos(angle), 0);
  valve.triangle_fibre = std::vector<Vec3>(valve.triangles.size(), fibre);
  for (Leaflet &leaflet : valve.leaflets.edit()) {
    leaflet.law = LeafletLawId::fung;
    leaflet.constants = default_constants(find_leaflet_law(leaflet.law)->constants);
  }
  const ModelPtr model = make_model(std::move(valve));
  const auto x = moved(moved(model->valve.rest,
                             [&](const Vec3 &p) {
                               return Vec3(1.2 * fibre.dot(p) * fibre +
                                           0.9 * across.dot(p) * across + p.z() * Vec3::UnitZ());
                             }),
                       some_rigid_motion());
  const Tensors found = measure_tensors(*model, x);
  const Strain strain = measure_strain(*model, x);
  for (size_t t = 0; t < found.strain.size(); ++t) {
    CHECK(found.strain[t][0] == about(0.5 * (1.2 * 1.2 - 1), 1e-11));
    CHECK(found.strain[t][1] == about(0.5 * (0.9 * 0.9 - 1), 1e-11));
    CHECK(std::abs(found.strain[t][2]) < 1e-11);
    CHECK(found.stress[t][0] == about(strain.stress[t][0], 1e-9));
    CHECK(found.stress[t][1] + strain.stress[t][0] ==
          about(strain.stress[t][1] + strain.stress[t][0], 1e-9));
    CHECK(std::abs(found.stress[t][2]) < 1e-9 * strain.stress[t][0]);
    CHECK(std::abs(found.direction[t].dot(some_rigid_motion().turn * fibre)) == about(1, 1e-11));
  }
  for (const uint32_t node : model->valve.triangles[0]) {
    CHECK((found.node_strain[node] - found.strain[0]).norm() < 1e-11);
  }
}

TEST_CASE("percentiles_are_shares_of_the_tissue_by_area") {
  const ModelPtr model = make_model(valve_of(flat_ring()));
  std::vector<Vec3> x = model->valve.rest.get();
  for (Vec3 &p : x) p.x() *= 1 + 20 * p.x();
  const Strain strain = measure_strain(*model, x);
  const auto share_up_to = [&](double value) {
    double below = 0, all = 0;
    for (size_t t = 0; t < strain.stretch.size(); ++t) {
      all += model->rest_area[t];
      if (std::max(strain.stretch[t][0] - 1, 0.0) <= value) below += model->rest_area[t];
    }
    return below / all;
  };
  const Percentiles &p = strain.strain_percentiles;
  CHECK(p.p50 < p.p95);
  CHECK(p.p99 <= strain.max_strain);
  for (const auto &[value, share] : {std::pair{p.p50, 0.5}, {p.p95, 0.95}, {p.p99, 0.99}}) {
    CHECK(share_up_to(value) >= share);
    CHECK(share_up_to(value * (1 - 1e-12)) < share);
  }
}

TEST_CASE("stress_and_stretch_are_invariant_under_rigid_motion") {
  const ModelPtr model = model_of(flat_ring());
  const std::vector<Vec3> x = moved(model->valve.rest, [](const Vec3 &p) {
    return Vec3(1.1 * p[0], p[1] + 4 * p[0] * p[1], 20 * p[1] * p[1]);
  });
  const Strain still = measure_strain(*model, x);
  const Strain turned = measure_strain(*model, moved(x, some_rigid_motion()));
  CHECK(turned.max_strain == about(still.max_strain, 1e-11));
  CHECK(turned.max_stress == about(still.max_stress, 1e-9));
  CHECK(turned.leaflet_area == about(still.leaflet_area, 1e-12));
}

TEST_CASE("chord_tension_follows_its_length") {
  Valve valve = valve_with_chords();
  valve.chords[0].rest_length /= 1.05;  // taut by 5 %
  valve.chords[1].rest_length /= 0.9;   // slack by 10 %
  const ModelPtr model = make_model(valve);
  const ChordMeasures measures = measure_chords(*model, valve.rest);
  const double stiffness = 40e6 * pi / 4 * 1e-6;
  CHECK(measures.strain[0] == about(0.05, 1e-13));
  CHECK(measures.tension[0] == about(0.05 * stiffness, 1e-13));
  CHECK(measures.strain[1] == about(-0.1, 1e-13));
  CHECK(measures.tension[1] == 0);
  CHECK(measures.max_strain == measures.strain[0]);
  CHECK(measures.max_tension == measures.tension[0]);
}

TEST_CASE("sutures_are_not_among_the_largest_of_chordae") {
  Valve valve = valve_with_chords();
  valve.chords[0].rest_length /= 1.05;
  Chord &stitch = valve.chords[1];  // carries more
  stitch.kind = ChordKind::suture;
  stitch.a = valve.chords[2].b;
  stitch.rest_length = (valve.rest[stitch.a] - valve.rest[stitch.b]).norm() / 1.2;
  const ModelPtr model = make_model(valve);
  const ChordMeasures measures = measure_chords(*model, valve.rest);
  CHECK(measures.tension[1] > measures.tension[0]);
  CHECK(measures.max_strain == measures.strain[0]);
  CHECK(measures.max_tension == measures.tension[0]);
}

TEST_CASE("chordae_beyond_the_range_of_their_kind_are_flagged") {
  Valve valve = valve_with_chords();
  const double rest = valve.chords[0].rest_length;
  // 5 % of the standard chord carry 1.6 N: too much for a marginal chord, not for a strut
  valve.chords[0].rest_length = rest / 1.05;
  valve.chords[0].kind = ChordKind::marginal;
  const auto flags = [&] {
    const ModelPtr model = make_model(valve);
    return measure_chords(*model, valve.rest);
  };
  CHECK(flags().flags[0] == MVS_CHORD_FLAG_OVER_TENSION);
  CHECK(flags().over_tension == 1);
  valve.chords[0].kind = ChordKind::strut;
  CHECK(flags().flags[0] == 0);
  // 12 % are above 11.1 %, whatever their tension
  valve.chords[0].rest_length = rest / 1.12;
  valve.chords[0].young = 1e6;
  CHECK(flags().flags[0] == MVS_CHORD_FLAG_OVER_STRAIN);
  CHECK(flags().over_strain == 1);
}

TEST_CASE("heads_are_pulled_along_their_chordae") {
  Valve valve = valve_with_chords();
  for (Chord &chord : valve.chords) chord.rest_length /= 1.02;
  const ModelPtr model = make_model(valve);
  const ChordMeasures measures = measure_chords(*model, valve.rest);
  const auto pull = [&](size_t c) -> Vec3 {
    const Vec3 along = valve.rest[valve.chords[c].b] - valve.rest[valve.chords[c].a];
    return measures.tension[c] * along / along.norm();
  };
  CHECK((measures.head_force[0] - pull(0) - pull(1)).norm() < 1e-15);
  CHECK((measures.head_force[1] - pull(2)).norm() < 1e-15);
  CHECK(measures.head_force[0][2] > 0);
}

TEST_CASE("a_valve_without_chordae_has_zero_head_forces") {
  const ModelPtr model = model_of(flat_ring());
  const ChordMeasures measures = measure_chords(*model, model->valve.rest);
  CHECK(measures.strain.empty());
  CHECK(measures.max_strain == 0);
  CHECK(measures.max_tension == 0);
  REQUIRE(measures.head_force.size() == 2);
  CHECK(measures.head_force[0] == Vec3::Zero());
}

}  // namespace mvs::core::test
