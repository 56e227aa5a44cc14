// Stability of equilibria: margins against dense algebra and closed forms; unstable ones are left.
#include "solve/stability.h"

#include <cstdlib>

#include "anatomy/parametric.h"
#include "base/error.h"
#include "solve/nodes.h"
#include "tests/dense.h"
#include "tests/model/small_valve.h"
#include "tests/solve/bench.h"

namespace mvs::core::test {
namespace {

// The tangent of a state in full, over the rows of the free nodes.
struct DenseTangent {
  Dense symmetric, skew;
  Eigen::VectorXd damping;
  std::vector<uint32_t> node_of;

  explicit DenseTangent(const Model &model, const State &state) {
    TotalEnergy total_energy(model);
    Profile profile;
    Positions g;
    total_energy.use_verlet_list(false);
    total_energy.set_pressure(state.load.pressure);
    total_energy.prepare(state.x, state.x, 0, profile);
    total_energy.gradient(state.x, g, profile);
    HessianAssembler system;
    total_energy.hessian(state.x, Curvature::exact, system, profile);
    node_of = system.node_of;
    const int n = 3 * static_cast<int>(system.matrix.size());
    symmetric = skew = Dense::Zero(n, n);
    damping.resize(n);
    for (uint32_t c = 0; c < system.matrix.size(); ++c) {
      for (uint32_t k = system.matrix.start[c]; k < system.matrix.start[c + 1]; ++k) {
        const int row = 3 * static_cast<int>(system.matrix.row[k]),
                  column = 3 * static_cast<int>(c);
        symmetric.block<3, 3>(row, column) = system.matrix.value[k];
        symmetric.block<3, 3>(column, row) = system.matrix.value[k].transpose();
      }
      damping.segment<3>(3 * static_cast<int>(c)).setConstant(500 * model.node_mass[node_of[c]]);
    }
    for (uint32_t c = 0; c < system.matrix.size(); ++c) {
      for (int axis = 0; axis < 3; ++axis) {
        Positions v(state.x.size(), Vec3::Zero()), y = v;
        v[node_of[c]][axis] = 1;
        total_energy.add_skew(state.x, v, y);
        for (uint32_t r = 0; r < system.matrix.size(); ++r) {
          skew.block<3, 1>(3 * static_cast<int>(r), 3 * static_cast<int>(c) + axis) = y[node_of[r]];
        }
      }
    }
  }

  // Without the rows of branch points whose own block has an eigenvalue below a bound: they are
  // eliminated, each with as much stiffness to ground as the bound.
  void leave_out(const Model &model, double bound) {
    std::vector<Eigen::Index> kept, loose;
    for (size_t r = 0; r < node_of.size(); ++r) {
      const auto row = static_cast<Eigen::Index>(3 * r);
      const Mat3 block = symmetric.block<3, 3>(row, row);
      const bool is_loose =
          model.vertex_area[node_of[r]] == 0 && symmetric_eigenvalues(block)[0] < bound;
      for (int axis = 0; axis < 3; ++axis) (is_loose ? loose : kept).push_back(row + axis);
    }
    const Dense coupling = symmetric(kept, loose);
    Dense own = symmetric(loose, loose);
    own.diagonal().array() += bound;
    symmetric = Dense(symmetric(kept, kept));
    if (!loose.empty()) symmetric -= product(product(coupling, inverse(own)), coupling.transpose());
    skew = Dense(skew(kept, kept));
    damping = Eigen::VectorXd(damping(kept));
  }
  double stiffness() const { return symmetric_eigenvalues(symmetric)[0]; }
  double rate() const {
    const Dense slope = damping.cwiseInverse().asDiagonal() * (symmetric + skew);
    return -eigenvalues(slope).real().minCoeff();
  }
};

Valve parametric(uint32_t vertices, LeafletLawId law) {
  mvs_parametric_desc desc = {};
  desc.struct_size = sizeof desc;
  desc.vertices = vertices;
  desc.shape = MVS_SHAPE_FOUNDING;  // without branch points, which may have no stiffness
  Valve valve = make_parametric_valve(desc);
  for (Leaflet &leaflet : valve.leaflets) {
    leaflet.law = law;
    leaflet.constants = default_constants(find_leaflet_law(law)->constants);
  }
  return valve;
}

// Six triangles around an apex, springs without bending, the rim fixed. Under the pressure p the
// apex carries p A / 3, A the area of the base, at any height z. The springs of rest length L0 and
// stiffness k carry 6 k (1 - L0 / L) z, L^2 = r^2 + z^2, k = E t (area of two triangles) / L0^2: a
// von Mises truss, which snaps at L^3 = L0 r^2.
struct Pyramid {
  static constexpr double radius = 10e-3, height = 3e-3, young = 100e3, thickness = 1e-3;
  Model model;
  double rest_length, k, base;

