// Converts results of the C interface to exceptions of mvs.errors.
#pragma once

#include <mvs/base.h>
#include <pybind11/pybind11.h>

#include <chrono>
#include <exception>
#include <optional>
#include <string>

namespace mvs_python {

namespace py = pybind11;

// A result with its error, kept while the interpreter is released.
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

// Raises the exception of a code with a sentence of the binding.
[[noreturn]] void refuse(mvs_result code, const std::string &part, const std::string &sentence);

// ArgumentError for an argument that is neither a function nor None.
void refuse_no_function(const pybind11::object &given, const std::string &part);

// The value of an option, 0 if it is not given, which is the default of the library: ArgumentError
// for a 0 that is given, which would be taken for it.
template <typename Value>
Value given_or_default(const std::optional<Value> &given, const char *name) {
  if (given && *given == 0) {
    refuse(MVS_E_ARGUMENT, name, std::string(name) + ": 0 is given; None is the default");
  }
  return given.value_or(Value{});
}

// A text in UTF-8: ArgumentError if UTF-8 cannot hold it, as half of a surrogate pair.
std::string text_of(const py::handle &value, const std::string &part);

// A text of an argument or a part as a C string, which ends at its first zero byte: ArgumentError
// if it has one.
const char *c_text(const std::string &text, const std::string &part);

// Issues an mvs.ValveWarning; throws if the warning filter turns it into an error.
void warn(const char *sentence);

// Progress callback: checks for Ctrl-C and calls `progress` unless it is None. Returns 1 to cancel;
// an exception is kept in `raised`. The interpreter must be held.
int32_t report_progress(const py::object &progress, double share, double residual,
                        std::exception_ptr &raised);

// Looks for Ctrl-C between the parts of long work, at most every 50 ms: taking the interpreter
// costs more than a short part.
class SignalWatch {
 public:
  // True after a signal handler raised an exception, which is kept in `raised`. The interpreter
  // must be released.
  bool interrupted(std::exception_ptr &raised);

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point looked_ = Clock::now();
};

// A zeroed struct of the C interface with its size.
template <typename Struct>
Struct sized() {
  Struct made{};
  made.struct_size = sizeof made;
  return made;
}

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
