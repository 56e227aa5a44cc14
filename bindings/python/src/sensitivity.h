// Snapshot._sensitivity: derivatives as arrays; mvs/sensitivities.py adds the labels.
#pragma once

#include "snapshot.h"

namespace mvs_python {

void bind_sensitivity(py::class_<Snapshot> &type);

}  // namespace mvs_python
