// What laws of tissue say of themselves.
#pragma once

#include <pybind11/pybind11.h>

namespace mvs_python {

void bind_laws(pybind11::module_ &module);

}  // namespace mvs_python
