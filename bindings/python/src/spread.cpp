#include "spread.h"

#include <pybind11/stl.h>

#include <exception>
#include <optional>

#include "arrays.h"
#include "values.h"

namespace mvs_python {
namespace {

using Number = std::optional<double>;
using Count = std::optional<uint32_t>;

// What the library calls during the work: it looks at Ctrl-C, and at the caller's progress.
struct Watch {
  py::object progress;
  std::exception_ptr raised;

  static int32_t callback(void *user, double share, double residual) {
    auto &self = *static_cast<Watch *>(user);
    py::gil_scoped_acquire held;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (self.progress.is_none()) return 0;
      return py::bool_(self.progress(share, residual)) ? 1 : 0;
    } catch (...) {
      self.raised = std::current_exception();
      return 1;
    }
  }
};

mvs_ensemble_summary summary_of(const Spread &self) {
  mvs_ensemble_summary found{};
  found.struct_size = sizeof found;
  must(mvs_ensemble_get_summary(self.get(), &found));
  return found;
}

std::unique_ptr<Spread> spread(const Snapshot &start, double pressure, double boundary_fraction,
                               uint32_t paths, uint64_t seed, Number perturbation,
                               Number wavelength, Number same, bool from_start,
                               const std::string &solver, Count max_iterations, Number residual,
                               py::object progress) {
  if (paths == 0) refuse(MVS_E_ARGUMENT, "paths", "paths: 1 to 1000 are needed, not 0");
  const mvs_load_case load{sizeof load, 0, pressure, boundary_fraction};
  mvs_settle_options settle{};
  settle.struct_size = sizeof settle;
  settle.solver = solver_of(solver);
  settle.max_iterations = max_iterations.value_or(0);
  settle.residual = residual.value_or(0);
  Watch watch{std::move(progress), nullptr};
  mvs_ensemble_options options{};
  options.struct_size = sizeof options;
  options.paths = paths;
  options.from = from_start ? MVS_ENSEMBLE_START_SNAPSHOT : MVS_ENSEMBLE_START_REST;
  options.seed = seed;
  options.perturbation = perturbation == 0.0 ? -1 : perturbation.value_or(0);
  options.wavelength = wavelength.value_or(0);
  options.same = same.value_or(0);
  options.progress = &Watch::callback;
  options.user = &watch;
  mvs_ensemble *made = nullptr;
  Outcome outcome;
  {
    py::gil_scoped_release released;
    outcome = outcome_of(mvs_ensemble_run(start.get(), &load, &settle, &options, &made));
  }
  if (watch.raised) std::rethrow_exception(watch.raised);
  must(outcome);
  return std::make_unique<Spread>(made);
}

py::tuple paths(const Spread &self) {
  py::list all;
  for (uint32_t k = 0; k < summary_of(self).paths; ++k) {
    mvs_ensemble_member path{};
    mvs_stats stats{};
    path.struct_size = sizeof path;
    stats.struct_size = sizeof stats;
    must(mvs_ensemble_get_member(self.get(), k, &path));
    must(mvs_ensemble_get_member_stats(self.get(), k, &stats));
    all.append(spread_path_value(path, stats));
  }
  return py::tuple(all);
}

std::unique_ptr<Snapshot> snapshot(const Spread &self, uint32_t path) {
  const mvs_snapshot *taken = nullptr;
  must(mvs_ensemble_get_member_snapshot(self.get(), path, &taken));
  return std::make_unique<Snapshot>(taken);
}

py::object measure(const Spread &self, uint32_t statistic) {
  mvs_measures found{};
  found.struct_size = sizeof found;
  release_and([&] { return mvs_ensemble_measure(self.get(), statistic, &found); });
  return measures_value(found);
}

py::array view(const py::object &self, uint32_t which) {
  mvs_view found{};
  must(mvs_ensemble_get_array(self.cast<const Spread &>().get(), which, &found));
  return array_of(found, self);
}

void bind_statistics(py::class_<Spread> &type) {
  struct Statistic {
    const char *name;
    uint32_t which;
    const char *doc;
  };
  static constexpr Statistic statistics[] = {
      {"mean", MVS_ENSEMBLE_STATISTIC_MEAN,
       "Mean of every figure over the paths at rest (mvs.Measures, SI units); NaN where none has "
       "it; counts are rounded."},
      {"min", MVS_ENSEMBLE_STATISTIC_MIN,
       "The least of every figure over the paths at rest (mvs.Measures)."},
      {"max", MVS_ENSEMBLE_STATISTIC_MAX,
       "The most of every figure over the paths at rest (mvs.Measures)."},
      {"deviation", MVS_ENSEMBLE_STATISTIC_DEVIATION,
       "Standard deviation of every figure over the paths at rest as a sample (mvs.Measures); NaN "
       "for fewer than two."},
      {"count", MVS_ENSEMBLE_STATISTIC_COUNT,
       "How many paths at rest have each figure (mvs.Measures, of numbers without units)."}};
  for (const Statistic &statistic : statistics) {
    type.def_property_readonly(
        statistic.name,
        [which = statistic.which](const Spread &self) { return measure(self, which); },
        statistic.doc);
  }
}

}  // namespace

