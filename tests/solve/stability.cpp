// Stability of equilibria: margins against dense algebra and Euler's strip; disturbed valves.
#include "solve/stability.h"

#include <algorithm>
#include <cmath>

#include "anatomy/parametric.h"
#include "solve/nodes.h"
#include "tests/dense.h"
#include "tests/short_run.h"
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
  const uint32_t valves = long_run() ? 200 : 10;
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
