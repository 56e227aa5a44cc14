// mvs.Ensemble: the closures of one valve from several perturbed starts and loading orders.
#pragma once

#include <mvs/ensemble.h>

#include <memory>

#include "snapshot.h"

namespace mvs_python {

// Owns an ensemble of the C library, which is immutable.
class Ensemble {
 public:
  explicit Ensemble(mvs_ensemble *made) : handle_(made, &mvs_ensemble_release) {}
  const mvs_ensemble *get() const { return handle_.get(); }

 private:
  std::unique_ptr<mvs_ensemble, void (*)(mvs_ensemble *)> handle_;
};

void bind_ensemble(py::module_ &module, py::class_<Snapshot> &type);

}  // namespace mvs_python
