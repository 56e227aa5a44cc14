// The methods of mvs.Simulator that set its valve: a given or a parametric one, finer and coarser
// levels, tissue; and mvs.check_valve.
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <memory>

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

void set_valve(Simulator &self, const py::args &args, const py::kwargs &kwargs) {
  const ValveArguments valve(valve_of(args, kwargs));
  self.call([&](mvs_sim *sim) { return mvs_set_valve(sim, &valve.desc()); });
}

// The part at fault and the sentence.
using Fault = std::pair<std::string, std::string>;

// The warnings of mvs_set_valve about a valve without faults.
std::vector<std::string> warnings_of(const mvs_valve_desc &valve) {
  std::vector<std::string> said;
  auto options = sized<mvs_sim_desc>();
  options.user = &said;
  options.log = [](void *user, mvs_log_level level, const char *text) {
    if (level <= MVS_LOG_WARNING) static_cast<decltype(said) *>(user)->emplace_back(text);
  };
  mvs_sim *sim = nullptr;
  must(mvs_create(&options, &sim));
  const std::unique_ptr<mvs_sim, void (*)(mvs_sim *)> held(sim, &mvs_destroy);
  release_and([&] { return mvs_set_valve(sim, &valve); });
  return said;
}

// mvs_check_valve knows of doubtful meshes only: adds the warnings about units.
void add_warnings(const mvs_valve_desc &valve, std::vector<Fault> &found) {
  for (const std::string &text : warnings_of(valve)) {
    // a long sentence is cut in the log
    const bool known = std::any_of(found.begin(), found.end(), [&](const Fault &fault) {
      return fault.second.compare(0, text.size(), text) == 0;
    });
    if (!known) found.emplace_back("", text);
  }
}

// The faults of a valve as a list of mvs.Fault; its warnings if it has none.
py::list check_valve(const py::args &args, const py::kwargs &kwargs) {
  const ValveArguments valve(valve_of(args, kwargs));
  std::vector<Fault> faults;
  const auto note = [](void *user, const char *part, const char *sentence) {
    static_cast<decltype(faults) *>(user)->emplace_back(part, sentence);
  };
  const mvs_result result = mvs_check_valve(&valve.desc(), note, &faults);
  if (result != MVS_OK && faults.empty()) must(result);
  if (result == MVS_OK) add_warnings(valve.desc(), faults);
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
    must(mvs_snapshot_find_part(self.snapshot()->get(), MVS_PART_LEAFLET,
                                c_text(*leaflet, "leaflet"), &part));
  self.call([&](mvs_sim *sim) { return mvs_set_leaflet(sim, part.id, &tissue); });
}

mvs_branching branching_of(const std::optional<bool> &given) {
  if (!given) return 0;
  return *given ? MVS_BRANCHING_TREES : MVS_BRANCHING_STRAIGHT;
}

mvs_shape shape_of(const std::optional<std::string> &given) {
  if (!given) return 0;
  if (*given == "healthy") return MVS_SHAPE_HEALTHY;
  if (*given == "founding") return MVS_SHAPE_FOUNDING;
  refuse(MVS_E_ARGUMENT, "shape",
         "shape: \"healthy\" or \"founding\" is needed, not \"" + *given + "\"");
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
        const mvs_parametric_desc desc = {
            .struct_size = sizeof(mvs_parametric_desc),
            .vertices = given_or_default(vertices, "vertices"),
            .chords = given_or_default(chords, "chords"),
            .branching = branching_of(branching),
            .annulus_ap = given_or_default(annulus_ap, "annulus_ap"),
            .annulus_cc = given_or_default(annulus_cc, "annulus_cc"),
            .saddle_height = given_or_default(saddle_height, "saddle_height"),
            .anterior_height = given_or_default(anterior_height, "anterior_height"),
            .posterior_height = given_or_default(posterior_height, "posterior_height"),
            .commissure_height = given_or_default(commissure_height, "commissure_height"),
            .thickness = given_or_default(thickness, "thickness"),
            .papillary_depth = given_or_default(papillary_depth, "papillary_depth"),
            .papillary_separation = given_or_default(papillary_separation, "papillary_separation"),
            .annulus_contraction = given_or_default(annulus_contraction, "annulus_contraction"),
            .annulus_scale = given_or_default(annulus_scale, "annulus_scale"),
            .chord_slack = given_or_default(chord_slack, "chord_slack"),
            .indentation_depth = given_or_default(indentation_depth, "indentation_depth"),
            .coaptation_depth = given_or_default(coaptation_depth, "coaptation_depth"),
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
      "Replaces the valve by a parametric mitral valve; None takes the default, an adult "
      "valve; 0 is refused.\n\nvertices: approximate number of leaflet vertices, 200 to "
      "100000\nchords: "
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
  options.vertices = given_or_default(vertices, "vertices");
  options.edge = given_or_default(edge, "edge");
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

}  // namespace

void bind_valve(py::module_ &module, py::class_<Simulator> &type) {
  bind_generate(type);
  bind_levels(type);
  bind_tissue(type);
  type.def("set_valve", &set_valve,
           "Replaces the valve by a mvs.Valve, or by the arguments of one. OpError has the first "
           "fault; mvs.check_valve lists all faults.");
  module.def("check_valve", &check_valve,
             "The faults of a valve (list of mvs.Fault); for a valve without faults the warnings "
             "that Simulator.set_valve gives: triangles that cross, moduli that look like "
             "another unit. Arguments as for Simulator.set_valve.");
}

}  // namespace mvs_python