  Pyramid() {
    Valve valve;
    valve.bending_scale = 0;
    valve.contact_thickness = 1e-4;
    valve.rest.push_back({0, 0, height});
    for (uint32_t i = 0; i < 6; ++i) {
      valve.rest.push_back({radius * std::cos(i * pi / 3), radius * std::sin(i * pi / 3), 0});
      valve.triangles.push_back({0, 1 + i, 1 + (i + 1) % 6});
    }
    valve.leaflets.resize(1);
    valve.leaflets[0].thickness = thickness;
    model = model_of_sheet(valve, {1, 2, 3, 4, 5, 6});
    rest_length = std::sqrt(radius * radius + height * height);
    k = young * thickness * 2 * model.rest_area[0] / (rest_length * rest_length);
    base = 6 * std::sqrt(0.75) / 2 * radius * radius;
  }
  double length(double z) const { return std::sqrt(radius * radius + z * z); }
  // The upward force of the springs.
  double force(double z) const { return -6 * k * (1 - rest_length / length(z)) * z; }
  double pressure_at(double z) const { return -3 * force(z) / base; }
  // Vertical and lateral eigenvalue.
  double vertical(double z) const {
    return 6 * k * (1 - rest_length * radius * radius / std::pow(length(z), 3));
  }
  double snap_height() const {
    return std::sqrt(std::pow(rest_length * radius * radius, 2.0 / 3) - radius * radius);
  }
  State at(double z) const {
    State state = initial_state(model);
    state.x.edit()[0].z() = z;
    state.load.pressure = pressure_at(z);
    return state;
  }
};

}  // namespace

TEST_CASE("margins_are_those_of_a_dense_eigensolver") {
  for (const LeafletLawId law : {LeafletLawId::spring, LeafletLawId::may_newman_yin}) {
    const Model model = *make_model(parametric(200, law));
    State state = closed(model);
    // at rest, and beside it, where the tangent is indefinite
    for (const double off : {0.0, 1e-4}) {
      Random random(3);
      for (uint32_t i = 0; i < state.x.size(); ++i) {
        if (!model.topology.fixed[i]) state.x.edit()[i] += random.vector(off);
      }
      const Stability found = check_stability(model, state);
      const DenseTangent dense(model, state);
      CHECK((dense.skew + dense.skew.transpose()).norm() < 1e-12 * dense.skew.norm());
      CHECK(found.stiffness == about(dense.stiffness(), 0.01));
      CHECK(found.rate == about(dense.rate(), 0.01));
      CHECK(found.is_stable == (dense.rate() < 1e-3));
      CHECK(largest(found.mode) == about(1, 1e-12));
    }
  }
}

// Its trunks that are slack, or carry next to nothing, would be the softest part of the valve.
TEST_CASE("margins_leave_out_branch_points_that_carry_nothing") {
  mvs_parametric_desc desc = {};
  desc.struct_size = sizeof desc;
  desc.vertices = 300;
  desc.chord_slack = 1.05;
  const Model model = *make_model(make_parametric_valve(desc));
  const State state = closed(model);
  DenseTangent dense(model, state);
  const auto rows = dense.damping.size();
  CHECK(dense.stiffness() < 1e-3);
  dense.leave_out(model, 1e-3);
  CHECK(dense.damping.size() < rows);
  const Stability found = check_stability(model, state);
  CHECK(found.stiffness == about(dense.stiffness(), 0.01));
  CHECK(found.stiffness > 0.01);
  CHECK(found.rate == about(dense.rate(), 0.01));
}

// Held where it is, the point would make an anchor of the chord, and the truss stable.
TEST_CASE("a_chord_to_a_point_that_nothing_else_holds_has_no_stiffness") {
  const Pyramid pyramid;
  const double z = 0.8 * pyramid.snap_height(), length = 5e-3;
  Valve valve = pyramid.model.valve;
  const Vec3 apex(0, 0, z), point = apex + (1 + 1e-9) * length * Vec3::UnitZ();
  valve.rest.push_back(point);
  valve.rest.push_back(point + length * Vec3::UnitX());
  Chord chord, trunk;
  chord.id = 1;
  chord.a = 7;
  chord.b = 0;
  chord.rest_length = length;
  trunk.id = 2;
  trunk.a = 8;
  trunk.b = 7;
  trunk.rest_length = 2 * length;  // slack
  valve.chords.push_back(chord);
  valve.chords.push_back(trunk);
  const Model model = model_of_sheet(valve, {1, 2, 3, 4, 5, 6, 8});
  State state = initial_state(model);
  state.x.edit()[0] = apex;
  state.load.pressure = pyramid.pressure_at(z);
  const Stability tight = check_stability(model, state);
  CHECK_FALSE(tight.is_stable);
  CHECK(tight.stiffness == about(pyramid.vertical(z), 0.01));
  // with a trunk that is tight as well it is an anchor
  valve.chords[1].rest_length = (1 - 1e-6) * length;
  valve.rest[8] = point + length * Vec3::UnitZ();
  const Model in_line = model_of_sheet(valve, {1, 2, 3, 4, 5, 6, 8});
  State held = initial_state(in_line);
  held.x.edit()[0] = apex;
  held.load.pressure = pyramid.pressure_at(z);
  CHECK(check_stability(in_line, held).is_stable);
}

TEST_CASE("a_truss_snaps_at_its_critical_pressure") {
  const Pyramid pyramid;
  const double z = pyramid.snap_height();
  for (const double above : {0.9, 0.2, 0.02, 0.001}) {
    const Stability before = check_stability(pyramid.model, pyramid.at(z * (1 + above)));
    CHECK(before.is_stable);
    CHECK(before.stiffness == about(pyramid.vertical(z * (1 + above)), 0.01));
    const Stability after = check_stability(pyramid.model, pyramid.at(z * (1 - above)));
    CHECK_FALSE(after.is_stable);
    CHECK(after.stiffness == about(pyramid.vertical(z * (1 - above)), 0.01));
    CHECK(std::abs(after.mode[0].z()) == about(1, 1e-6));
  }
  // under 0.999 and 1.001 times the critical pressure
  State below = pyramid.at(z), beyond = below;
  below.load.pressure *= 0.999;
  beyond.load.pressure *= 1.001;
  SolveOptions options;
  options.residual = 1e-9;
  const Settled held = settle(pyramid.model, below, options);
  CHECK(held.stats.converged);
  CHECK(held.state.x[0].z() > z);
  const Settled snapped = settle(pyramid.model, beyond, options);
  CHECK(snapped.stats.converged);
  CHECK(snapped.state.x[0].z() < 0);
}

TEST_CASE("every_solver_leaves_an_unstable_equilibrium") {
  const Pyramid pyramid;
  const double z = 0.5 * pyramid.snap_height();
  const State balanced = pyramid.at(z);
  for (const SolverKind solver :
       {SolverKind::newton, SolverKind::implicit_euler, SolverKind::explicit_euler}) {
    SolveOptions options;
    options.solver = solver;
    options.damping = 500;
    options.checks_stability = true;
    const Settled settled = settle(pyramid.model, balanced, options);
    CHECK(settled.stats.converged);
    CHECK(settled.stats.stable);
    CHECK(settled.stats.stiffness_margin > 0);
    CHECK(std::abs(settled.state.x[0].z() - z) > 1e-4);
    options.margins = false;
    const Settled without = settle(pyramid.model, balanced, options);
    CHECK(without.stats.stable);
    CHECK(without.stats.stiffness_margin == 0);
    CHECK(same_bits(without.state.x.get(), settled.state.x.get()));
  }
  SolveOptions options;
  options.max_iterations = 1;
  const Settled stopped = settle(pyramid.model, balanced, options);
  CHECK_FALSE(stopped.stats.converged);
}

// A narrow strip between two clamps buckles at the shortening 4 pi^2 E I / (E A L^2) (Euler).
// Hinges on a lattice have E I = 8/9 D b, D = E t^3 / 9 (tests/verification/bending.cpp). The free
// edges lack hinges (-1.3 % with 12 cells), and the clamps hinder the curl (+1.3 % at this width).
TEST_CASE("a_strip_buckles_at_eulers_load") {
  const uint32_t cells = 12, rows = 300;
  const double length = 60e-3, thickness = 1e-3, young = 100e3;
  const double spacing = length / (rows - 1), edge = spacing / std::sqrt(0.75);
  Valve valve;
  valve.leaflets.resize(1);
  valve.leaflets[0].law = LeafletLawId::neo_hookean;
  valve.leaflets[0].constants = {young / 3};
  valve.leaflets[0].thickness = thickness;
  valve.contact_thickness = 1e-5;
  for (uint32_t j = 0; j <= rows; ++j) {
    for (uint32_t i = 0; i <= cells; ++i) {
      valve.rest.push_back({(j - 0.5) * spacing, edge * (i + 0.5 * (j % 2)), 0});
    }
  }
  std::vector<uint32_t> held;
  for (uint32_t j = 0; j < rows; ++j) {
    for (uint32_t i = 0; i < cells; ++i) {
      const uint32_t a = j * (cells + 1) + i, b = a + 1, c = a + cells + 1, d = c + 1;
      valve.triangles.push_back({a, j % 2 == 0 ? c : d, b});
      valve.triangles.push_back(j % 2 == 0 ? Tri{b, c, d} : Tri{a, c, d});
    }
  }
  for (uint32_t i = 0; i <= cells; ++i) {
    for (const uint32_t row : {0u, 1u, rows - 1, rows}) held.push_back(row * (cells + 1) + i);
  }
  const Model model = model_of_sheet(valve, held);
  const auto flat_at = [&](double shortening) {
    State state = initial_state(model);
    // uniaxial stress in an incompressible sheet
    for (Vec3 &p : state.x.edit())
      p = {(1 - shortening) * p.x(), (1 + 0.5 * shortening) * p.y(), 0};
    return state;
  };
  const double critical = 4 * pi * pi * 8 / 81 * thickness * thickness / (length * length);
  const double low = 0.5 * critical, high = 0.9 * critical;
  const double at_low = check_stability(model, flat_at(low)).stiffness;
  const double at_high = check_stability(model, flat_at(high)).stiffness;
  const double found = low + (high - low) * at_low / (at_low - at_high);
  CHECK(found == about(critical, 0.01));
}

TEST_CASE("a_settled_valve_returns_from_a_small_disturbance") {
  const LeafletLawId laws[] = {LeafletLawId::spring, LeafletLawId::bilinear, LeafletLawId::fung,
                               LeafletLawId::may_newman_yin, LeafletLawId::prot};
  const uint32_t valves = std::getenv("MVS_TEST_LONG") != nullptr ? 200 : 10;
  for (uint32_t k = 0; k < valves; ++k) {
    Random random(k + 1);
    mvs_parametric_desc desc = {};
    desc.struct_size = sizeof desc;
    desc.vertices = static_cast<uint32_t>(random(200, 500));
    desc.branching = k % 2;
    desc.annulus_scale = random(0.9, 1.1);
    desc.chord_slack = random(0.95, 1.1);
    desc.thickness = random(0.6e-3, 1.2e-3);
    Valve valve = make_parametric_valve(desc);
    const LeafletLawId law = laws[k % 5];
    for (Leaflet &leaflet : valve.leaflets) {
      leaflet.law = law;
      leaflet.constants = default_constants(find_leaflet_law(law)->constants);
    }
    const Model model = *make_model(valve);
    SolveOptions options;
    options.residual = 1e-7;
    options.max_iterations = 3000;
    const Settled first = settle(model, MVS_SYSTOLE_PA, 1, options);
    CAPTURE(k);
    REQUIRE(first.stats.converged);
    options.margins = false;
    CHECK(same_bits(settle(model, MVS_SYSTOLE_PA, 1, options).state.x.get(), first.state.x.get()));
    options.margins = true;
    CHECK(first.stats.stable);
    State disturbed = first.state;
    for (uint32_t i = 0; i < disturbed.x.size(); ++i) {
      if (!model.topology.fixed[i]) disturbed.x.edit()[i] += random.vector(1e-6 / std::sqrt(3.0));
    }
    const Settled again = settle(model, disturbed, options);
    REQUIRE(again.stats.converged);
    const double margin =
        std::min(std::abs(first.stats.stiffness_margin), std::abs(again.stats.stiffness_margin));
    const double bound = std::max(1e-6, 2 * options.residual / margin);
    // branch points may have no place to return to
    double moved = 0;
    for (uint32_t i = 0; i < model.vertex_area.size(); ++i) {
      if (model.vertex_area[i] == 0) continue;
      moved = std::max(moved, (again.state.x[i] - first.state.x[i]).norm());
    }
    CHECK(moved <= bound);
  }
}

}  // namespace mvs::core::test
