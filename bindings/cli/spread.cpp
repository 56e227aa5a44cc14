#include "spread.h"

#include "readouts.h"

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

Statistics statistics_of(const mvs::Spread &spread) {
  return {spread.measure(MVS_ENSEMBLE_STATISTIC_MEAN), spread.measure(MVS_ENSEMBLE_STATISTIC_MIN),
          spread.measure(MVS_ENSEMBLE_STATISTIC_MAX),
          spread.measure(MVS_ENSEMBLE_STATISTIC_DEVIATION),
          spread.measure(MVS_ENSEMBLE_STATISTIC_COUNT)};
}

Json path_json(const mvs::Spread &spread, uint32_t number) {
  const mvs_ensemble_member path = spread.path(number);
  const mvs_stats stats = spread.stats(number);
  const mvs::Snapshot closed = spread.snapshot(number);
  const mvs_measures measures = closed.measure();
  return {{"path", number},
          {"increments", path.increments},
          {"ramp_s", path.ramp},
          {"order", order_name(path.order)},
          {"perturbation_mm", path.perturbation * 1e3},
          {"converged", path.converged != 0},
          {"diverged", path.diverged != 0},
          {"equilibrium", path.converged ? Json(path.equilibrium) : Json()},
          {"iterations", stats.iterations},
          {"wall_s", stats.wall_s},
          {"residual_N", stats.residual},
          {"energy_J", stats.energy},
          {"node_rms_mm", path.node_rms * 1e3},
          {"node_max_mm", path.node_max * 1e3},
          {"surface_rms_mm", path.surface_rms * 1e3},
          {"surface_max_mm", path.surface_max * 1e3},
          {"intersections", measures.intersections},
          {"hash", hash_of(closed)},
          {"measures", measures_json(measures)}};
}

std::string summary_text(const mvs::Spread &spread) {
  const mvs_ensemble_summary all = spread.summary();
  std::string told = text("%u of %u paths at rest, %u %s", all.converged, all.paths, all.equilibria,
                          all.equilibria == 1 ? "equilibrium" : "equilibria");
  if (all.converged > 0)
    told += text(", the lowest energy in equilibrium %u", spread.path(all.lowest).equilibrium);
  return told +
         text(
             "\nbetween paths: nodes %.3f mm RMS, %.2f mm at most; from path 0: surface %.3f mm "
             "RMS, %.2f mm at most\n",
             all.node_rms * 1e3, all.node_max * 1e3, all.surface_rms * 1e3, all.surface_max * 1e3);
}

std::string path_text(const mvs::Spread &spread, uint32_t number) {
  const mvs_ensemble_member path = spread.path(number);
  const mvs_stats stats = spread.stats(number);
  const std::string where = path.converged  ? std::to_string(path.equilibrium)
                            : path.diverged ? "diverged"
                                            : "NOT at rest";
  const std::string increments =
      path.ramp > 0 ? text("in %.0f ms", path.ramp * 1e3) : std::to_string(path.increments);
  return text("  %4u %10s  %-14s %8.2f %10u %12s %12.4f %8.3f %8.2f\n", number, increments.c_str(),
              order_name(path.order), path.perturbation * 1e3, stats.iterations, where.c_str(),
              stats.energy * 1e3, path.node_rms * 1e3, path.node_max * 1e3);
}

}  // namespace

void add_spread_options(CLI::App &command, SpreadOptions &options) {
  auto *paths = command.add_option(
      "--paths", options.paths,
      "close along so many paths, the plain one first, and tell how far they lie apart");
  paths->check(CLI::Range(1, 1000));
  command.add_option("--seed", options.seed, "of the disturbances of the start")
      ->capture_default_str()
      ->needs(paths);
  command
      .add_option("--perturbation", options.perturbation_mm,
                  "longest way a node of the start is moved, mm; 0: none")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 5.0))
      ->needs(paths);
}

mvs::Spread spread_of(const mvs::Snapshot &start, double pressure_mmhg,
                      const mvs_settle_options &settle, const SpreadOptions &options,
                      uint32_t backend, Progress &progress) {
  mvs_load_case load = {};
  load.pressure = pressure_mmhg * pa_per_mmhg;
  load.boundary_fraction = 1;
  mvs_ensemble_options how = {};
  how.paths = options.paths;
  how.backend = backend;
  how.seed = options.seed;
  how.perturbation = options.perturbation_mm > 0 ? options.perturbation_mm * 1e-3 : -1;
  how.progress = Progress::callback;
  how.user = &progress;
  return {start, load, settle, how};
}

Json spread_json(const mvs::Spread &spread, const SpreadOptions &options) {
  const mvs_ensemble_summary all = spread.summary();
  Json paths = Json::array();
  for (uint32_t k = 0; k < all.paths; ++k) paths.push_back(path_json(spread, k));
  return {{"paths", all.paths},
          {"seed", options.seed},
          {"perturbation_mm", options.perturbation_mm},
          {"converged", all.converged},
          {"equilibria", all.equilibria},
          {"lowest", all.converged > 0 ? Json(all.lowest) : Json()},
          {"node_rms_mm", all.node_rms * 1e3},
          {"node_max_mm", all.node_max * 1e3},
          {"surface_rms_mm", all.surface_rms * 1e3},
          {"surface_max_mm", all.surface_max * 1e3},
          {"measures", statistics_json(statistics_of(spread))},
          {"closures", std::move(paths)}};
}

std::string spread_text(const mvs::Spread &spread) {
  std::string told = summary_text(spread);
  told += measures_text(spread.snapshot(0).measure(), statistics_of(spread));
  told += text("  %4s %10s  %-14s %8s %10s %12s %12s %8s %8s\n", "path", "increments", "order",
               "moved mm", "iterations", "equilibrium", "energy mJ", "RMS mm", "max mm");
  for (uint32_t k = 0; k < spread.summary().paths; ++k) told += path_text(spread, k);
  return told;
}

}  // namespace cli
