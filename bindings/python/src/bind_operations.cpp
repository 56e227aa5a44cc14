// Operations, undo, groups and checkpoints of mvs.Simulator.
#include "operations.h"
#include "simulator.h"

namespace mvs_python {
namespace {

// The struct of `operation`, a mvs.Operation or the name of one with its fields.
OpStruct struct_of(Simulator &self, const py::object &operation, const py::kwargs &fields) {
  const py::object made = py::module_::import("mvs.ops").attr("operation")(operation, fields);
  return OpStruct(made, py::cast(self.snapshot()));
}

void check(Simulator &self, const py::object &operation, const py::kwargs &fields) {
  self.check(struct_of(self, operation, fields).get());
}

py::object apply(Simulator &self, const py::object &operation, const py::kwargs &fields) {
  const mvs_id made = self.apply(struct_of(self, operation, fields).get());
  return made ? py::object(py::int_(made)) : py::none();
}

py::object group(const py::object &self, const std::string &name) {
  return py::module_::import("mvs.ops").attr("Group")(self, name);
}

void bind_history(py::class_<Simulator> &type) {
  type.def("undo", &Simulator::undo,
           "Takes back the last operation or group, bit for bit; StateError if there is none.");
  type.def("redo", &Simulator::redo,
           "Applies again what was undone last, bit for bit; StateError if there is nothing.");
  type.def("group", &group, py::arg("name"),
           "with sim.group(\"repair of P2\"): operations within are undone and redone together. "
           "If one raises, those before it stay, as one group. Groups do not nest.");
  type.def("begin_group", &Simulator::begin_group, py::arg("name"),
           "Begins a group, where `with sim.group(name)` does not fit, as in a dialog.");
  type.def("end_group", &Simulator::end_group, "Ends the group that begin_group began.");
  type.def("set_checkpoint", &Simulator::set_checkpoint, py::arg("name"),
           "Keeps valve, state and history under a name, in place of an older one of that name.");
  type.def("restore_checkpoint", &Simulator::restore_checkpoint, py::arg("name"),
           "Goes back to a checkpoint, bit for bit; IdError if there is none of this name.");
}

}  // namespace

void bind_operations(py::module_ &module, py::class_<Simulator> &type) {
  type.def("apply", &apply, py::arg("operation"), py::pos_only(),
           "Applies a surgical operation and returns the id of the part that it made, or None.\n\n"
           "operation: a mvs.ops.Operation, or the name of one with its fields as keywords: "
           "sim.apply(\"chord_length\", chord=\"P2/3\", factor=0.75). help(mvs.ops.chord_length) "
           "lists fields and units.\nOpError for what cannot be done, IdError for a part that is "
           "not there, ArgumentError for a wrong value. Nodes stay where they are until the next "
           "settle or step.");
  type.def("check", &check, py::arg("operation"), py::pos_only(),
           "Raises what apply would raise, and changes nothing; arguments as for apply.");
  bind_history(type);
  module.def("op_kinds", &op_kinds,
             "The operations as the library describes them; use mvs.ops.KINDS instead.");
}

}  // namespace mvs_python
