// mvs.Snapshot: a reference to a snapshot of the C library.
#pragma once

#include <mvs/snapshot.h>

#include <memory>

#include "errors.h"

namespace mvs_python {

// Owns one reference to a snapshot; arrays keep its Python object alive.
class Snapshot {
 public:
  // Takes ownership of a reference of mvs_get_snapshot.
  explicit Snapshot(const mvs_snapshot *taken) : handle_(taken, &mvs_snapshot_release) {}
  const mvs_snapshot *get() const { return handle_.get(); }

 private:
  std::unique_ptr<const mvs_snapshot, void (*)(const mvs_snapshot *)> handle_;
};

// MVS_FORMAT_* from "auto", "obj", "h5", "vtp", "inp" or "feb".
uint32_t format_of(const std::string &name);

void bind_snapshot(py::module_ &module);
void bind_measures(py::class_<Snapshot> &type);
void bind_plan_writing(py::class_<Snapshot> &type);

}  // namespace mvs_python
