// mvs._core.SurfaceFile: surfaces and landmarks in files of other programs.
#pragma once

#include <pybind11/pybind11.h>

namespace mvs_python {

void bind_surface_file(pybind11::module_ &module);

}  // namespace mvs_python
