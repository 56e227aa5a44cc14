#include "ensemble.h"

#include <pybind11/stl.h>

#include <optional>

#include "arrays.h"
#include "progress.h"
#include "simulator.h"
#include "values.h"

namespace mvs_python {
namespace {

using namespace py::literals;

using Number = std::optional<double>;
using Count = std::optional<uint32_t>;

mvs_ensemble_summary summary_of(const Ensemble &self) {
  auto found = sized<mvs_ensemble_summary>();
  must(mvs_ensemble_get_summary(self.get(), &found));
  return found;
}

// Gives the warnings of Simulator.set_load.
void check_load(const Snapshot &start, const mvs_load_case &load) {
  Simulator sim("default", 1, py::none());
  sim.call([&](mvs_sim *held) {
    const mvs_result restored = mvs_restore(held, start.get());
    return restored == MVS_OK ? mvs_set_load(held, &load) : restored;
  });
}

std::unique_ptr<Ensemble> run_ensemble(const Snapshot &start, double pressure,
                                       double boundary_fraction, uint32_t members, uint64_t seed,
                                       Number perturbation, Number wavelength, Number same,
                                       bool from_start, const std::string &solver,
                                       Count max_iterations, Number residual, py::object progress) {
  if (members == 0) refuse(MVS_E_ARGUMENT, "members", "members: 1 to 1000 are needed, not 0");
  const mvs_load_case load{sizeof load, 0, pressure, boundary_fraction};
  check_load(start, load);
  auto settle = sized<mvs_settle_options>();
  settle.solver = solver_of(solver);
  settle.max_iterations = given_or_default(max_iterations, "max_iterations");
  settle.residual = given_or_default(residual, "residual");
  ProgressCall call(std::move(progress));
  auto options = sized<mvs_ensemble_options>();
  options.members = members;
  options.start = from_start ? MVS_ENSEMBLE_START_SNAPSHOT : MVS_ENSEMBLE_START_REST;
  options.seed = seed;
  // 0 is a perturbation of its own, not the default
  if (perturbation == 0.0) options.flags |= MVS_ENSEMBLE_FLAG_UNPERTURBED;
  options.perturbation = perturbation.value_or(0);
  options.wavelength = given_or_default(wavelength, "wavelength");
  options.tolerance = given_or_default(same, "same");
  options.progress = &ProgressCall::callback;
  options.user = &call;
  mvs_ensemble *made = nullptr;
  call.run([&] { return mvs_ensemble_run(start.get(), &load, &settle, &options, &made); });
  return std::make_unique<Ensemble>(made);
}

py::tuple all_members(const Ensemble &self) {
  py::list all;
  for (uint32_t k = 0; k < summary_of(self).members; ++k) {
    auto member = sized<mvs_ensemble_member>();
    auto stats = sized<mvs_stats>();
    auto profile = sized<mvs_profile>();
    must(mvs_ensemble_get_member(self.get(), k, &member));
    must(mvs_ensemble_get_member_stats(self.get(), k, &stats));
    must(mvs_ensemble_get_member_profile(self.get(), k, &profile));
    all.append(ensemble_member_value(member, stats, profile));
  }
  return py::tuple(all);
}

std::unique_ptr<Snapshot> member_snapshot(const Ensemble &self, uint32_t member) {
  const mvs_snapshot *taken = nullptr;
  must(mvs_ensemble_get_member_snapshot(self.get(), member, &taken));
  return std::make_unique<Snapshot>(taken);
}

py::object statistic_of(const Ensemble &self, uint32_t statistic) {
  auto found = sized<mvs_measures>();
  release_and([&] { return mvs_ensemble_measure(self.get(), statistic, &found); });
  return statistics_value(found);
}

py::array ensemble_array(const py::object &self, uint32_t which) {
  mvs_view found{};
  must(mvs_ensemble_get_array(self.cast<const Ensemble &>().get(), which, &found));
  return array_of(found, self);
}

void bind_statistics(py::class_<Ensemble> &type) {
  struct Statistic {
    const char *name;
    uint32_t which;
    const char *doc;
  };
  static constexpr Statistic statistics[] = {
      {"mean", MVS_ENSEMBLE_STATISTIC_MEAN,
       "Mean of every measure over the members at rest (mvs.Measures, SI units); NaN where no "
       "member has it; counts are rounded."},
      {"min", MVS_ENSEMBLE_STATISTIC_MIN,
       "Minimum of every measure over the members at rest (mvs.Measures)."},
      {"max", MVS_ENSEMBLE_STATISTIC_MAX,
       "Maximum of every measure over the members at rest (mvs.Measures)."},
      {"deviation", MVS_ENSEMBLE_STATISTIC_DEVIATION,
       "Sample standard deviation of every measure over the members at rest (mvs.Measures); NaN "
       "for fewer than two."},
      {"count", MVS_ENSEMBLE_STATISTIC_COUNT,
       "Number of members at rest that have each measure (mvs.Measures, of numbers without "
       "units)."}};
  for (const Statistic &statistic : statistics) {
    type.def_property_readonly(
        statistic.name,
        [which = statistic.which](const Ensemble &self) { return statistic_of(self, which); },
        statistic.doc);
  }
}

}  // namespace

void bind_ensemble(py::module_ &module, py::class_<Snapshot> &type) {
  py::class_<Ensemble> made(
      module, "Ensemble",
      "The closures of one valve along several paths (Snapshot.ensemble); member 0 is the plain "
      "closure. Arrays are read-only and stay valid after the ensemble is freed.");
  made.def("__len__", [](const Ensemble &self) { return summary_of(self).members; });
  made.def_property_readonly(
      "summary", [](const Ensemble &self) { return ensemble_summary_value(summary_of(self)); },
      "Distances over all members (mvs.EnsembleSummary).");
  made.def("__repr__", [](const Ensemble &self) {
    const mvs_ensemble_summary found = summary_of(self);
    return "<mvs.Ensemble: " + std::to_string(found.members) + " members, " +
           std::to_string(found.converged) +
           " at rest, equilibria: " + std::to_string(found.equilibria) + ">";
  });
  made.def_property_readonly("members", &all_members,
                             "Every member (tuple of mvs.EnsembleMember).");
  made.def(
      "snapshot", &member_snapshot, "member"_a,
      "The closed valve of a member (mvs.Snapshot); ArgumentError if there is no such member.");
  bind_statistics(made);
  made.def_property_readonly(
      "node_deviation",
      [](const py::object &self) {
        return ensemble_array(self, MVS_ENSEMBLE_ARRAY_NODE_DEVIATION);
      },
      "(n,) float64, m: RMS distance of each node from its mean position over the members at "
      "rest.");
  made.def_property_readonly(
      "pair_distance",
      [](const py::object &self) {
        const py::array rows = ensemble_array(self, MVS_ENSEMBLE_ARRAY_PAIR_DISTANCE);
        return rows.attr("reshape")(rows.shape(0), rows.shape(0));
      },
      "(p, p) float64, m: node RMS between the shapes of every two members, at rest or not.");
  type.def(
      "ensemble", &run_ensemble, "pressure_pa"_a, "boundary_fraction"_a = 1.0, py::kw_only(),
      "members"_a = 8, "seed"_a = 0, "perturbation"_a = py::none(), "wavelength"_a = py::none(),
      "same"_a = py::none(), "from_start"_a = false, "solver"_a = "newton",
      "max_iterations"_a = py::none(), "residual"_a = py::none(), "progress"_a = py::none(),
      "Closes the valve along several paths and returns mvs.Ensemble: slack tissue can fold in "
      "several ways, and the members show the range of shapes and measures. Member 0 is the plain "
      "closure, with the same bits; the same arguments give the same bits. A shape and its mirror "
      "image, both equilibria of a symmetric valve as generate() makes it, are two equilibria."
      "\n\npressure_pa, "
      "boundary_fraction: the load, as for Simulator.set_load\nmembers: number of closures, the "
      "plain one included\nseed: of the perturbations\nperturbation: m, largest displacement of a "
      "node of the start [0.5e-3]; 0: no perturbation\nwavelength: m, shortest wavelength of a "
      "perturbation [5e-3]\nsame: m, two shapes are one equilibrium if no node is farther apart "
      "[0.1e-3]\nfrom_start: members after the first start from the shape of the snapshot instead "
      "of the rest shape\nsolver, max_iterations, residual, progress: as for Simulator.settle");
}

}  // namespace mvs_python
