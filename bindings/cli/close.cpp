// `mvs close`: brings a valve to rest under systolic pressure and measures it.
#include <cstdio>
#include <map>
#include <memory>
#include <optional>

#include "commands.h"
#include "ensemble.h"
#include "pressure.h"
#include "readouts.h"
#include "reference.h"
#include "tissue.h"

namespace cli {
namespace {

const std::map<std::string, uint32_t> solvers = {{"newton", MVS_SOLVER_NEWTON},
                                                 {"implicit", MVS_SOLVER_IMPLICIT},
                                                 {"explicit", MVS_SOLVER_EXPLICIT}};
const std::map<std::string, uint32_t> backends = {{"default", MVS_BACKEND_DEFAULT},
                                                  {"cholmod", MVS_BACKEND_CHOLMOD},
                                                  {"eigen", MVS_BACKEND_EIGEN}};

struct Options {
  std::string in, out, reference;
  std::string leaflet = "file", solver = "newton", backend = "default";
  std::optional<double> pressure_mmhg;
  mvs_settle_options settle = {};
  EnsembleOptions ensemble;
};

struct Closed {
  mvs::Snapshot valve;
  mvs_stats stats;
  mvs_profile profile;
  std::optional<Ensemble> ensemble;  // with --members; `valve` is then that of member 0
  std::optional<Errors> errors;      // with --reference
  double pressure_mmhg = 0;
};

Closed close_valve(const Options &options, const Console &console) {
  Progress progress(console);
  mvs_sim_desc desc = {};
  desc.backend = backends.at(options.backend);
  mvs::Sim sim = load_sim(options.in, progress, desc);
  set_tissue(sim, options.leaflet);
  const double pressure_mmhg = pressure_mmhg_of(options.pressure_mmhg, sim);
  mvs_settle_options settle = options.settle;
  settle.solver = solvers.at(options.solver);
  if (options.ensemble.members > 0) {
    Ensemble ensemble = run_ensemble(sim.snapshot(), pressure_mmhg, settle, options.ensemble,
                                     desc.backend, progress);
    return {ensemble.snapshot(0), ensemble.stats(0), ensemble.profile(0), std::move(ensemble), {},
            pressure_mmhg};
  }
  sim.set_load(pressure_mmhg * pa_per_mmhg);
  const mvs_stats stats = sim.settle(settle);
  return {sim.snapshot(), stats, mvs::profile_of(sim), {}, {}, pressure_mmhg};
}

Json profile_json(const mvs_profile &profile) {
  Json json = Json::object();
  for (const mvs_field_info &field : mvs::fields_of(MVS_STRUCT_PROFILE)) {
    const double value = mvs::field_value(&profile, field);
    json[field.name] =
        field.type == MVS_FIELD_COUNT ? Json(static_cast<uint32_t>(value)) : Json(value);
  }
  return json;
}

Json result_json(const Options &options, const Closed &closed, const mvs_measures &measures) {
  const Size size = size_of(closed.valve);
  const mvs_stats &stats = closed.stats;
  Json json = {{"file", options.in},
               {"leaflet", laws_of(closed.valve)},
               {"solver", options.solver},
               {"pressure_mmHg", closed.pressure_mmhg},
               {"converged", stats.converged != 0},
               {"iterations", stats.iterations},
               {"wall_s", stats.wall_s},
               {"residual_N", stats.residual},
               {"energy_J", stats.energy},
               {"kinetic_J", stats.kinetic},
               {"contact_pairs", stats.contact_pairs},
               {"profile", profile_json(closed.profile)},
               {"vertices", size.vertices},
               {"faces", size.faces},
               {"chords", size.chords},
               {"intersections", measures.intersections},
               {"hash", hash_of(closed.valve)},
               {"measures", measures_json(measures)}};
  if (closed.ensemble) json["ensemble"] = ensemble_json(*closed.ensemble, options.ensemble);
  if (closed.errors) json["reference"] = errors_json(*closed.errors);
  return json;
}

std::string result_text(const Options &options, const Closed &closed,
                        const mvs_measures &measures) {
  const mvs_stats &stats = closed.stats;
  return text("%s: %s under %g mmHg after %.2f s, %u iterations, residual %.1e N\n",
              options.in.c_str(), stats.converged ? "at rest" : "NOT at rest", closed.pressure_mmhg,
              stats.wall_s, stats.iterations, stats.residual) +
         (closed.ensemble ? ensemble_text(*closed.ensemble) : measures_text(measures)) +
         (closed.errors ? errors_text(*closed.errors) : "");
}

// Not at rest is a result, not a failure: it is written and marked, and said aloud.
void run(const Options &options, const Console &console) {
  std::optional<mvs::Snapshot> reference;  // first: a file that is not there costs no closure
  if (!options.reference.empty()) reference = load(options.reference);
  Closed closed = close_valve(options, console);
  if (reference) {
    const Ensemble *ensemble = closed.ensemble ? &*closed.ensemble : nullptr;
    closed.errors = errors_from(options.reference, *reference, closed.valve, ensemble);
  }
  const mvs_measures measures = closed.valve.measure();
  if (!options.out.empty()) closed.valve.save(options.out);
  if (!closed.stats.converged) {
    std::fprintf(stderr,
                 "mvs: warning: not converged after %u iterations, residual %.1e N; the shape is "
                 "not an equilibrium (see --max-iterations)\n",
                 closed.stats.iterations, closed.stats.residual);
  }
  print(console, result_json(options, closed, measures), result_text(options, closed, measures));
}

std::vector<std::string> names_of(const std::map<std::string, uint32_t> &map) {
  std::vector<std::string> names;
  names.reserve(map.size());
  for (const auto &[name, value] : map) names.push_back(name);
  return names;
}

}  // namespace

void add_close(CLI::App &app, Console &console) {
  auto options = std::make_shared<Options>();
  CLI::App *command =
      add_command(app, console, "close", "close a valve under systolic pressure and measure it");
  command->add_option("file", options->in, "valve to close, .obj, .h5 or .inp")->required();
  command->add_option("-o,--output", options->out, "write the closed valve, .obj, .h5 or .vtp");
  add_pressure_option(*command, options->pressure_mmhg);
  add_tissue_option(*command, options->leaflet);
  command->add_option("--solver", options->solver, "method")
      ->capture_default_str()
      ->check(one_of(names_of(solvers)));
  command->add_option("--backend", options->backend, "sparse factorisation")
      ->capture_default_str()
      ->check(one_of(names_of(backends)));
  command
      ->add_option("--residual", options->settle.residual,
                   "largest out-of-balance force of a node at rest, N [1e-5]")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--max-iterations", options->settle.max_iterations,
                   "iterations or time steps [newton 1000, implicit 20000, explicit 2000000]")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--dt", options->settle.dt,
                   "time step of the solvers in time, s [implicit 1e-3, explicit 8e-6]")
      ->check(CLI::PositiveNumber);
  command->add_option("--reference", options->reference,
                      "tell how far the closed valve is from the shape of this file");
  add_ensemble_options(*command, options->ensemble);
  command->add_flag("--progress", console.progress,
                    "show progress on stderr although it is no terminal");
  command->callback([options, &console] { run(*options, console); });
}

}  // namespace cli
