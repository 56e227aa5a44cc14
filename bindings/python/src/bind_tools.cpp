// Instruments: of mvs.Simulator here, as seen in a snapshot in values.cpp.
#include <pybind11/stl.h>

#include "simulator.h"
#include "values.h"

namespace mvs_python {
namespace {

using Number = std::optional<double>;
using Place = std::array<double, 3>;

uint32_t kind_of(const std::string &name) {
  if (name == "grasp") return MVS_TOOL_KIND_GRASP;
  if (name == "ball") return MVS_TOOL_KIND_BALL;
  if (name == "rod") return MVS_TOOL_KIND_ROD;
  refuse(MVS_E_ARGUMENT, "kind",
         "kind: \"grasp\", \"ball\" or \"rod\" is needed, not \"" + name + "\"");
}

mvs_id add_tool(Simulator &self, const std::string &kind, const Place &position,
                const std::optional<Place> &axis, Number radius, Number length, Number stiffness,
                Number max_force, Number reach, std::optional<uint32_t> node) {
  mvs_tool_desc desc{};
  desc.struct_size = sizeof desc;
  desc.kind = kind_of(kind);
  std::copy(position.begin(), position.end(), desc.position);
  if (axis) std::copy(axis->begin(), axis->end(), desc.axis);
  desc.radius = radius.value_or(0);
  desc.length = length.value_or(0);
  desc.stiffness = stiffness.value_or(0);
  desc.max_force = max_force.value_or(0);
  desc.reach = reach.value_or(0);
  desc.by_node = node ? 1 : 0;
  desc.node = node.value_or(0);
  return self.add_tool(desc);
}

void move_tool(Simulator &self, mvs_id tool, const Place &position,
               const std::optional<Place> &axis) {
  self.move_tool(tool, position.data(), axis ? axis->data() : nullptr);
}

}  // namespace

void bind_tools(py::class_<Simulator> &type) {
  type.def(
      "add_tool", &add_tool, py::arg("kind"), py::arg("position"), py::kw_only(),
      py::arg("axis") = py::none(), py::arg("radius") = py::none(), py::arg("length") = py::none(),
      py::arg("stiffness") = py::none(), py::arg("max_force") = py::none(),
      py::arg("reach") = py::none(), py::arg("node") = py::none(),
      "Adds an instrument and returns its id.\n\nkind: \"grasp\" holds a node, \"ball\" and "
      "\"rod\" push and never pass through a leaflet\nposition: m, of the hand\naxis: of a rod, "
      "from tip to handle\nradius: m [2e-3]\nlength: m, of a rod [40e-3]\nstiffness: N/m, of "
      "the spring between hand and tool [200]\nmax_force: N, of that spring [5]\nreach: m; a "
      "grasp takes the nearest free vertex of a leaflet within it [2e-3]\nnode: to be grasped, "
      "from anywhere\nArgumentError: nothing in reach. StateError: it would lie in tissue.");
  type.def(
      "move_tool", &move_tool, py::arg("tool"), py::arg("position"), py::arg("axis") = py::none(),
      "Moves the hand of a tool; the next settle or step begins with it. From any thread, also "
      "while the simulator is at work. IdError if the tool is not there.");
  type.def("remove_tool", &Simulator::remove_tool, py::arg("tool"),
           "Takes a tool out; lets go of what it holds.");
  type.def(
      "tool", [](Simulator &self, mvs_id tool) { return tool_value(self.tool(tool)); },
      py::arg("tool"), "A tool of the present snapshot (mvs.Tool), by its id.");
}

}  // namespace mvs_python
