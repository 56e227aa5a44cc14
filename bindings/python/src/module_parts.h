// Parts of the module beside the classes that hold each other: material laws, and files of
// surfaces.
#pragma once

#include <pybind11/pybind11.h>

namespace mvs_python {

// mvs.leaflet_law and mvs.chord_law: descriptions of the material laws.
void bind_laws(pybind11::module_ &module);
// mvs._core.SurfaceFile: surfaces and landmarks in files of other programs.
void bind_surface_file(pybind11::module_ &module);

}  // namespace mvs_python
