// The last failure of each thread; version and features of the library.
#include <mvs/base.h>

#include <array>
#include <cstdio>

#include "api/exception_boundary.h"
#include "base/utf8.h"
#include "formats/file/posix_file.h"
#include "linalg/direct_solver.h"

namespace {

thread_local mvs_error last_error = {};

constexpr char optional_parts[] =
#ifdef MVS_HAVE_HDF5
    " hdf5"
#endif
#ifdef MVS_HAVE_ZLIB
    " zlib"
#endif
#ifdef MVS_HAVE_HAPTICS
    " haptics"
#endif
    "";

}  // namespace

namespace mvs::core {

mvs_result record_failure(mvs_result code, int32_t line, const char *part,
                          const char *message) noexcept {
  last_error.code = code;
  last_error.line = line;
  copy_text(last_error.part, part);
  copy_text(last_error.message, message);
  return code;
}

Error about_file(const Error &error, const std::string &path) {
  if (path.empty()) return error;
  std::string where = shown_path(path), sentence = error.what();
  // "cannot open a.obj: ..." becomes "a.obj: cannot open it: ...": the path stands once
  const size_t at = sentence.find(" " + where);
  if (at != std::string::npos && sentence.find_first_of(": ", at + 1) == at + 1 + where.size()) {
    sentence.replace(at + 1, where.size(), "it");
  }
  if (error.line > 0) where += ":" + std::to_string(error.line);
  return {error.code, error.part, where + ": " + sentence, error.line};
}

}  // namespace mvs::core

extern "C" {

const mvs_error *mvs_last_error(void) {
  return &last_error;
}

const char *mvs_result_name(mvs_result code) {
  switch (code) {
    case MVS_OK:
      return "MVS_OK";
    case MVS_E_ARGUMENT:
      return "MVS_E_ARGUMENT";
    case MVS_E_ID:
      return "MVS_E_ID";
    case MVS_E_STATE:
      return "MVS_E_STATE";
    case MVS_E_OP:
      return "MVS_E_OP";
    case MVS_E_DIVERGED:
      return "MVS_E_DIVERGED";
    case MVS_E_FORMAT:
      return "MVS_E_FORMAT";
    case MVS_E_VERSION:
      return "MVS_E_VERSION";
    case MVS_E_IO:
      return "MVS_E_IO";
    case MVS_E_DEVICE:
      return "MVS_E_DEVICE";
    case MVS_E_MEMORY:
      return "MVS_E_MEMORY";
    case MVS_E_UNSUPPORTED:
      return "MVS_E_UNSUPPORTED";
    case MVS_E_INTERNAL:
      return "MVS_E_INTERNAL";
    case MVS_E_CANCELLED:
      return "MVS_E_CANCELLED";
    default:
      return "MVS_E_UNKNOWN";
  }
}

uint32_t mvs_version(void) {
  return 10000 * MVS_VERSION_MAJOR + 100 * MVS_VERSION_MINOR + MVS_VERSION_PATCH;
}

const char *mvs_features(void) {
  static const auto names = [] {
    std::array<char, 64> text;
    std::snprintf(text.data(), text.size(), "%s%s", mvs::core::factor_names(), optional_parts);
    return text;
  }();
  return names.data();
}

}  // extern "C"
