#include "errors.h"

namespace mvs_python {
namespace {

[[noreturn]] void raise(mvs_result code, const char *sentence, const char *part, int32_t line) {
  const py::object error = py::module_::import("mvs.errors").attr("of")(code, sentence, part, line);
  PyErr_SetObject(py::type::handle_of(error).ptr(), error.ptr());
  throw py::error_already_set();
}

}  // namespace

Outcome outcome_of(mvs_result result) {
  Outcome outcome;
  outcome.result = result;
  if (result != MVS_OK) outcome.error = *mvs_last_error();
  return outcome;
}

void must(const Outcome &outcome) {
  if (outcome.result == MVS_OK) return;
  raise(outcome.result, outcome.error.message, outcome.error.part, outcome.error.line);
}

void refuse(mvs_result code, const std::string &part, const std::string &sentence) {
  raise(code, sentence.c_str(), part.c_str(), 0);
}

void refuse_no_function(const py::object &given, const std::string &part) {
  if (!given || given.is_none() || PyCallable_Check(given.ptr()) != 0) return;
  refuse(MVS_E_ARGUMENT, part,
         part + ": a function or None is needed, not " + std::string(py::repr(given)));
}

std::string text_of(const py::handle &value, const std::string &part) {
  try {
    return value.cast<std::string>();
  } catch (const py::cast_error &) {
    refuse(MVS_E_ARGUMENT, part,
           part + ": a text in Unicode is needed, not " + std::string(py::repr(value)));
  }
}

const char *c_text(const std::string &text, const std::string &part) {
  if (text.find('\0') == std::string::npos) return text.c_str();
  refuse(MVS_E_ARGUMENT, part, part + ": a text without zero bytes is needed");
}

void warn(const char *sentence) {
  const py::object category = py::module_::import("mvs.errors").attr("ValveWarning");
  // the line of the caller of the method: the first frame is the wrapper in mvs/arguments.py
  if (PyErr_WarnEx(category.ptr(), sentence, 2) != 0) throw py::error_already_set();
}

int32_t report_progress(const py::object &progress, double share, double residual,
                        std::exception_ptr &raised) {
  try {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!progress || progress.is_none()) return 0;
    return py::bool_(progress(share, residual)) ? 1 : 0;
  } catch (...) {
    raised = std::current_exception();
    return 1;
  }
}

bool SignalWatch::interrupted(std::exception_ptr &raised) {
  const Clock::time_point now = Clock::now();
  if (now - looked_ < std::chrono::milliseconds(50)) return false;
  looked_ = now;
  const py::gil_scoped_acquire held;
  return report_progress(py::none(), 0, 0, raised) != 0;
}

}  // namespace mvs_python
