// The methods of mvs.Simulator: files, load, settle, step, snapshots.
#include <mvs/file.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "build.h"
#include "simulator.h"
#include "values.h"

namespace mvs_python {

// A number that is no bool.
struct Real {
  double value = 0;
};

}  // namespace mvs_python

namespace pybind11::detail {

template <>
struct type_caster<mvs_python::Real> {
  PYBIND11_TYPE_CASTER(mvs_python::Real, make_caster<double>::name);
  bool load(handle given, bool convert) {
    make_caster<double> number;
    if (PyBool_Check(given.ptr()) || !number.load(given, convert)) return false;
    value.value = cast_op<double>(number);
    return true;
  }
};

}  // namespace pybind11::detail

namespace mvs_python {
namespace {

using namespace py::literals;

using Number = std::optional<double>;
using Count = std::optional<uint32_t>;

std::unique_ptr<Simulator> make_simulator(const std::string &backend, uint32_t workers,
                                          const Snapshot *like, py::object log) {
  auto made = std::make_unique<Simulator>(backend, workers, std::move(log));
  if (like) made->call([&](mvs_sim *sim) { return mvs_restore(sim, like->get()); });
  return made;
}

py::object stats_of(Simulator &self) {
  return stats_value(filled<mvs_stats>(self, &mvs_get_stats),
                     filled<mvs_profile>(self, &mvs_get_profile));
}

// The implicit solver has no damping by default, so that 0 is only refused with the explicit one.
double damping_of(Number given, mvs_solver solver) {
  return solver == MVS_SOLVER_EXPLICIT ? given_or_default(given, "damping") : given.value_or(0);
}

mvs_settle_options settle_options(const std::string &solver, Count max_iterations, Number residual,
                                  Number dt, Number damping, bool margins) {
  auto options = sized<mvs_settle_options>();
  options.flags = margins ? 0 : MVS_SETTLE_NO_MARGINS;
  options.solver = solver_of(solver);
  options.max_iterations = given_or_default(max_iterations, "max_iterations");
  options.residual = given_or_default(residual, "residual");
  options.dt = given_or_default(dt, "dt");
  options.damping = damping_of(damping, options.solver);
  return options;
}

py::object settle(Simulator &self, const std::string &solver, Count max_iterations, Number residual,
                  Number dt, Number damping, bool margins, py::object progress) {
  const auto options = settle_options(solver, max_iterations, residual, dt, damping, margins);
  self.settle(std::move(progress),
              [&](mvs_sim *sim) { return mvs_settle(sim, &options, nullptr); });
  return stats_of(self);
}

void begin_settle(Simulator &self, const std::string &solver, Count max_iterations, Number residual,
                  Number dt, Number damping, bool margins) {
  const auto options = settle_options(solver, max_iterations, residual, dt, damping, margins);
  self.call([&](mvs_sim *sim) { return mvs_begin_settle(sim, &options); });
}

double advance_settle(Simulator &self, double seconds) {
  double share = 0;
  self.settle(py::none(),
              [&](mvs_sim *sim) { return mvs_advance_settle(sim, seconds, &share, nullptr); });
  return share;
}

mvs_step_options step_options(const std::string &solver, Number dt, Number damping, Count budget) {
  auto options = sized<mvs_step_options>();
  options.solver = solver_of(solver);
  options.dt = given_or_default(dt, "dt");
  options.damping = damping_of(damping, options.solver);
  options.budget = given_or_default(budget, "budget");
  return options;
}

void prepare_step(Simulator &self, const std::string &solver, Number dt, Number damping,
                  Count budget) {
  const auto options = step_options(solver, dt, damping, budget);
  self.call([&](mvs_sim *sim) { return mvs_prepare_step(sim, &options); });
}

py::object step(Simulator &self, uint64_t count, const std::string &solver, Number dt,
                Number damping, Count budget) {
  if (count == 0) refuse(MVS_E_ARGUMENT, "count", "count: 1 or more steps are needed, not 0");
  const auto options = step_options(solver, dt, damping, budget);
  self.repeat(count, [&](mvs_sim *sim) { return mvs_step(sim, &options); });
  return stats_of(self);
}

void set_load(Simulator &self, Real pressure, Real boundary_fraction) {
  const mvs_load_case load{sizeof load, 0, pressure.value, boundary_fraction.value};
  self.call([&](mvs_sim *sim) { return mvs_set_load(sim, &load); });
}

void bind_work(py::class_<Simulator> &type) {
  type.def("set_load", &set_load, "pressure_pa"_a, "boundary_fraction"_a = 1.0,
           "Sets the load for settle and step.\n\npressure_pa: ventricle minus atrium, "
           "Pa\nboundary_fraction: position of annulus and heads, 0 open to 1 loaded");
  type.def(
      "settle", &settle, py::kw_only(), "solver"_a = "newton", "max_iterations"_a = py::none(),
      "residual"_a = py::none(), "dt"_a = py::none(), "damping"_a = py::none(), "margins"_a = true,
      "progress"_a = py::none(),
      "Brings the valve to static equilibrium under the load and returns mvs.Stats. A closure "
      "that does not converge raises no exception: check Stats.converged.\n\nsolver: "
      "\"newton\", \"implicit\" or \"explicit\", which does not prevent crossing\nresidual: N, "
      "largest out-of-balance force at "
      "rest; None: 1e-5\ndt: s, and damping: 1/s, of the dynamic solvers\nmargins: False leaves "
      "the "
      "margins of stability of Stats at 0, which is quicker and the same shape; "
      "Snapshot.stability has them\nprogress: called with "
      "(share done, residual in N) in this thread; True cancels (CancelledError), an "
      "exception stops the work and is raised again");
  type.def(
      "begin_settle", &begin_settle, py::kw_only(), "solver"_a = "newton",
      "max_iterations"_a = py::none(), "residual"_a = py::none(), "dt"_a = py::none(),
      "damping"_a = py::none(), "margins"_a = true,
      "Begins a settle in slices, with the arguments of settle; see settle_slices. Until its end "
      "the valve is as before; another call that changes it cancels the settle.");
  type.def(
      "advance_settle", &advance_settle, "seconds"_a,
      "Advances the settle that begin_settle began, for `seconds` and at least one iteration. "
      "Returns the completed share in [0, 1]; 1: the valve is settled, and `stats` tells how.");
  type.def(
      "cancel_settle",
      [](Simulator &self) { self.call([](mvs_sim *sim) { return mvs_cancel_settle(sim); }); },
      "Cancels a settle in slices, if one is under way.");
  type.def("step", &step, "count"_a = 1, py::kw_only(), "solver"_a = "implicit",
           "dt"_a = py::none(), "damping"_a = py::none(), "budget"_a = py::none(),
           "Advances by `count` time steps and returns mvs.Stats of the last. Ctrl-C stops between "
           "two steps.\n\nsolver: "
           "\"implicit\" or \"explicit\"\ndt: s [implicit 1e-3; explicit: stable on this valve, at "
           "most 8e-6]\ndamping: "
           "1/s\nbudget: passes over the terms in an implicit step, 4 to 10000 [64]");
  type.def("prepare_step", &prepare_step, py::kw_only(), "solver"_a = "implicit",
           "dt"_a = py::none(), "damping"_a = py::none(), "budget"_a = py::none(),
           "Does now what the first step from here would do for the steps after it (memory, search "
           "for contact, elimination order, factor), so that it takes no longer than they. Changes "
           "nothing else. Arguments: those of step.");
  type.def_property_readonly(
      "stats", [](Simulator &self) { return stats_of(self); },
      "Statistics of the last settle or step (mvs.Stats).");
  type.def_property_readonly(
      "load_case",
      [](Simulator &self) { return load_value(filled<mvs_load_case>(self, &mvs_get_load)); },
      "The load in force (mvs.Load).");
}

void bind_files(py::class_<Simulator> &type) {
  type.def(
      "load",
      [](Simulator &self, const std::filesystem::path &path, const std::string &format) {
        const uint32_t chosen = format_of(format);
        const std::string name = path.string();
        self.call([&](mvs_sim *sim) { return mvs_load_file(sim, name.c_str(), chosen); });
      },
      "path"_a, py::kw_only(), "format"_a = "auto",
      "Replaces valve, state and history by those of a file: extended OBJ, HDF5 (.h5), or Abaqus "
      "input (.inp), whose load is set and whose ignored lines go to the log. FormatError has the "
      "line.");
  type.def(
      "load_bytes",
      [](Simulator &self, const py::bytes &data, const std::string &format) {
        const uint32_t chosen = format_of(format);
        const std::string bytes(data);
        self.call(
            [&](mvs_sim *sim) { return mvs_load_memory(sim, bytes.data(), bytes.size(), chosen); });
      },
      "data"_a, py::kw_only(), "format"_a = "obj", "Like load, from memory.");
}

}  // namespace

void bind_simulator(py::module_ &module) {
  const std::string about =
      "Simulates one valve.\n\nCalls release the interpreter; threads that share a simulator wait "
      "for each other. A call that raises leaves the simulator as it was, unless the exception is "
      "that of `log`, or a warning that a filter turns into an error: the call is done then. "
      "Ctrl-C "
      "stops settle and step within 0.2 s, other calls later or at their end: see the README.\n\n"
      "backend: the sparse "
      "factorisation, one of " +
      backend_words() +
      "\nworkers: threads that share the work of a settle or step on a valve of more than about "
      "1,000 vertices, of build_valve and find_leak_interval, at most 256; no bit of a result "
      "depends "
      "on them"
      "\nlike: a mvs.Snapshot that the simulator begins with (restore); its variants, which "
      "set_valve "
      "and load set, share what depends on its mesh, in any thread, with the same bits"
      "\nlog: called with (level, text); None: warnings (level 2) become mvs.ValveWarning";
  py::class_<Simulator> type(module, "Simulator", about.c_str(), collected_with_functions());
  type.def(py::init(&make_simulator), py::kw_only(), "backend"_a = "default", "workers"_a = 1,
           "like"_a = py::none(), "log"_a = py::none());
  bind_files(type);
  bind_valve(module, type);
  bind_build(type);
  bind_work(type);
  bind_operations(module, type);
  bind_plans(module, type);
  bind_tools(type);
  type.def("snapshot", &Simulator::snapshot,
           "The present valve and state (mvs.Snapshot). Allowed in any thread at any time; during "
           "a call it returns the state before that call.");
  type.def(
      "restore",
      [](Simulator &self, const Snapshot &snapshot) {
        self.call([&](mvs_sim *sim) { return mvs_restore(sim, snapshot.get()); });
      },
      "snapshot"_a, "Restores a snapshot of this or of another simulator.");
  type.def("close", &Simulator::close, "Frees the simulator; its snapshots stay valid.");
  type.def("__enter__", [](const py::object &self) { return self; });
  type.def("__exit__", [](Simulator &self, const py::args &) { self.close(); });
}

}  // namespace mvs_python
