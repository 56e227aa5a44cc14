// Exception boundary of the C interface: runs work and converts each exception to a result code and
// the last failure of the thread. No exception leaves the library.
#pragma once

#include <mvs/base.h>

#include <new>

#include "base/denormals.h"
#include "base/error.h"
#include "base/option_checks.h"

namespace mvs::core {

// Stores the last failure of this thread, and returns the code. Does not allocate.
mvs_result record_failure(mvs_result code, int32_t line, const char *part,
                          const char *message) noexcept;

// Returns the failure with the path of its file, unless that is empty, before its sentence.
Error about_file(const Error &error, const std::string &path);

// Runs `work`; converts an exception to a result code and the last failure. Whatever rounding or
// trapping the host has set, the work has the floating-point mode of a new process, so that the
// same input gives the same bits.
template <typename Work>
mvs_result at_boundary(Work &&work) noexcept {
  const FloatingPointMode::Scope mode{FloatingPointMode()};
  try {
    work();
    return MVS_OK;
  } catch (const Error &error) {
    return record_failure(error.code, error.line, error.part.c_str(), error.what());
  } catch (const std::bad_alloc &) {
    return record_failure(MVS_E_MEMORY, 0, "",
                          "out of memory: free some, or use a coarser valve; nothing was changed");
  } catch (const std::exception &error) {
    return record_failure(MVS_E_INTERNAL, 0, "", error.what());
  } catch (...) {
    return record_failure(MVS_E_INTERNAL, 0, "", "an unknown failure inside libmvs: report it");
  }
}

// The same for work on a file: the failure begins with "path: " or "path:line: ".
template <typename Work>
mvs_result file_at_boundary(const char *path, Work &&work) noexcept {
  return at_boundary([&] {
    try {
      work();
    } catch (const Error &error) {
      throw about_file(error, path);
    }
  });
}

}  // namespace mvs::core