void bind_spread(py::module_ &module, py::class_<Snapshot> &type) {
  py::class_<Spread> made(
      module, "Spread",
      "What a valve closes to along several paths (Snapshot.spread); path 0 is the plain closure. "
      "Arrays are read-only and valid without it.");
  made.def("__len__", [](const Spread &self) { return summary_of(self).paths; });
  made.def_property_readonly(
      "summary", [](const Spread &self) { return spread_summary_value(summary_of(self)); },
      "What all paths show together (mvs.SpreadSummary).");
  made.def_property_readonly("paths", &paths, "Every path (tuple of mvs.SpreadPath).");
  made.def("snapshot", &snapshot, py::arg("path"),
           "The closed valve of a path (mvs.Snapshot); ArgumentError if there is no such path.");
  bind_statistics(made);
  made.def_property_readonly(
      "node_spread",
      [](const py::object &self) { return view(self, MVS_ENSEMBLE_ARRAY_NODE_DEVIATION); },
      "(n,) float64, m: RMS distance of each node from its mean place over the paths at rest.");
  made.def_property_readonly(
      "pairs",
      [](const py::object &self) {
        const py::array rows = view(self, MVS_ENSEMBLE_ARRAY_PAIR_DISTANCE);
        return rows.attr("reshape")(rows.shape(0), rows.shape(0));
      },
      "(p, p) float64, m: node RMS between the shapes of every two paths, at rest or not.");
  type.def("spread", &spread, py::arg("pressure_pa"), py::arg("boundary_fraction") = 1.0,
           py::kw_only(), py::arg("paths") = 8, py::arg("seed") = 0,
           py::arg("perturbation") = py::none(), py::arg("wavelength") = py::none(),
           py::arg("same") = py::none(), py::arg("from_start") = false,
           py::arg("solver") = "newton", py::arg("max_iterations") = py::none(),
           py::arg("residual") = py::none(), py::arg("progress") = py::none(),
           "Closes the valve along several paths and returns mvs.Spread: how far shapes and "
           "figures lie apart, because slack tissue can fold in several ways. Path 0 is the plain "
           "closure, to the bit; the same arguments give the same bits.\n\npressure_pa, "
           "boundary_fraction: the load, as for Simulator.set_load\npaths: closures, the plain one "
           "included\nseed: of the disturbances\nperturbation: m, the longest way a node of the "
           "start is moved [0.5e-3]; 0: none\nwavelength: m, the shortest wave of a disturbance "
           "[5e-3]\nsame: m, two shapes no node of which is farther apart are one equilibrium "
           "[0.1e-3]\nfrom_start: the paths after the first begin at the snapshot as it lies, not "
           "at the rest shape\nsolver, max_iterations, residual, progress: as for "
           "Simulator.settle");
}

}  // namespace mvs_python
