// The methods of mvs.Simulator: valve, load, settle, step, levels, tissue, files; and
// mvs.check_valve.
#include <mvs/file.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>

#include "build.h"
#include "simulator.h"
#include "values.h"
#include "valve.h"

namespace mvs_python {
namespace {

using namespace py::literals;

using Number = std::optional<double>;
using Count = std::optional<uint32_t>;

// The mvs.Valve of the arguments: the one given, or one made of them.
py::object valve_of(const py::args &args, const py::kwargs &kwargs) {
  const py::object type = py::module_::import("mvs.arrays").attr("Valve");
  if (args.size() == 1 && kwargs.empty() && py::isinstance(args[0], type)) return args[0];
  return type(*args, **kwargs);
}

std::unique_ptr<Simulator> make_simulator(const std::string &backend, uint32_t workers,
                                          const Snapshot *like, py::object log) {
  auto made = std::make_unique<Simulator>(backend, workers, std::move(log));
  if (like) made->call([&](mvs_sim *sim) { return mvs_restore(sim, like->get()); });
  return made;
}

void set_valve(Simulator &self, const py::args &args, const py::kwargs &kwargs) {
  const ValveArguments valve(valve_of(args, kwargs));
  self.call([&](mvs_sim *sim) { return mvs_set_valve(sim, &valve.desc()); });
}

// The faults of a valve as a list of mvs.Fault; empty for a valid valve.
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
  for (const auto &[part, sentence] : faults) {
    list.append(type(part, sentence, result == MVS_OK));
  }
  return list;
}

void set_leaflet(Simulator &self, const std::optional<std::string> &leaflet, const py::object &law,
                 const py::object &constants, double thickness) {
  mvs_leaflet_desc tissue{};
  tissue.thickness = thickness;
  const py::module_ laws = py::module_::import("mvs.laws");
  const py::object chosen = laws.attr("leaflet_law_of")(law);
  tissue.law = chosen.cast<uint32_t>();
  const auto values = laws.attr("constants_of")(chosen, constants).cast<std::vector<double>>();
  std::copy(values.begin(), values.end(), tissue.constants);
  mvs_part part{};
  if (leaflet)
    must(mvs_snapshot_find_part(self.snapshot()->get(), MVS_PART_LEAFLET, leaflet->c_str(), &part));
  self.call([&](mvs_sim *sim) { return mvs_set_leaflet(sim, part.id, &tissue); });
}

py::object stats_of(Simulator &self) {
  return stats_value(filled<mvs_stats>(self, &mvs_get_stats),
                     filled<mvs_profile>(self, &mvs_get_profile));
}

mvs_settle_options settle_options(const std::string &solver, Count max_iterations, Number residual,
                                  Number dt, Number damping) {
  auto options = sized<mvs_settle_options>();
  options.solver = solver_of(solver);
  options.max_iterations = max_iterations.value_or(0);
  options.residual = residual.value_or(0);
  options.dt = dt.value_or(0);
  options.damping = damping.value_or(0);
  return options;
}

py::object settle(Simulator &self, const std::string &solver, Count max_iterations, Number residual,
                  Number dt, Number damping, py::object progress) {
  const auto options = settle_options(solver, max_iterations, residual, dt, damping);
  self.settle(std::move(progress),
              [&](mvs_sim *sim) { return mvs_settle(sim, &options, nullptr); });
  return stats_of(self);
}

void begin_settle(Simulator &self, const std::string &solver, Count max_iterations, Number residual,
                  Number dt, Number damping) {
  const auto options = settle_options(solver, max_iterations, residual, dt, damping);
  self.call([&](mvs_sim *sim) { return mvs_begin_settle(sim, &options); });
}

double advance_settle(Simulator &self, double seconds) {
  double share = 0;
  self.settle(py::none(),
              [&](mvs_sim *sim) { return mvs_advance_settle(sim, seconds, &share, nullptr); });
  return share;
}

py::object step(Simulator &self, uint64_t count, const std::string &solver, Number dt,
                Number damping, Count budget) {
  auto options = sized<mvs_step_options>();
  options.solver = solver_of(solver);
  options.dt = dt.value_or(0);
  options.damping = damping.value_or(0);
  options.budget = budget.value_or(0);
  self.repeat(count, [&](mvs_sim *sim) { return mvs_step(sim, &options); });
  return stats_of(self);
}

mvs_branching branching_of(const std::optional<bool> &given) {
  if (!given) return 0;
  return *given ? MVS_BRANCHING_TREES : MVS_BRANCHING_STRAIGHT;
}

mvs_shape shape_of(const std::optional<std::string> &given) {
  if (!given) return 0;
  if (*given == "healthy") return MVS_SHAPE_HEALTHY;
  if (*given == "founding") return MVS_SHAPE_FOUNDING;
  throw py::value_error("shape is '" + *given + "', it must be 'healthy' or 'founding'");
}

mvs_leaflet_law law_of(const py::object &given) {
  if (given.is_none()) return 0;
  return py::module_::import("mvs.laws").attr("leaflet_law_of")(given).cast<uint32_t>();
}

void bind_generate(py::class_<Simulator> &type) {
  type.def(
      "generate",
      [](Simulator &self, Count vertices, Count chords, std::optional<bool> branching,
         Number annulus_ap, Number annulus_cc, Number saddle_height, Number anterior_height,
         Number posterior_height, Number commissure_height, Number thickness,
         Number papillary_depth, Number papillary_separation, Number annulus_contraction,
         Number annulus_scale, Number chord_slack, Number indentation_depth,
         Number coaptation_depth, const std::optional<std::string> &shape,
         const py::object &leaflet) {
        const mvs_parametric_desc desc = {.struct_size = sizeof(mvs_parametric_desc),
                                          .vertices = vertices.value_or(0),
                                          .chords = chords.value_or(0),
                                          .branching = branching_of(branching),
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
                                          .coaptation_depth = coaptation_depth.value_or(0),
                                          .shape = shape_of(shape),
                                          .leaflet_law = law_of(leaflet)};
        self.call([&](mvs_sim *sim) { return mvs_generate_valve(sim, &desc); });
      },
      py::kw_only(), "vertices"_a = py::none(), "chords"_a = py::none(), "branching"_a = py::none(),
      "annulus_ap"_a = py::none(), "annulus_cc"_a = py::none(), "saddle_height"_a = py::none(),
      "anterior_height"_a = py::none(), "posterior_height"_a = py::none(),
      "commissure_height"_a = py::none(), "thickness"_a = py::none(),
      "papillary_depth"_a = py::none(), "papillary_separation"_a = py::none(),
      "annulus_contraction"_a = py::none(), "annulus_scale"_a = py::none(),
      "chord_slack"_a = py::none(), "indentation_depth"_a = py::none(),
      "coaptation_depth"_a = py::none(), "shape"_a = py::none(), "leaflet"_a = py::none(),
      "Replaces the valve by a parametric mitral valve; None or 0 takes the default, an adult "
      "valve.\n\nvertices: approximate number of leaflet vertices, 200 to 100000\nchords: "
      "approximate number of chord segments\nbranching: chordae share trunks; None: in the healthy "
      "shape\nlengths in "
      "m; annulus_contraction: loaded over open size\nannulus_scale: factor on the loaded annulus "
      "(dilation); the rest shape stays\nchord_slack: factor on all rest "
      "lengths\nindentation_depth: of the clefts beside P2\ncoaptation_depth: of the closed "
      "coaptation line below the annulus plane\nshape: \"healthy\", which seals with every tissue, "
      "or \"founding\", that of the founding model\nleaflet: law of the leaflets, a mvs.LeafletLaw "
      "or its lower-case name, with default constants; None: \"bilinear\", the membrane, or "
      "\"spring\" in the founding shape");
}

void set_load(Simulator &self, double pressure, double boundary_fraction) {
  const mvs_load_case load{sizeof load, 0, pressure, boundary_fraction};
  self.call([&](mvs_sim *sim) { return mvs_set_load(sim, &load); });
}

void bind_work(py::class_<Simulator> &type) {
  type.def("set_load", &set_load, "pressure_pa"_a, "boundary_fraction"_a = 1.0,
           "Sets the load for settle and step.\n\npressure_pa: ventricle minus atrium, "
           "Pa\nboundary_fraction: position of annulus and heads, 0 open to 1 loaded");
  type.def("settle", &settle, py::kw_only(), "solver"_a = "newton", "max_iterations"_a = py::none(),
           "residual"_a = py::none(), "dt"_a = py::none(), "damping"_a = py::none(),
           "progress"_a = py::none(),
           "Brings the valve to static equilibrium under the load and returns mvs.Stats. A closure "
           "that does not converge raises no exception: check Stats.converged.\n\nsolver: "
           "\"newton\", \"implicit\" or \"explicit\"\nresidual: N, largest out-of-balance force at "
           "rest [1e-5]\ndt: s, and damping: 1/s, of the dynamic solvers\nprogress: called with "
           "(share done, residual in N) in this thread; True cancels (CancelledError), an "
           "exception stops the work and is raised again");
  type.def(
      "begin_settle", &begin_settle, py::kw_only(), "solver"_a = "newton",
      "max_iterations"_a = py::none(), "residual"_a = py::none(), "dt"_a = py::none(),
      "damping"_a = py::none(),
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
  type.def_property_readonly(
      "stats", [](Simulator &self) { return stats_of(self); },
      "Statistics of the last settle or step (mvs.Stats).");
  type.def_property_readonly(
      "load_case",
      [](Simulator &self) { return load_value(filled<mvs_load_case>(self, &mvs_get_load)); },
      "The load in force (mvs.Load).");
}

// All levels or none. The last level is checked first: the ones before it may take minutes.
void refine(Simulator &self, uint32_t times) {
  constexpr double most_triangles = 1 << 24;  // of mvs_refine_valve
  const std::unique_ptr<Snapshot> before = self.snapshot();
  mvs_view triangles{};
  must(mvs_snapshot_get_array(before->get(), MVS_ARRAY_TRIANGLE_NODES, &triangles));
  const auto now = static_cast<double>(triangles.count);
  if (times > 12 || std::ldexp(now, 2 * static_cast<int>(times)) > most_triangles) {
    refuse(MVS_E_ARGUMENT, "times",
           "times: " + std::to_string(triangles.count) + " triangles cannot be split " +
               std::to_string(times) + " times: the limit is 16,777,216 triangles");
  }
  try {
    self.repeat(times, &mvs_refine_valve);
  } catch (...) {
    self.call([&](mvs_sim *sim) { return mvs_restore(sim, before->get()); });
    throw;
  }
}

py::object coarsen(Simulator &self, Count vertices, Number edge) {
  auto options = sized<mvs_coarsen_options>();
  options.vertices = vertices.value_or(0);
  options.edge = edge.value_or(0);
  return coarsening_value(filled<mvs_coarsening>(self, [&](mvs_sim *sim, mvs_coarsening *made) {
    return mvs_coarsen_valve(sim, &options, made);
  }));
}

void transfer_state(Simulator &self, const Snapshot &from) {
  self.call([&](mvs_sim *sim) { return mvs_transfer_state(sim, from.get()); });
}

void bind_levels(py::class_<Simulator> &type) {
  type.def("refine", &refine, "times"_a = 1,
           "Splits every triangle into four, this many times. Surface and parts stay, old nodes "
           "keep their index, and the state is interpolated. The history restarts. ArgumentError "
           "beyond 16,777,216 triangles; an interrupted call changes nothing.");
  type.def("coarsen", &coarsen, py::kw_only(), "vertices"_a = py::none(), "edge"_a = py::none(),
           "Removes vertices from the leaflets and returns mvs.Coarsening. The others keep "
           "position and state; Snapshot.node_origin identifies them. The history restarts. "
           "ArgumentError reports the minimum.\n\nvertices: exact number of leaflet "
           "vertices\nedge: m, approximate mean edge length; give one of the two");
  type.def("transfer_state", &transfer_state, "snapshot"_a,
           "Transfers the state from a snapshot of a coarser or finer level of this valve. The "
           "history restarts. ArgumentError if they are not levels of one valve.");
}

void bind_tissue(py::class_<Simulator> &type) {
  type.def("set_leaflet", &set_leaflet, "leaflet"_a = py::none(), py::kw_only(), "law"_a,
           "constants"_a = py::tuple(), "thickness"_a = 0.0,
           "Sets the material law of a leaflet; shape, chordae, state and load stay, the history "
           "restarts.\n\nleaflet: its name; None: all of them\nlaw: a mvs.LeafletLaw, or its "
           "lower-case name (\"bilinear\")\nconstants: of the law, in order (at most 8), or a "
           "dictionary "
           "by the keys of mvs.leaflet_law(law); moduli in Pa; empty: "
           "its defaults, and \"bilinear\" on springs takes over their stress-strain "
           "curve\nthickness: m; 0 keeps it, another value scales that of each triangle\nIdError: "
           "unknown leaflet. OpError: constants out of range.");
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
      "for each other. A call that raises leaves the simulator as it was.\n\nbackend: the sparse "
      "factorisation, one of " +
      backend_words() +
      "\nworkers: threads that share the work of a settle or step on a valve of more than about "
      "1,000 vertices, at most 256; no bit of a result depends on them"
      "\nlike: a mvs.Snapshot that the simulator begins with (restore); its variants, which "
      "set_valve "
      "and load set, share what depends on its mesh, in any thread, with the same bits"
      "\nlog: called with (level, text); None: warnings (level 2) become mvs.ValveWarning";
  py::class_<Simulator> type(module, "Simulator", about.c_str());
  type.def(py::init(&make_simulator), py::kw_only(), "backend"_a = "default", "workers"_a = 1,
           "like"_a = py::none(), "log"_a = py::none());
  bind_files(type);
  bind_generate(type);
  bind_build(type);
  bind_levels(type);
  bind_tissue(type);
  bind_work(type);
  bind_operations(module, type);
  bind_plans(module, type);
  bind_tools(type);
  type.def("set_valve", &set_valve,
           "Replaces the valve by a mvs.Valve, or by the arguments of one. OpError has the first "
           "fault; mvs.check_valve lists all faults.");
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
  module.def("check_valve", &check_valve,
             "The faults of a valve (list of mvs.Fault); for a valve without faults its warnings, "
             "such as triangles that cross. Arguments as for Simulator.set_valve.");
}

}  // namespace mvs_python
