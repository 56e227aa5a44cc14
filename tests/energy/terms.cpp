// Every energy term of sheet and chordae: gradient against differences of the energy, Hessian
// against differences of the gradient, invariance under rigid motion.
#include "tests/energy/terms.h"

#include <cmath>

#include "energy/total_energy.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

// A cylinder of radius R, an equilateral lattice of m x n cells rolled along a direction.
double rolled_energy(uint32_t m, uint32_t n, double edge, double radius, bool along) {
  Valve valve;
  add_grid(valve, m, n, [&](double u, double v) -> Vec3 {
    return {edge * (u + v / 2), edge * std::sqrt(0.75) * v, 0};
  });
  const Model model = model_of_sheet(valve, {});
  Positions x = model.valve.rest;
  for (Vec3 &p : x) {
    double &rolled = along ? p.x() : p.y();
    const double angle = rolled / radius;
    rolled = radius * std::sin(angle);
    p.z() = radius * (1 - std::cos(angle));
  }
  return BendingTerm(model).energy(x);
}

}  // namespace

TEST_CASE("springs_have_the_derivatives_of_their_energy") {
  const Model model = free_valve();
  check_term(model, SpringTerm(model));
}

TEST_CASE("the_membrane_has_the_derivatives_of_its_energy_in_every_law") {
  for (const LeafletLaw &law : leaflet_laws()) {
    if (!law.response) continue;
    CAPTURE(law.word);
    const Model model = free_membrane(law);
    // stretches at which the exponents are of the order of 1, as in loaded tissue
    check_term(model, MembraneTerm(model), 0.25e-3);
  }
}

TEST_CASE("the_curvature_of_every_law_is_positive") {
  Random random(9);
  for (const LeafletLaw &law : leaflet_laws()) {
    if (!law.response) continue;
    CAPTURE(law.word);
    const Constants constants = default_constants(law.constants);
    for (int k = 0; k < 1000; ++k) {
      const double a = random(0.3, 3), b = random(0.3, 3);
      const InPlaneStrain strain{a, b, std::sqrt(a * b) * random(-0.9, 0.9)};
      const double i1 = a + b + 1 / strain.det();
      const Mat3 h = in_plane_stiffness(law.response(constants, i1, a), strain).second;
      const Vec3 values = symmetric_eigenvalues(h);
      // rounding of the eigenvalues
      CHECK(values[0] >= -1e-12 * values[2]);
    }
  }
}

TEST_CASE("springs_and_membrane_share_a_valve_by_leaflets") {
  Valve valve = small_valve();
  valve.leaflets[1].law = LeafletLawId::neo_hookean;
  valve.leaflets[1].constants = {1e5 / 3};
  const Model model = model_of_sheet(valve, {});
  Positions x = crumpled(model, 8), springs(x.size(), Vec3::Zero()), membrane = springs;
  CHECK(SpringTerm(model).gradient(x, springs) > 0);
  CHECK(MembraneTerm(model).gradient(x, membrane) > 0);
  for (uint32_t n = 0; n < x.size(); ++n) {
    bool first = false, second = false;
    for (const uint32_t t : model.topology.node_triangles[n]) {
      (model.valve.triangle_leaflet[t] == 0 ? first : second) = true;
    }
    CHECK((springs[n].norm() > 0) == first);
    CHECK((membrane[n].norm() > 0) == second);
  }
}

TEST_CASE("bending_has_the_derivatives_of_its_energy") {
  const Model model = free_valve();
  check_term(model, BendingTerm(model));
}

TEST_CASE("chordae_have_the_derivatives_of_their_energy_in_every_law") {
  const std::pair<ChordLawId, Chord::Constants> laws[] = {
      {ChordLawId::linear, {}},
      {ChordLawId::bilinear, {0.05, 100e6}},
      {ChordLawId::ogden, {4.24e6, 55.9, 2.72e6, 55.9, 37, 70.7}},  // Texas TriValve, posterior
      {ChordLawId::table, {0}}};
  for (const auto &row : laws) {
    const ChordLawId law = row.first;
    const Chord::Constants &constants = row.second;
    CAPTURE(law);
    Valve valve = small_valve();
    valve.curves = {{0, "measured", {{0.02, 0}, {0.08, 1e6}, {0.11, 4e6}}}};
    for (size_t c = 0; c < valve.chords.size(); ++c) {
      valve.chords[c].law = law;
      valve.chords[c].constants = constants;
    }
    const Model model = model_of_sheet(valve, {});
    check_term(model, CableTerm(model));
  }
}

TEST_CASE("inner_forces_have_zero_resultant") {
  const Model model = free_valve();
  const Positions x = crumpled(model, 4);
  const Model sheet = free_membrane(*find_leaflet_law(LeafletLawId::prot));
  for (int term = 0; term < 4; ++term) {
    CAPTURE(term);
    Positions g(x.size(), Vec3::Zero());
    if (term == 0) SpringTerm(model).gradient(x, g);
    if (term == 1) BendingTerm(model).gradient(x, g);
    if (term == 2) CableTerm(model).gradient(x, g);
    if (term == 3) MembraneTerm(sheet).gradient(x, g);
    // rounding of a sum of some hundred forces; arms are below 0.03 m
    CHECK(sum_of(g).norm() < 1e-13 * largest(g));
    CHECK(moment_of(x, g).norm() < 1e-13 * 0.03 * largest(g));
  }
}

