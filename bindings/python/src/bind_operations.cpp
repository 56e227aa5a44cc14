// Operations, undo, groups and checkpoints of mvs.Simulator.
#include "operations.h"
#include "simulator.h"

namespace mvs_python {
namespace {

using namespace py::literals;

// The C struct of `operation`: a mvs.Operation, or the name of one with its fields.
OpStruct struct_of(Simulator &self, const py::object &operation, const py::kwargs &fields) {
  const py::object made = py::module_::import("mvs.ops").attr("operation")(operation, fields);
  return OpStruct(made, py::cast(self.snapshot()));
}

void check(Simulator &self, const py::object &operation, const py::kwargs &fields) {
  const OpStruct op = struct_of(self, operation, fields);
  self.call([&](mvs_sim *sim) { return mvs_check_op(sim, op.get()); });
}

py::object apply(Simulator &self, const py::object &operation, const py::kwargs &fields) {
  const OpStruct op = struct_of(self, operation, fields);
  mvs_id made = 0;
  self.call([&](mvs_sim *sim) { return mvs_apply_op(sim, op.get(), &made); });
  return made ? py::object(py::int_(made)) : py::none();
}

py::object group(const py::object &self, const std::string &name) {
  return py::module_::import("mvs.ops").attr("Group")(self, name);
}

void bind_history(py::class_<Simulator> &type) {
  type.def("undo", &plain_call<mvs_undo>,
           "Undoes the last operation or group, bit for bit; StateError if the history is empty.");
  type.def(
      "redo", &plain_call<mvs_redo>,
      "Applies the last undone operation or group again, bit for bit; StateError without one.");
  type.def("group", &group, "name"_a,
           "with sim.group(\"repair of P2\"): operations within are undone and redone together. If "
           "one raises, the earlier ones stay as one group. Groups do not nest.");
  type.def("begin_group", &text_call<mvs_begin_group>, "name"_a,
           "Begins a group; end_group ends it. For code that cannot use `with sim.group(name)`.");
  type.def("end_group", &plain_call<mvs_end_group>, "Ends the group of begin_group.");
  type.def(
      "set_checkpoint", &text_call<mvs_set_checkpoint>, "name"_a,
      "Stores valve, state and history under a name; replaces an older checkpoint of that name.");
  type.def("restore_checkpoint", &text_call<mvs_restore_checkpoint>, "name"_a,
           "Restores a checkpoint, bit for bit; IdError for an unknown name.");
}

}  // namespace

void bind_operations(py::module_ &module, py::class_<Simulator> &type) {
  type.def(
      "apply", &apply, "operation"_a, py::pos_only(),
      "Applies a surgical operation and returns the id of the part that it creates, or "
      "None.\n\noperation: a mvs.ops.Operation, or the name of one with its fields as keywords: "
      "sim.apply(\"chord_length\", chord=\"P2/3\", factor=0.75). help(mvs.ops.chord_length) lists "
      "fields and units.\nOpError: the operation is impossible. IdError: unknown part. "
      "ArgumentError: invalid value. Nodes do not move until the next settle or step.");
  type.def(
      "check", &check, "operation"_a, py::pos_only(),
      "Raises the exception that apply would raise, and changes nothing; arguments as for apply.");
  bind_history(type);
  module.def("op_kinds", &op_kinds,
             "The operations as the library describes them; use mvs.ops.KINDS instead.");
}

}  // namespace mvs_python
