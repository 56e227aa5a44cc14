#include "valve/ensemble.h"

#include "text/readouts.h"
#include "valve/at_rest.h"

namespace cli {
namespace {

const char *order_name(uint32_t order) {
  switch (order) {
    case MVS_ENSEMBLE_ORDER_BOUNDARY_FIRST:
      return "boundary first";
    case MVS_ENSEMBLE_ORDER_PRESSURE_FIRST:
      return "pressure first";
    default:
      return "together";
  }
}

Statistics statistics_of(const Ensemble &ensemble) {
  return {ensemble.measure(MVS_ENSEMBLE_STATISTIC_MEAN),
          ensemble.measure(MVS_ENSEMBLE_STATISTIC_MIN),
          ensemble.measure(MVS_ENSEMBLE_STATISTIC_MAX),
          ensemble.measure(MVS_ENSEMBLE_STATISTIC_DEVIATION),
          ensemble.measure(MVS_ENSEMBLE_STATISTIC_COUNT)};
}

Json member_json(const Ensemble &ensemble, uint32_t number) {
  const mvs_ensemble_member member = ensemble.member(number);
  const mvs::Snapshot closed = ensemble.snapshot(number);
  Json json = {{"member", number},
               {"increments", member.increments},
               {"ramp_s", member.ramp},
               {"order", order_name(member.order)},
               {"perturbation_mm", member.perturbation * 1e3},
               {"diverged", member.diverged != 0},
               {"equilibrium", member.converged ? Json(member.equilibrium) : Json()},
               {"node_rms_mm", member.node_rms * 1e3},
               {"node_max_mm", member.node_max * 1e3},
               {"surface_rms_mm", member.surface_rms * 1e3},
               {"surface_max_mm", member.surface_max * 1e3}};
  json.update(closure_json(closed, ensemble.stats(number), closed.measure()));
  return json;
}

std::string summary_text(const Ensemble &ensemble) {
  const mvs_ensemble_summary all = ensemble.summary();
  std::string lines = text("%u of %u members at rest, %u %s", all.converged, all.members,
                           all.equilibria, all.equilibria == 1 ? "equilibrium" : "equilibria");
  if (all.converged > 0)
    lines += text(", the lowest energy in equilibrium %u", ensemble.member(all.lowest).equilibrium);
  return lines +
         text(
             "\nbetween members: nodes %.3f mm RMS, %.2f mm at most; from member 0: surface "
             "%.3f mm RMS, %.2f mm at most\n",
             all.node_rms * 1e3, all.node_max * 1e3, all.surface_rms * 1e3, all.surface_max * 1e3);
}

std::string member_text(const Ensemble &ensemble, uint32_t number) {
  const mvs_ensemble_member member = ensemble.member(number);
  const mvs_stats stats = ensemble.stats(number);
  const std::string equilibrium = member.converged  ? std::to_string(member.equilibrium)
                                  : member.diverged ? "diverged"
                                                    : "NOT at rest";
  const std::string increments =
      member.ramp > 0 ? text("in %.0f ms", member.ramp * 1e3) : std::to_string(member.increments);
  return text("  %6u %10s  %-14s %8.2f %10u %12s %12.4f %8.3f %8.2f\n", number, increments.c_str(),
              order_name(member.order), member.perturbation * 1e3, stats.iterations,
              equilibrium.c_str(), stats.energy * 1e3, member.node_rms * 1e3,
              member.node_max * 1e3);
}

}  // namespace

void add_ensemble_options(CLI::App &command, EnsembleOptions &options) {
  auto *members = command.add_option(
      "--members", options.members,
      "close an ensemble of this many members, the plain closure first, and report the distances "
      "between them");
  members->check(CLI::Range(1, 1000));
  command.add_option("--seed", options.seed, "seed of the perturbations of the start")
      ->capture_default_str()
      ->needs(members);
  command
      .add_option("--perturbation", options.perturbation_mm,
                  "largest displacement of a node of the start, mm; 0: no perturbation")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 5.0))
      ->needs(members);
}

Ensemble run_ensemble(const mvs::Snapshot &start, double pressure_mmhg,
                      const mvs_settle_options &settle, const EnsembleOptions &options,
                      uint32_t backend, Progress &progress) {
  mvs_load_case load = {};
  load.pressure = pressure_mmhg * pa_per_mmhg;
  load.boundary_fraction = 1;
  mvs_ensemble_options how = {};
  how.members = options.members;
  how.backend = backend;
  how.seed = options.seed;
  if (options.perturbation_mm == 0) how.flags = MVS_ENSEMBLE_FLAG_UNPERTURBED;
  how.perturbation = options.perturbation_mm * 1e-3;
  how.progress = Progress::callback;
  how.user = &progress;
  return {start, load, settle, how};
}

Json ensemble_json(const Ensemble &ensemble, const EnsembleOptions &options) {
  const mvs_ensemble_summary all = ensemble.summary();
  Json closures = Json::array();
  for (uint32_t k = 0; k < all.members; ++k) closures.push_back(member_json(ensemble, k));
  return {{"members", all.members},
          {"seed", options.seed},
          {"perturbation_mm", options.perturbation_mm},
          {"converged", all.converged},
          {"equilibria", all.equilibria},
          {"lowest", all.converged > 0 ? Json(all.lowest) : Json()},
          {"node_rms_mm", all.node_rms * 1e3},
          {"node_max_mm", all.node_max * 1e3},
          {"surface_rms_mm", all.surface_rms * 1e3},
          {"surface_max_mm", all.surface_max * 1e3},
          {"measures", statistics_json(statistics_of(ensemble))},
          {"closures", std::move(closures)}};
}

std::string ensemble_text(const Ensemble &ensemble) {
  std::string lines = summary_text(ensemble);
  lines += measures_text(ensemble.snapshot(0).measure(), statistics_of(ensemble));
  lines += text("  %6s %10s  %-14s %8s %10s %12s %12s %8s %8s\n", "member", "increments", "order",
                "moved mm", "iterations", "equilibrium", "energy mJ", "RMS mm", "max mm");
  for (uint32_t k = 0; k < ensemble.summary().members; ++k) lines += member_text(ensemble, k);
  return lines;
}

}  // namespace cli
