// Garbage collection of mvs.Simulator: the functions `log` and `progress` that it holds may be
// methods of an object that holds the simulator. See "Custom type setup" in pybind11's
// documentation.
#include "simulator.h"

namespace mvs_python {
namespace {

// The simulator of an object of the class or of a class derived from it. Null for one that is not
// made yet, which the collector may see: also before pybind11 has laid it out. An object of several
// C++ classes has another layout, and its functions are not visited.
Simulator *simulator_of(PyObject *self) {
  auto *made = reinterpret_cast<py::detail::instance *>(self);
  if (!made->simple_layout || !made->simple_holder_constructed) return nullptr;
  return made->get_value_and_holder().value_ptr<Simulator>();
}

int traverse(PyObject *self, visitproc visit, void *arg) {
  // from Python 3.9 on an object of a heap type visits its type
  Py_VISIT(Py_TYPE(self));
  const Simulator *simulator = simulator_of(self);
  return simulator ? simulator->visit_functions(visit, arg) : 0;
}

int clear(PyObject *self) {
  if (Simulator *simulator = simulator_of(self)) simulator->drop_functions();
  return 0;
}

}  // namespace

int Simulator::visit_functions(visitproc visit, void *arg) const {
  Py_VISIT(log_.ptr());
  Py_VISIT(progress_.ptr());
  return 0;
}

void Simulator::drop_functions() {
  log_ = py::none();
  progress_ = py::none();
}

py::custom_type_setup collected_with_functions() {
  return py::custom_type_setup([](PyHeapTypeObject *heap_type) {
    PyTypeObject &type = heap_type->ht_type;
    type.tp_flags |= Py_TPFLAGS_HAVE_GC;
    type.tp_traverse = &traverse;
    type.tp_clear = &clear;
  });
}

}  // namespace mvs_python
