// mvs.leaflet_law and mvs.chord_law: descriptions of the material laws.
#pragma once

#include <pybind11/pybind11.h>

namespace mvs_python {

void bind_laws(pybind11::module_ &module);

}  // namespace mvs_python
