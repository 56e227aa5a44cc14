// Cost of closing a valve in units of its unavoidable work: one factorisation of the system without
// contact, one pass over the terms, one search for pairs, on the same machine in one run.
//
//   bench_limit                      springs, scenes S, M, L
//   bench_limit --leaflet membrane --scenes S
//   bench_limit --csv FILE
//
// The system is that of the open valve, where nothing touches, with a thousandth of its largest
// diagonal entry added so that it is positive definite; passes and pairs are those of the closed
// valve. CPU time, the fastest of the rounds. The last column is the closure in that unit; goals:
// 40 factorisations by CHOLMOD (simplicial LDL^T) on S and M, 30 on L.
#include <mvs/sim.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "anatomy/parametric.h"
#include "energy/total_energy.h"
#include "linalg/direct_solver.h"
#include "solve/static/mesh_hierarchy.h"
#include "tests/bench/closing.h"
#include "tests/bench/search.h"
#include "tests/bench/table.h"

using namespace mvs::core;

namespace {

struct Options {
  std::vector<std::string> scenes = {"S", "M", "L"};
  std::string leaflet = "spring";
  double residual = bench::rest_residual;
  int rounds = 20, repeat = 3;
  std::string csv;
};

struct Unit {
  std::string name;
  double seconds;
};

ModelPtr make_scene(const Options &options, const std::string &scene) {
  mvs_parametric_desc desc = {};
  desc.shape = MVS_SHAPE_FOUNDING;
  desc.struct_size = sizeof desc;
  desc.vertices = bench::scene_vertices.at(scene);
  Valve valve = make_parametric_valve(desc);
  for (size_t k = 0; options.leaflet == "membrane" && k < valve.leaflets.size(); ++k) {
    valve.leaflets[k].law = LeafletLawId::bilinear;
    for (const LeafletLaw &law : leaflet_laws()) {
      if (law.id == LeafletLawId::bilinear)
        valve.leaflets[k].constants = default_constants(law.constants);
    }
  }
  return make_model(std::move(valve));
}

// The CPU seconds of closing; `state` is closed afterwards.
double close(const Options &options, const Model &model, State &state) {
  std::vector<double> cpu_s;
  for (int k = 0; k < options.repeat; ++k) {
    state = initial_state(model);
    state.load = {MVS_SYSTOLE_PA, 1};
    SolveOptions how;
    how.residual = options.residual;
    Solver solver(Backend::fastest);
    SolveStats stats;
    cpu_s.push_back(bench::timed([&] {
                      stats = settle_with_mesh_hierarchy(solver, model, state, how, {});
                    }).cpu);
    if (!stats.converged) std::printf("not at rest: %.1e N\n", stats.residual);
  }
  return bench::median(cpu_s);
}

std::vector<Vec3> nodes_of(const CowVector<Vec3> &x) {
  return {x.begin(), x.end()};
}

// The system of the open valve, which has no contact.
HessianAssembler free_system(const Model &model) {
  TotalEnergy total_energy(model);
  Profile profile;
  HessianAssembler system;
  std::vector<Vec3> x = nodes_of(model.valve.rest), g;
  total_energy.prepare(x, x, 0, profile);
  total_energy.gradient(x, g, profile);
  total_energy.hessian(x, Curvature::projected, system, profile);
  BlockMatrix &matrix = system.matrix;
  double largest = 0;
  for (uint32_t r = 0; r < matrix.size(); ++r)
    largest = std::max(largest, matrix.value[matrix.start[r]].diagonal().maxCoeff());
  for (uint32_t r = 0; r < matrix.size(); ++r)
    matrix.value[matrix.start[r]].diagonal().array() += 1e-3 * largest;
  return system;
}

std::vector<Edge> pairs_of(const BlockMatrix &matrix) {
  std::vector<Edge> pairs;
  for (uint32_t c = 0; c < matrix.size(); ++c) {
    for (uint32_t k = matrix.start[c] + 1; k < matrix.start[c + 1]; ++k)
      pairs.push_back({c, matrix.row[k]});
  }
  return pairs;
}

void add_factor(const Options &options, const BlockMatrix &matrix, const std::string &name,
                Backend backend, std::vector<Unit> &units) {
  if (std::string(factor_names()).find(name) == std::string::npos) return;
  const auto factor = make_direct_solver(backend);
  units.push_back(
      {name + " analysis", bench::fastest(options.rounds, [&] { factor->analyse(matrix); })});
  bool definite = true;
  units.push_back({name + " factorisation", bench::fastest(options.rounds, [&] {
                     definite = factor->factorise(matrix) && definite;
                   })});
  if (!definite) throw std::runtime_error("the system without contact is not positive definite");
  const std::vector<Vec3> ones(matrix.size(), Vec3::Ones());
  std::vector<Vec3> b;
  units.push_back({name + " solution", bench::fastest(options.rounds, [&] {
                     b = ones;
                     factor->solve(b);
                   })});
}

void add_system(const Options &options, const Model &model, std::vector<Unit> &units) {
  const BlockMatrix matrix = free_system(model).matrix;
  add_factor(options, matrix, "cholmod", Backend::cholmod, units);
  add_factor(options, matrix, "eigen", Backend::eigen, units);
  add_factor(options, matrix, "block", Backend::block, units);
  const std::vector<Edge> pairs = pairs_of(matrix);
  units.push_back({"order of elimination", bench::fastest(options.rounds, [&] {
                     fill_reducing_order(matrix.size(), pairs);
                   })});
}

void add_passes(const Options &options, const Model &model, const State &closed,
                std::vector<Unit> &units) {
  TotalEnergy total_energy(model);
  total_energy.set_pressure(MVS_SYSTOLE_PA);
  Profile profile;
  HessianAssembler system;
  std::vector<Vec3> x = nodes_of(closed.x), g;
  const double slack = 0.02 * model.valve.contact_thickness;  // as in mvs_settle
  BroadPhase pairs(model);
  units.push_back({"broad phase", bench::time_of_search(options.rounds, x, slack, pairs)});
  ContactTerm contact(model);
  units.push_back(
      {"narrow phase", bench::fastest(options.rounds, [&] { contact.collect(x, pairs); })});
  total_energy.prepare(x, x, slack, profile);
  units.push_back({"energy", bench::fastest(options.rounds, [&] { total_energy.energy(x); })});
  units.push_back(
      {"gradient", bench::fastest(options.rounds, [&] { total_energy.gradient(x, g, profile); })});
  total_energy.hessian(x, Curvature::projected, system, profile);
  units.push_back({"Hessian, assembled", bench::fastest(options.rounds, [&] {
                     total_energy.hessian(x, Curvature::projected, system, profile);
                   })});
}

void run(const Options &options) {
  bench::Table table({"scene", "vertices", "unit                  ", "ms", "closure in it"},
                     options.csv);
  for (const std::string &scene : options.scenes) {
    const ModelPtr model = make_scene(options, scene);
    State closed;
    const double closure = close(options, *model, closed);
    std::vector<Unit> units = {{"closure", closure}};
    add_system(options, *model, units);
    add_passes(options, *model, closed, units);
    for (const Unit &unit : units)
      table.row({scene, bench::scene_vertices.at(scene), unit.name, unit.seconds * 1e3,
                 closure / unit.seconds});
  }
}

}  // namespace

int main(int argc, char **argv) {
  try {
    Options options;
    CLI::App app("Closure in units of one factorisation, one pass, one search.", "bench_limit");
    app.add_option("--scenes", options.scenes, "S 425, M 1700, L 6800, XL 27000 vertices")
        ->capture_default_str()
        ->check(CLI::IsMember(bench::keys(bench::scene_vertices)));
    app.add_option("--leaflet", options.leaflet, "spring or membrane")
        ->capture_default_str()
        ->check(CLI::IsMember({"spring", "membrane"}));
    app.add_option("--residual", options.residual, "N, at which a valve is at rest")
        ->check(CLI::PositiveNumber);
    app.add_option("--rounds", options.rounds, "of each unit")->check(CLI::PositiveNumber);
    app.add_option("--repeat", options.repeat, "closures")->check(CLI::PositiveNumber);
    app.add_option("--csv", options.csv, "file to write the table to");
    CLI11_PARSE(app, argc, argv);
    run(options);
    return 0;
  } catch (const std::exception &error) {
    std::fprintf(stderr, "bench_limit: %s\n", error.what());
    return 1;
  }
}
