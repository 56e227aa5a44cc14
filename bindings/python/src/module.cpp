// mvs._core: the C interface of libmvs for Python.
#include <mvs/base.h>

#include "device.h"
#include "module_parts.h"
#include "simulator.h"
#include "snapshot.h"
#include "values.h"

namespace {

std::string version() {
  const uint32_t v = mvs_version();
  return std::to_string(v / 10000) + "." + std::to_string(v / 100 % 100) + "." +
         std::to_string(v % 100);
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  module.doc() = "The C interface of libmvs for Python; import mvs instead.";
  mvs_python::bind_snapshot(module);
  mvs_python::bind_simulator(module);
  mvs_python::bind_device(module);
  mvs_python::bind_laws(module);
  mvs_python::bind_surface_file(module);
  module.def("field_descriptions", &mvs_python::field_descriptions, pybind11::arg("which"),
             "(name, unit, definition) of every field of a struct of results, MVS_STRUCT_*.");
  module.def("measure_groups", &mvs_python::measure_groups,
             "The groups of measures: {word: MVS_MEASURE_GROUP_*}.");
  module.def("version", &version, "The version of the library in use.");
  module.def("features", &mvs_features, "Optional parts of this build, separated by spaces.");
}