TEST_CASE("forces_vanish_in_the_rest_shape") {
  const Model model = free_valve();
  const Positions &x = model.valve.rest;
  Positions g(x.size(), Vec3::Zero());
  SpringTerm(model).gradient(x, g);
  BendingTerm(model).gradient(x, g);
  CableTerm(model).gradient(x, g);
  for (const LeafletLaw &law : leaflet_laws()) {
    if (law.response) MembraneTerm(free_membrane(law)).gradient(x, g);
  }
  // rounding of a strain, 1e-16, times the stiffest part: a chord of 31 N
  CHECK(largest(g) < 1e-13);
}

TEST_CASE("a_sheet_without_bending_has_no_hinges") {
  Valve valve = small_valve();
  valve.bending_scale = 0;
  const Model model = model_of_sheet(valve, {});
  const BendingTerm term(model);
  CHECK(term.empty());
  CHECK(term.energy(crumpled(model, 5)) == 0);
}

TEST_CASE("a_rolled_lattice_has_the_bending_energy_of_a_cylinder") {
  const double edge = 1e-3, radius = 0.1;
  const double rigidity = 100e3 * 1e-9 / (12 * (1 - 0.25));
  const double area = std::sqrt(0.75) * edge * edge;
  const double expected = 0.5 * rigidity / (radius * radius) * area;
  for (const bool along : {true, false}) {
    // the second difference over patches leaves the energy of one cell, without its borders
    const double cell =
        rolled_energy(7, 7, edge, radius, along) - rolled_energy(7, 6, edge, radius, along) -
        rolled_energy(6, 7, edge, radius, along) + rolled_energy(6, 6, edge, radius, along);
    // chords for arcs: (edge / radius)^2 / 12
    CHECK(cell == about(expected, 2e-5));
  }
}

TEST_CASE("a_chord_pulls_with_ea_times_strain_and_never_pushes") {
  Valve valve;
  valve.rest = {Vec3(0, 0, 0), Vec3(0, 0, 20e-3)};
  Chord chord;
  chord.a = 0;
  chord.b = 1;
  valve.chords = {chord};
  const Model model = model_of_sheet(valve, {0});
  const CableTerm term(model);
  for (const double strain : {0.01, 0.05, 0.2}) {
    Positions g(2, Vec3::Zero());
    const double energy = term.gradient({Vec3::Zero(), Vec3(0, 0, 20e-3 * (1 + strain))}, g);
    const double ea = 40e6 * pi * 0.25e-6;  // a diameter of 1 mm
    // rounding, which the strain of 0.01 makes a hundred times larger
    CHECK(g[1].z() == about(ea * strain, 1e-13));
    CHECK(g[0].z() == about(-ea * strain, 1e-13));
    CHECK(energy == about(0.5 * ea * 20e-3 * strain * strain, 1e-13));
  }
  Positions g(2, Vec3::Zero());
  CHECK(term.gradient({Vec3::Zero(), Vec3(0, 0, 19e-3)}, g) == 0);
  CHECK(largest(g) == 0);
}

TEST_CASE("the_total_energy_has_the_derivatives_of_its_value") {
  const Model model = free_valve();
  TotalEnergy total_energy(model);
  total_energy.set_pressure(16e3);
  const Positions x = crumpled(model, 7);
  Profile profile{};
  total_energy.prepare(x, x, 1e-4, profile);
  HessianAssembler system;
  Positions g;
  const Gradient gradient = [&](const Positions &y) {
    total_energy.gradient(y, g, profile);
    return g;
  };
  const Positions at_x = gradient(x);
  total_energy.hessian(x, Curvature::exact, system, profile);
  const Dense h = dense(system);
  const Positions found =
      differences([&](const Positions &y) { return total_energy.energy(y); }, x, 1e-7);
  // as for the terms
  CHECK(farthest(at_x, found) < 1e-6 * largest(at_x));
  Random random(8);
  const Positions v = random.vectors(x.size(), 1);
  Positions skew(x.size(), Vec3::Zero()), after = x, before = x;
  total_energy.add_skew(x, v, skew);
  for (size_t i = 0; i < x.size(); ++i) {
    after[i] += 1e-7 * v[i];
    before[i] -= 1e-7 * v[i];
  }
  const Eigen::VectorXd slope = (flat(gradient(after)) - flat(gradient(before))) / 2e-7;
  CHECK((apply(h, flat(v)) + flat(skew) - slope).norm() < 1e-6 * slope.norm());
}

TEST_CASE("a_moving_boundary_acts_through_the_blocks_without_rows") {
  Valve valve = small_valve();
  const Model whole = model_of_sheet(valve, {});
  std::vector<uint32_t> fixed = valve.annulus;
  const Model model = model_of_sheet(std::move(valve), fixed);
  const Positions x = crumpled(model, 9);
  Random random(10);
  Positions step(x.size(), Vec3::Zero());
  for (const uint32_t node : fixed) step[node] = random.vector(1e-3);
  const auto assemble = [&x](const Model &m, HessianAssembler &system) {
    TotalEnergy total_energy(m);
    Profile profile{};
    Positions g;
    total_energy.prepare(x, x, 1e-4, profile);
    total_energy.gradient(x, g, profile);
    total_energy.hessian(x, Curvature::projected, system, profile);
  };
  HessianAssembler all, some;
  assemble(whole, all);
  some.boundary_step = &step;
  assemble(model, some);
  const Eigen::VectorXd pull = -apply(dense(all), flat(step));
  Eigen::VectorXd got = Eigen::VectorXd::Zero(pull.size()), expected = got;
  for (uint32_t r = 0; r < some.node_of.size(); ++r) {
    const Eigen::Index i = 3 * some.node_of[r];
    got.segment<3>(i) = some.boundary_force[r];
    expected.segment<3>(i) = pull.segment<3>(i);
  }
  // rounding
  CHECK((got - expected).norm() < 1e-13 * expected.norm());
}
