// Simulator.build_valve: valves from surfaces.
#pragma once

#include "simulator.h"

namespace mvs_python {

void bind_build(py::class_<Simulator> &type);

}  // namespace mvs_python
