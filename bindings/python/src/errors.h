// Results of the C interface become exceptions of mvs.errors.
#pragma once

#include <mvs/base.h>
#include <pybind11/pybind11.h>

#include <string>

namespace mvs_python {

namespace py = pybind11;

// A result with its sentence, kept while the interpreter is released.
struct Outcome {
  mvs_result result = MVS_OK;
  mvs_error error{};
};

// Pairs a result with the last error of this thread.
Outcome outcome_of(mvs_result result);

// Raises the exception of a failed outcome; the interpreter must be held.
void must(const Outcome &outcome);
inline void must(mvs_result result) {
  must(outcome_of(result));
}

// Raises the exception of a code from a sentence of the binding itself.
[[noreturn]] void refuse(mvs_result code, const std::string &part, const std::string &sentence);

// Warns of what the library says to nobody in particular; throws where warnings are errors.
void warn(const char *sentence);

// Runs a call of the C library with the interpreter released, and raises if it failed.
template <typename Call>
void release_and(Call &&call) {
  Outcome outcome;
  {
    py::gil_scoped_release released;
    outcome = outcome_of(call());
  }
  must(outcome);
}

}  // namespace mvs_python
