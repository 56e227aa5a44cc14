// A state that was saved at rest is found at rest when it is read again, and no other is.
#include "solve/rest_claim.h"

#include <doctest/doctest.h>

#include "formats/formats.h"
#include "model/checks/check.h"
#include "solve/solver.h"
#include "tests/model/real_valves.h"
#include "tests/solve/bench.h"
#include "tests/solve/moving_valve.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

// The state after a settle by this solver, written to an OBJ file and read again.
ModelState saved_at_rest(const ModelPtr &model, double pressure, SolverKind kind,
                         double residual = 0) {
  State state = initial_state(*model);
  state.load = {pressure, 1};
  SolveOptions how;
  how.solver = kind;
  how.residual = residual;
  Solver solver(Backend::fastest);
  REQUIRE(solver.settle(*model, state, how, {}).converged);
  Loaded loaded = read_obj(write_obj(*model, state));
  ModelState read{make_model(loaded.valve), loaded.state};
  CHECK(read.state.is_at_rest());
  CHECK(hash_of(*read.model, read.state) == hash_of(*model, state));
  return read;
}

}  // namespace

TEST_CASE("a_state_saved_at_rest_is_at_rest") {
  const ModelPtr model = make_model(moving_valve());
  for (const double pressure : {0.0, 4e3, systole}) {
    CAPTURE(pressure);
    for (const double residual : {1e-3, 1e-5, 1e-9}) {
      const ModelState read = saved_at_rest(model, pressure, SolverKind::newton, residual);
      CHECK(fault_of_rest(*read.model, read.state) == "");
    }
  }
  for (const SolverKind kind : {SolverKind::implicit_euler, SolverKind::explicit_euler}) {
    const ModelState read = saved_at_rest(model, 4e3, kind);
    CHECK(fault_of_rest(*read.model, read.state) == "");
  }
}

TEST_CASE("a_state_off_its_equilibrium_is_not_at_rest") {
  const ModelPtr model = make_model(moving_valve());
  const ModelState at = saved_at_rest(model, systole, SolverKind::newton);
  const auto fault = [&](auto change) {
    State state = at.state;
    change(state);
    return fault_of_rest(*at.model, state);
  };
  uint32_t node = 0;
  while (at.model->topology.fixed[node]) ++node;
  CHECK(fault([](State &) {}) == "");
  CHECK(fault([&](State &s) { s.x[node].z() += 1e-5; }).find("out-of-balance force is") !=
        std::string::npos);
  CHECK(fault([](State &s) { s.load.pressure *= 1.01; }).find("force") != std::string::npos);
  CHECK(fault([](State &s) { s.load.boundary_fraction = 0.5; }).find("annulus") !=
        std::string::npos);
  CHECK(fault([&](State &s) { s.v[node].x() = 1e-3; }).find("velocities") != std::string::npos);
  // a state that does not say that it is at rest has no fault
  CHECK(fault([](State &s) { s.load.pressure = s.rest_tolerance = 0; }) == "");
}

TEST_CASE("a_real_valve_saved_at_rest_is_at_rest") {
  const nlohmann::json json = read_real_valve("kaiser_mitral_normal_1/N32.json");
  if (json.is_null()) {
    MESSAGE("skipped: no kaiser_mitral_normal_1/N32.json in MVS_TEST_DATA or ../shared/data");
    return;
  }
  Valve valve = kaiser_valve(json);
  valve.loaded = valve.rest;
  const auto place = [&](uint32_t node) {
    valve.loaded[node] = in_metres(json["vertices_pressurized"][node]);
  };
  for (const uint32_t node : valve.annulus.get()) place(node);
  for (const Head &head : valve.heads.get()) place(head.node);
  orient(valve);
  for (const LeafletLawId law : {LeafletLawId::spring, LeafletLawId::fung}) {
    valve.leaflets[0].law = law;
    const ModelState read = saved_at_rest(make_model(valve), systole, SolverKind::newton);
    CHECK(fault_of_rest(*read.model, read.state) == "");
  }
}
