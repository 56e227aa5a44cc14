// Instruments of mvs.Simulator; values.cpp has those of a snapshot.
#include <pybind11/stl.h>

#include "bodies.h"
#include "simulator.h"
#include "values.h"

namespace mvs_python {
namespace {

using namespace py::literals;

using Number = std::optional<double>;
using Place = std::array<double, 3>;
using Turn = std::array<double, 4>;  // w x y z

uint32_t kind_of(const std::string &name) {
  if (name == "grasp") return MVS_TOOL_KIND_GRASP;
  if (name == "ball") return MVS_TOOL_KIND_BALL;
  if (name == "rod") return MVS_TOOL_KIND_ROD;
  if (name == "convex") return MVS_TOOL_KIND_CONVEX;
  refuse(MVS_E_ARGUMENT, "kind",
         "kind: \"grasp\", \"ball\", \"rod\" or \"convex\" is needed, not \"" + name + "\"");
}

mvs_id add_tool(Simulator &self, const std::string &kind, const Place &position,
                const std::optional<Place> &axis, Number radius, Number length, Number stiffness,
                Number max_force, Number reach, std::optional<uint32_t> node,
                const std::vector<py::dict> &given, const std::optional<Turn> &orientation,
                bool strict_hulls) {
  auto desc = sized<mvs_tool_desc>();
  desc.kind = kind_of(kind);
  std::copy(position.begin(), position.end(), desc.position);
  if (axis) std::copy(axis->begin(), axis->end(), desc.axis);
  desc.radius = given_or_default(radius, "radius");
  desc.length = given_or_default(length, "length");
  desc.stiffness = given_or_default(stiffness, "stiffness");
  desc.max_force = given_or_default(max_force, "max_force");
  desc.reach = given_or_default(reach, "reach");
  desc.by_node = node ? 1 : 0;
  desc.node = node.value_or(0);
  const Bodies bodies(given);
  desc.bodies = bodies.descs.data();
  desc.body_count = static_cast<uint32_t>(bodies.descs.size());
  desc.body_stride = sizeof(mvs_body_desc);
  if (orientation) std::copy(orientation->begin(), orientation->end(), desc.orientation);
  desc.strict_hulls = strict_hulls ? 1 : 0;
  mvs_id tool = 0;
  self.call([&](mvs_sim *sim) { return mvs_add_tool(sim, &desc, &tool); });
  return tool;
}

void move_tool(Simulator &self, mvs_id tool, const Place &position,
               const std::optional<Place> &axis, const std::optional<Turn> &orientation) {
  if (axis && orientation) {
    refuse(MVS_E_ARGUMENT, "axis", "axis, orientation: give one of them");
  }
  if (orientation) {
    self.look([&](mvs_sim *sim) {
      return mvs_move_tool_pose(sim, tool, position.data(), orientation->data());
    });
    return;
  }
  self.look([&](mvs_sim *sim) {
    return mvs_move_tool(sim, tool, position.data(), axis ? axis->data() : nullptr);
  });
}

void remove_tool(Simulator &self, mvs_id tool) {
  self.call([&](mvs_sim *sim) { return mvs_remove_tool(sim, tool); });
}

py::object tool_by_id(Simulator &self, mvs_id tool) {
  auto state = sized<mvs_tool_state>();
  self.look([&](mvs_sim *sim) { return mvs_get_tool(sim, tool, &state); });
  return tool_value(state);
}

}  // namespace

void bind_tools(py::class_<Simulator> &type) {
  type.def(
      "add_tool", &add_tool, "kind"_a, "position"_a, py::kw_only(), "axis"_a = py::none(),
      "radius"_a = py::none(), "length"_a = py::none(), "stiffness"_a = py::none(),
      "max_force"_a = py::none(), "reach"_a = py::none(), "node"_a = py::none(),
      "bodies"_a = py::tuple(), "orientation"_a = py::none(), "strict_hulls"_a = false,
      "Adds an instrument and returns its id.\n\nkind: \"grasp\" holds a node, \"ball\", "
      "\"rod\" and \"convex\" push tissue and never pass through a leaflet\nposition: m, of the "
      "hand\naxis: "
      "of a rod, from tip to handle\nradius: m [2e-3]\nlength: m, of a rod "
      "[40e-3]\nstiffness: N/m, of the spring between hand and tool [200]\nmax_force: N, of "
      "that spring [5]\nreach: m; a grasp takes the nearest free leaflet vertex within it "
      "[2e-3]\nnode: index of the node to grasp, at any distance\nbodies: of a convex "
      "tool, 1 to 16 dictionaries in the frame of the hand, with kind \"hull\" (vertices, n x "
      "3), \"ball\" (position), \"capsule\" (position, end), \"box\" (position, size, "
      "orientation), \"cylinder\" or \"cone\" (position, end, size: radius of the circle), and "
      "radius: of a ball or capsule, or by which it is rounded; all in m\norientation: of a "
      "convex tool, w x y z of a quaternion\nstrict_hulls: refuses a hull whose vertices are "
      "not convex, instead of hulling them with a warning\nArgumentError: no node "
      "within reach. StateError: the tool would intersect tissue.");
  type.def("move_tool", &move_tool, "tool"_a, "position"_a, "axis"_a = py::none(), py::kw_only(),
           "orientation"_a = py::none(),
           "Moves the hand of a tool, and turns a convex tool (w x y z of a quaternion); the next "
           "settle or step uses it. Allowed in any thread at "
           "any time. IdError for an unknown tool.");
  type.def("remove_tool", &remove_tool, "tool"_a,
           "Removes a tool; it releases the node that it holds.");
  type.def("tool", &tool_by_id, "tool"_a, "A tool of the present snapshot (mvs.Tool), by its id.");
}

}  // namespace mvs_python
