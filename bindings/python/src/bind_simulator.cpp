// The Python face of mvs.Simulator, and mvs.check_valve.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "simulator.h"
#include "values.h"
#include "valve.h"

namespace mvs_python {
namespace {

using Number = std::optional<double>;
using Count = std::optional<uint32_t>;

// A valve as mvs.Valve: the one given, or one made of the arguments.
py::object valve_of(const py::args &args, const py::kwargs &kwargs) {
  const py::object type = py::module_::import("mvs.values").attr("Valve");
  if (args.size() == 1 && kwargs.empty() && py::isinstance(args[0], type)) return args[0];
  return type(*args, **kwargs);
}

void set_valve(Simulator &self, const py::args &args, const py::kwargs &kwargs) {
  self.set_valve(ValveArguments(valve_of(args, kwargs)).desc());
}

// The faults of a valve as a list of mvs.Fault; an empty list is a valve.
py::list check_valve(const py::args &args, const py::kwargs &kwargs) {
  const ValveArguments valve(valve_of(args, kwargs));
  std::vector<std::pair<std::string, std::string>> faults;
  const auto note = [](void *user, const char *part, const char *sentence) {
    static_cast<decltype(faults) *>(user)->emplace_back(part, sentence);
  };
  const mvs_result result = mvs_check_valve(&valve.desc(), note, &faults);
  if (result != MVS_OK && faults.empty()) must(result);
  py::list list;
  const py::object type = py::module_::import("mvs.values").attr("Fault");
  for (const auto &[part, sentence] : faults) list.append(type(part, sentence));
  return list;
}

// MVS_LEAFLET_LAW_* from a mvs.LeafletLaw, its number or its name in small letters.
uint32_t law_of(const py::object &law) {
  if (!py::isinstance<py::str>(law)) return law.cast<uint32_t>();
  const std::string wanted = law.cast<std::string>();
  std::string names;
  for (const py::handle member : py::module_::import("mvs.values").attr("LeafletLaw")) {
    const std::string name = py::str(member.attr("name").attr("lower")());
    if (name == wanted) return member.cast<uint32_t>();
    names += (names.empty() ? "\"" : ", \"") + name + "\"";
  }
  refuse(MVS_E_ARGUMENT, "law", "law: one of " + names + " is needed, not \"" + wanted + "\"");
}

void set_leaflet(Simulator &self, const std::optional<std::string> &leaflet, const py::object &law,
                 const std::vector<double> &constants, double thickness) {
  mvs_leaflet_desc tissue{};
  tissue.law = law_of(law);
  tissue.thickness = thickness;
  if (constants.size() > std::size(tissue.constants)) {
    refuse(MVS_E_ARGUMENT, "constants",
           "constants: a law has at most 8, not " + std::to_string(constants.size()));
  }
  std::copy(constants.begin(), constants.end(), tissue.constants);
  self.set_leaflet(leaflet, tissue);
}

py::object settle(Simulator &self, const std::string &solver, Count max_iterations, Number residual,
                  Number dt, Number damping, py::object progress) {
  mvs_settle_options options{};
  options.struct_size = sizeof options;
  options.solver = solver_of(solver);
  options.max_iterations = max_iterations.value_or(0);
  options.residual = residual.value_or(0);
  options.dt = dt.value_or(0);
  options.damping = damping.value_or(0);
  const mvs_stats stats = self.settle(options, std::move(progress));
  return stats_value(stats, self.profile());
}

py::object step(Simulator &self, uint64_t count, const std::string &solver, Number dt,
                Number damping, Count budget) {
  mvs_step_options options{};
  options.struct_size = sizeof options;
  options.solver = solver_of(solver);
  options.dt = dt.value_or(0);
  options.damping = damping.value_or(0);
  options.budget = budget.value_or(0);
  const mvs_stats stats = self.step(options, count);
  return stats_value(stats, self.profile());
}

void bind_generate(py::class_<Simulator> &type) {
  type.def(
      "generate",
      [](Simulator &self, Count vertices, Count chords, bool branching, Number annulus_ap,
         Number annulus_cc, Number saddle_height, Number anterior_height, Number posterior_height,
         Number commissure_height, Number thickness, Number papillary_depth,
         Number papillary_separation, Number annulus_contraction, Number annulus_scale,
         Number chord_slack, Number indentation_depth, Number coaptation_depth) {
        self.generate({.struct_size = sizeof(mvs_parametric_desc),
                       .vertices = vertices.value_or(0),
                       .chords = chords.value_or(0),
                       .branching = branching ? 1u : 0u,
                       .annulus_ap = annulus_ap.value_or(0),
                       .annulus_cc = annulus_cc.value_or(0),
                       .saddle_height = saddle_height.value_or(0),
                       .anterior_height = anterior_height.value_or(0),
                       .posterior_height = posterior_height.value_or(0),
                       .commissure_height = commissure_height.value_or(0),
                       .thickness = thickness.value_or(0),
                       .papillary_depth = papillary_depth.value_or(0),
                       .papillary_separation = papillary_separation.value_or(0),
                       .annulus_contraction = annulus_contraction.value_or(0),
                       .annulus_scale = annulus_scale.value_or(0),
                       .chord_slack = chord_slack.value_or(0),
                       .indentation_depth = indentation_depth.value_or(0),
                       .coaptation_depth = coaptation_depth.value_or(0)});
      },
      py::kw_only(), py::arg("vertices") = py::none(), py::arg("chords") = py::none(),
      py::arg("branching") = false, py::arg("annulus_ap") = py::none(),
      py::arg("annulus_cc") = py::none(), py::arg("saddle_height") = py::none(),
      py::arg("anterior_height") = py::none(), py::arg("posterior_height") = py::none(),
      py::arg("commissure_height") = py::none(), py::arg("thickness") = py::none(),
      py::arg("papillary_depth") = py::none(), py::arg("papillary_separation") = py::none(),
      py::arg("annulus_contraction") = py::none(), py::arg("annulus_scale") = py::none(),
      py::arg("chord_slack") = py::none(), py::arg("indentation_depth") = py::none(),
      py::arg("coaptation_depth") = py::none(),
      "Replaces the valve by a parametric mitral valve; None or 0 takes the default of an "
      "adult.\n\n"
      "vertices: 200 to 100000, about this many on the leaflets\nchords: chord segments, about\n"
      "branching: chordae branch at free nodes\nlengths in m; annulus_contraction: loaded / open "
      "size\nannulus_scale: factor on the loaded annulus, rest shape kept (dilation)\n"
      "chord_slack: factor on all rest lengths\nindentation_depth: of the clefts beside "
      "P2\ncoaptation_depth: of the closed coaptation line below the annulus plane");
}

void bind_work(py::class_<Simulator> &type) {
  type.def("set_load", &Simulator::set_load, py::arg("pressure_pa"),
           py::arg("boundary_fraction") = 1.0,
           "Sets the load that settle and step work towards.\n\npressure_pa: ventricle minus "
           "atrium, Pa\nboundary_fraction: where annulus and heads are, 0 open to 1 loaded");
  type.def("settle", &settle, py::kw_only(), py::arg("solver") = "newton",
           py::arg("max_iterations") = py::none(), py::arg("residual") = py::none(),
           py::arg("dt") = py::none(), py::arg("damping") = py::none(),
           py::arg("progress") = py::none(),
           "Brings the valve to static equilibrium under the load and returns mvs.Stats. Not "
           "converged is no error: look at Stats.converged.\n\nsolver: \"newton\", \"implicit\" "
           "or \"explicit\"\nresidual: N, largest out-of-balance force at rest [1e-5]\ndt: s, and "
           "damping: 1/s, of the solvers in time\nprogress: called with (share done, residual in "
           "N) in this thread; True cancels (CancelledError), an exception stops and is raised");
  type.def("step", &step, py::arg("count") = 1, py::kw_only(), py::arg("solver") = "implicit",
           py::arg("dt") = py::none(), py::arg("damping") = py::none(),
           py::arg("budget") = py::none(),
           "Advances by `count` time steps and returns mvs.Stats of the last.\n\nsolver: "
           "\"implicit\" or \"explicit\"\ndt: s [implicit 1e-3, explicit 8e-6]\ndamping: 1/s\n"
           "budget: passes over the terms in an implicit step, 4 to 10000 [64]");
  type.def_property_readonly(
      "stats", [](Simulator &self) { return stats_value(self.stats(), self.profile()); },
      "How the last settle or step went (mvs.Stats).");
  type.def_property_readonly(
      "load_case", [](Simulator &self) { return load_value(self.load_case()); },
      "The load in force (mvs.Load).");
}

void refine(Simulator &self, uint32_t times) {
  for (uint32_t k = 0; k < times; ++k) self.refine();
}

py::object coarsen(Simulator &self, Count vertices, Number edge) {
  mvs_coarsen_options options{};
  options.struct_size = sizeof options;
  options.vertices = vertices.value_or(0);
  options.edge = edge.value_or(0);
  return coarsening_value(self.coarsen(options));
}

void bind_levels(py::class_<Simulator> &type) {
  type.def(
      "refine", &refine, py::arg("times") = 1,
      "Cuts every triangle in four, this many times: the same surface and parts, old nodes with "
      "their index, the state carried over. The history starts anew.");
  type.def("coarsen", &coarsen, py::kw_only(), py::arg("vertices") = py::none(),
           py::arg("edge") = py::none(),
           "Takes vertices out of the leaflets and returns mvs.Coarsening. Those that stay keep "
           "place and state; Snapshot.node_origin tells which they are. The history starts anew. "
           "ArgumentError tells the least number.\n\nvertices: of the leaflets, exactly\nedge: m, "
           "about the mean length of edges; one of the two is given");
  type.def("transfer_state", &Simulator::transfer_state, py::arg("snapshot"),
           "Takes over the state of a snapshot of a coarser or finer level of this valve. The "
           "history starts anew. ArgumentError if they are not levels of one valve.");
}

void bind_tissue(py::class_<Simulator> &type) {
  type.def(
      "set_leaflet", &set_leaflet, py::arg("leaflet") = py::none(), py::kw_only(), py::arg("law"),
      py::arg("constants") = std::vector<double>{}, py::arg("thickness") = 0.0,
      "Gives a leaflet another tissue; shape, chordae, state and load stay, the history starts "
      "anew.\n\nleaflet: its name; None: all of them\nlaw: a mvs.LeafletLaw, or its name in small "
      "letters (\"bilinear\")\nconstants: of the law, at most 8, moduli in Pa; without any, its "
      "defaults, and \"bilinear\" on springs becomes the membrane of their curve\nthickness: m; 0 "
      "leaves it, another one scales that of each triangle\nIdError: no leaflet has that name. "
      "OpError: constants that no tissue has.");
}

void bind_files(py::class_<Simulator> &type) {
  type.def(
      "load",
      [](Simulator &self, const std::filesystem::path &path, const std::string &format) {
        self.load(path.string(), format_of(format));
      },
      py::arg("path"), py::kw_only(), py::arg("format") = "auto",
      "Replaces valve, state and history by those of a file: extended OBJ, HDF5 (.h5), or Abaqus "
      "input (.inp), whose load is then set and whose leftovers go to the log. FormatError tells "
      "the "
      "line.");
  type.def(
      "load_bytes",
      [](Simulator &self, const py::bytes &data, const std::string &format) {
        self.load_bytes(std::string(data), format_of(format));
      },
      py::arg("data"), py::kw_only(), py::arg("format") = "obj", "The same from memory.");
}

}  // namespace

void bind_simulator(py::module_ &module) {
  py::class_<Simulator> type(
      module, "Simulator",
      "Simulates one valve.\n\nCalls release the interpreter; threads that share a simulator wait "
      "for each other. A call that raises leaves the simulator as it was.\n\nbackend: \"default\", "
      "\"cholmod\" or \"eigen\", the sparse factorisation\nlog: called with (level, text); "
      "without, what is worth a warning (level 2) is an mvs.ValveWarning");
  type.def(py::init<const std::string &, py::object>(), py::kw_only(),
           py::arg("backend") = "default", py::arg("log") = py::none());
  bind_files(type);
  bind_generate(type);
  bind_levels(type);
  bind_tissue(type);
  bind_work(type);
  bind_operations(module, type);
  bind_plans(module, type);
  bind_tools(type);
  type.def("set_valve", &set_valve,
           "Replaces the valve by a mvs.Valve, or by the arrays one is made of. OpError names the "
           "first fault of a valve that is none; mvs.check_valve lists all.");
  type.def(
      "snapshot", &Simulator::snapshot,
      "The present valve and state (mvs.Snapshot); any thread may ask at any time, and sees the "
      "state before a call that is at work.");
  type.def("restore", &Simulator::restore, py::arg("snapshot"),
           "Puts the simulator back to a snapshot, of this simulator or of another one.");
  type.def("close", &Simulator::close, "Frees the simulator; its snapshots stay valid.");
  type.def("__enter__", [](const py::object &self) { return self; });
  type.def("__exit__", [](Simulator &self, const py::args &) { self.close(); });
  module.def("check_valve", &check_valve,
             "The faults of arrays that are to be a valve (list of mvs.Fault), empty if it is one; "
             "arguments as for Simulator.set_valve.");
}

}  // namespace mvs_python
