// Operations and their history on mvs.Simulator and mvs.Snapshot.
#include "operation.h"
#include "simulator.h"

namespace mvs_python {
namespace {

mvs_id apply_op(Simulator &self, const std::string &kind, const py::kwargs &fields) {
  const std::unique_ptr<Snapshot> valve = self.snapshot();
  return self.apply_op(OperationArguments(kind, fields, *valve).get());
}

void check_op(Simulator &self, const std::string &kind, const py::kwargs &fields) {
  const std::unique_ptr<Snapshot> valve = self.snapshot();
  self.check_op(OperationArguments(kind, fields, *valve).get());
}

}  // namespace

void bind_surgery(py::module_ &module, py::class_<Simulator> &type) {
  type.def("check_op", &check_op, py::arg("kind"),
           "Raises what apply_op would raise now; nothing changes.");
  type.def(
      "apply_op", &apply_op, py::arg("kind"),
      "Applies a surgical operation and returns the id of what it made, 0 for nothing. The "
      "next settle or step brings the valve to where it leads.\n\nkind: \"chord_length\", ...; "
      "mvs.operations() lists all kinds with their fields, in SI units\nparts are given as "
      "mvs.Part, name or id\na site is a node, (triangle, (u, v, w)), or (scallop, along, "
      "height) with both from 0 to 1\nOpError tells what cannot be done");
  type.def("undo", &Simulator::undo,
           "Takes back the last operation or group, bit for bit. StateError if there is none.");
  type.def("redo", &Simulator::redo,
           "Applies again what was undone last. StateError if there is nothing.");
  type.def("begin_group", &Simulator::begin_group, py::arg("name"),
           "Operations until end_group are undone and redone together.");
  type.def("end_group", &Simulator::end_group, "Ends the group that is open.");
  type.def("set_checkpoint", &Simulator::set_checkpoint, py::arg("name"),
           "Keeps valve, state and history under a name.");
  type.def("restore_checkpoint", &Simulator::restore_checkpoint, py::arg("name"),
           "Goes back to a checkpoint, bit for bit. IdError if there is none of this name.");
  module.def("operations", &operations,
             "Every kind of operation with its fields (tuple of mvs.OperationKind).");
}

}  // namespace mvs_python
