// `mvs close`: settles a valve under systolic pressure and measures it.
#include <map>
#include <optional>

#include "commands/commands.h"
#include "text/command_units.h"
#include "text/output_file.h"
#include "text/readouts.h"
#include "valve/at_rest.h"
#include "valve/ensemble.h"
#include "valve/pressure.h"
#include "valve/reference.h"
#include "valve/tissue.h"

namespace cli {
namespace {

using Choices = std::map<std::string, uint32_t>;
const Choices solvers = {{"newton", MVS_SOLVER_NEWTON},
                         {"implicit", MVS_SOLVER_IMPLICIT},
                         {"explicit", MVS_SOLVER_EXPLICIT}};
const Choices all_backends = {{"default", MVS_BACKEND_DEFAULT},
                              {"cholmod", MVS_BACKEND_CHOLMOD},
                              {"eigen", MVS_BACKEND_EIGEN},
                              {"block", MVS_BACKEND_BLOCK}};

// Those of this build of the library, which names them among its features.
const Choices &backends() {
  static const Choices here = [] {
    const std::string features = " " + std::string(mvs_features()) + " ";
    Choices found = all_backends;
    std::erase_if(found, [&](const auto &backend) {
      return backend.first != "default" &&
             features.find(" " + backend.first + " ") == std::string::npos;
    });
    return found;
  }();
  return here;
}

std::string absent_backend(const std::string &given) {
  if (!all_backends.count(given) || backends().count(given)) return "";
  return "this build of libmvs has no " + given +
         ": leave out --backend, or build libmvs with it (-DMVS_CHOLMOD=ON)";
}

struct CloseOptions {
  std::string in, out, reference;
  std::string leaflet = "file", solver = "newton", backend = "default";
  std::optional<double> pressure_mmhg;
  bool allow_unsettled = false;
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

Closed close_valve(const CloseOptions &options, const Console &console) {
  Progress progress(console);
  mvs_sim_desc desc = with_workers(console);
  desc.backend = backends().at(options.backend);
  mvs::Simulator sim = load_sim(options.in, progress, desc);
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
  with_command_units([&] { sim.set_load(pressure_mmhg * pa_per_mmhg); });
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

Json closed_json(const CloseOptions &options, const Closed &closed, const mvs_measures &measures) {
  const Size size = size_of(closed.valve);
  const mvs_stats &stats = closed.stats;
  Json json = {{"file", options.in},
               {"leaflet", laws_of(closed.valve)},
               {"solver", options.solver},
               {"pressure_mmHg", closed.pressure_mmhg},
               {"kinetic_J", stats.kinetic},
               {"contact_pairs", stats.contact_pairs},
               {"profile", profile_json(closed.profile)},
               {"vertices", size.vertices},
               {"faces", size.faces},
               {"chords", size.chords}};
  json.update(closure_json(closed.valve, stats, measures));
  if (closed.ensemble) json["ensemble"] = ensemble_json(*closed.ensemble, options.ensemble);
  if (closed.errors) json["reference"] = errors_json(*closed.errors);
  return json;
}

std::string closed_text(const CloseOptions &options, const Closed &closed,
                        const mvs_measures &measures) {
  const mvs_stats &stats = closed.stats;
  return text("%s: %s%s under %g mmHg after %.2f s, %u iterations, residual %.1e N\n",
              options.in.c_str(), stats.converged ? "at rest" : "NOT at rest",
              measures.intersections != 0 ? ", leaflets CROSS," : "", closed.pressure_mmhg,
              stats.wall_s, stats.iterations, stats.residual) +
         (closed.ensemble ? ensemble_text(*closed.ensemble) : measures_text(measures)) +
         (closed.errors ? errors_text(*closed.errors) : "");
}

// A valve that is not at rest is written, marked, warned of, and ends with exit code 1. One whose
// leaflets cross is warned of.
void run_close(const CloseOptions &options, Console &console) {
  if (options.settle.dt > 0 && options.solver == "newton") {
    throw CLI::ValidationError("--dt",
                               "newton has no time steps: give --solver implicit or explicit");
  }
  demand_writable_valve(options.out);
  std::optional<mvs::Snapshot> reference;  // read first: a missing file fails before the closure
  if (!options.reference.empty()) reference = load(options.reference);
  Closed closed = close_valve(options, console);
  if (reference) {
    const Ensemble *ensemble = closed.ensemble ? &*closed.ensemble : nullptr;
    closed.errors = errors_from(options.reference, *reference, closed.valve, ensemble);
  }
  const mvs_measures measures = closed.valve.measure();
  if (!options.out.empty()) closed.valve.save(options.out);
  warn_unsettled(closed.stats, options.in, " (see --max-iterations)");
  warn_crossing(measures, options.in);
  print(console, closed_json(options, closed, measures), closed_text(options, closed, measures));
  demand_rest(console, closed.stats, options.allow_unsettled);
}

using Complaint = std::string (*)(const std::string &);

// `complain` gives a better sentence than "unknown" for some words, else "".
void add_choice(CLI::App &command, const char *option, std::string &value, const char *help,
                const Choices &choices, Complaint complain = nullptr) {
  std::vector<std::string> names;
  for (const auto &[name, number] : choices) names.push_back(name);
  CLI::Option *added = command.add_option(option, value, help)->capture_default_str();
  if (complain) added->check(complain, "");
  added->check(one_of(names));
}

}  // namespace

void add_close(CLI::App &app, Console &console) {
  const auto [command, options] = add_command<CloseOptions>(
      app, console, "close", "close a valve under systolic pressure and measure it", run_close);
  command->add_option("file", options->in, "valve to close, .obj, .h5 or .inp")->required();
  command->add_option("-o,--output", options->out,
                      "write the closed valve, .obj, .h5, .vtp or .vtm");
  add_pressure_option(*command, options->pressure_mmhg);
  add_tissue_option(*command, options->leaflet);
  add_choice(*command, "--solver", options->solver, "method; explicit does not prevent crossing",
             solvers);
  add_choice(*command, "--backend", options->backend, "sparse factorisation", backends(),
             absent_backend);
  command
      ->add_option("--residual", options->settle.residual,
                   "largest out-of-balance force of a node at rest, N [1e-5]")
      ->check(positive());
  command
      ->add_option("--max-iterations", options->settle.max_iterations,
                   "iterations or time steps [newton 1000, implicit 20000, explicit 2000000]")
      ->check(positive());
  command
      ->add_option("--dt", options->settle.dt,
                   "time step of the dynamic solvers, s [implicit 1e-3; explicit: stable on this "
                   "valve, at most 8e-6]")
      ->check(positive());
  command->add_option("--reference", options->reference,
                      "report the distances of the closed valve from the shape in this file");
  add_unsettled_option(*command, options->allow_unsettled);
  add_ensemble_options(*command, options->ensemble);
  add_workers_option(*command, console);
  add_progress_flag(*command, console);
}

}  // namespace cli
