// A call of the C library with a progress callback of its own, outside of a simulator.
#pragma once

#include <utility>

#include "errors.h"

namespace mvs_python {

// Calls `progress`, which may be None, and looks for Ctrl-C. The options of the call take
// `callback` with the address of this object, which must not move.
struct ProgressCall {
  explicit ProgressCall(py::object given) : progress(std::move(given)) {
    refuse_no_function(progress, "progress");
  }

  static int32_t callback(void *user, double share, double residual) {
    auto &self = *static_cast<ProgressCall *>(user);
    const py::gil_scoped_acquire held;
    return report_progress(self.progress, share, residual, self.raised);
  }

  // Runs a call of the C library with the interpreter released; raises the exception of the
  // callback, or that of the call.
  template <typename Call>
  void run(Call &&call) {
    Outcome outcome;
    {
      const py::gil_scoped_release released;
      outcome = outcome_of(call());
    }
    if (raised) std::rethrow_exception(raised);
    must(outcome);
  }

  py::object progress;
  std::exception_ptr raised;
};

}  // namespace mvs_python
