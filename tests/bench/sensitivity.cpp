// Cost of derivatives of a closed valve beside its closure: the gradient of one quantity with
// respect to the rest lengths of all chordae (adjoint), with and without the test of both sides and
// the margin, and the motion of all nodes by each rest length (direct), as a fit needs it.
//
//   bench_sensitivity                  S and M
//   bench_sensitivity --scenes S --repeat 1
//   bench_sensitivity --csv FILE
//
// CPU time in ms of the fastest run; the closure is one from open, with its check of stability, to
// 1e-4 N. Shares are of that closure, from the same run of the program. The orifice is that of a
// valve with its annulus dilated by 1.4; its measurement, which the snapshot keeps for its measures
// and its gradients, is timed apart.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <mvs/experimental.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tests/bench/closing.h"
#include "tests/bench/table.h"

namespace {

struct Options {
  std::vector<std::string> scenes = {"S", "M"};
  int repeat = 10;
  std::string csv;
};

struct Valve {
  std::optional<mvs::Snapshot> closed;
  double closure_s = 0, orifice_s = 0;  // CPU
};

Valve closed_valve(const std::string &scene, double annulus_scale, int repeat) {
  Valve valve;
  mvs_parametric_desc desc = {};
  desc.struct_size = sizeof desc;
  desc.vertices = bench::scene_vertices.at(scene);
  desc.annulus_scale = annulus_scale;
  mvs_load_case load = {sizeof load, 0, MVS_SYSTOLE_PA, 1};
  mvs_settle_options options = {};
  options.struct_size = sizeof options;
  options.residual = bench::rest_residual;
  for (int k = 0; k < repeat; ++k) {
    mvs::Simulator sim;
    mvs::must(mvs_generate_valve(sim.get(), &desc));
    mvs::must(mvs_set_load(sim.get(), &load));
    const double took =
        bench::timed([&] { mvs::must(mvs_settle(sim.get(), &options, nullptr)); }).cpu;
    valve.closure_s = k == 0 ? took : std::min(took, valve.closure_s);
    valve.closed.emplace(sim.snapshot());
    const double measured =
        bench::timed([&] { valve.closed->measure(MVS_MEASURE_GROUP_ORIFICE); }).cpu;
    valve.orifice_s = k == 0 ? measured : std::min(measured, valve.orifice_s);
  }
  return valve;
}

std::vector<mvs_parameter> rest_lengths(const mvs::Snapshot &valve) {
  std::vector<mvs_parameter> list(valve.parts(MVS_PART_CHORD).size());
  for (uint32_t c = 0; c < list.size(); ++c) {
    list[c] = {};
    list[c].kind = MVS_PARAMETER_CHORD_REST_LENGTH;
    list[c].index = c;
  }
  return list;
}

void add_row(const Options &options, const std::string &scene, const Valve &valve,
             const std::string &name, const mvs_quantity &quantity, bench::Table &table) {
  const std::vector<mvs_parameter> to = rest_lengths(*valve.closed);
  mvs_sensitivity_summary summary = {};
  const auto time = [&](mvs_sensitivity_flags flags) {
    mvs_sensitivity_options how = {};
    how.flags = flags;
    return bench::fastest(options.repeat, [&] {
      summary = mvs::Sensitivity(*valve.closed, {quantity}, to, how).summary();
    });
  };
  const double motion =
      time(MVS_SENSITIVITY_MOTION | MVS_SENSITIVITY_NO_TEST | MVS_SENSITIVITY_NO_MARGIN);
  const double plain = time(MVS_SENSITIVITY_NO_TEST | MVS_SENSITIVITY_NO_MARGIN);
  const double all = time(0);
  table.row({scene, name, static_cast<uint32_t>(to.size()), 1e3 * valve.closure_s, 1e3 * plain,
             100 * plain / valve.closure_s, 1e3 * all, 100 * all / valve.closure_s, 1e3 * motion,
             100 * motion / valve.closure_s, summary.linear_error, 1e3 * valve.orifice_s});
}

mvs_quantity measure(const char *name) {
  mvs_quantity quantity = {};
  quantity.kind = MVS_QUANTITY_MEASURE;
  quantity.measure = name;
  return quantity;
}

int run(int argc, char **argv) {
  Options options;
  CLI::App app("Times derivatives of a closed valve beside its closure.", "bench_sensitivity");
  app.add_option("--scenes", options.scenes, "S 425, M 1700, L 6800 vertices")
      ->capture_default_str()
      ->check(CLI::IsMember(bench::keys(bench::scene_vertices)));
  app.add_option("--repeat", options.repeat, "runs of each")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_option("--csv", options.csv, "file to write the table to");
  CLI11_PARSE(app, argc, argv);
  bench::Table table(
      {"scene ", "quantity                ", "chordae", "closure ms", "adjoint ms", "adjoint %",
       "tested ms", "tested %", "motion ms", "motion %", "error ", "orifice ms"},
      options.csv);
  for (const std::string &scene : options.scenes) {
    const Valve sealed = closed_valve(scene, 1, options.repeat);
    const Valve leaking = closed_valve(scene, 1.4, options.repeat);
    mvs_quantity force = {};
    force.kind = MVS_QUANTITY_HEAD_FORCE;
    force.component = 3;
    add_row(options, scene, sealed, "coaptation_area", measure("coaptation_area"), table);
    add_row(options, scene, sealed, "leaflet_area", measure("leaflet_area"), table);
    add_row(options, scene, sealed, "head force", force, table);
    add_row(options, scene, leaking, "regurgitant_orifice_area",
            measure("regurgitant_orifice_area"), table);
  }
  return 0;
}

}  // namespace

int main(int argc, char **argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception &error) {
    std::fprintf(stderr, "bench_sensitivity: %s\n", error.what());
    return 1;
  }
}
