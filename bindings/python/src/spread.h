// mvs.Spread: what a valve closes to along several paths.
#pragma once

#include <mvs/ensemble.h>

#include <memory>

#include "snapshot.h"

namespace mvs_python {

// Owns a spread of the C library, which never changes.
class Spread {
 public:
  explicit Spread(mvs_ensemble *made) : handle_(made, &mvs_ensemble_release) {}
  const mvs_ensemble *get() const { return handle_.get(); }

 private:
  std::unique_ptr<mvs_ensemble, void (*)(mvs_ensemble *)> handle_;
};

void bind_spread(py::module_ &module, py::class_<Snapshot> &type);

}  // namespace mvs_python
