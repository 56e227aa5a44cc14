#include "formats/file/posix_file.h"

#include <fcntl.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "base/error.h"

namespace mvs::core {

void fail_io(const char *verb, const std::string &what, int error, const char *part) {
  fail(MVS_E_IO, part, "cannot %s %s: %s", verb, what.c_str(),
       std::system_category().message(error).c_str());
}

std::string folder_of(const std::string &path) {
  const size_t slash = path.rfind('/');
  return slash == std::string::npos ? "." : path.substr(0, std::max<size_t>(slash, 1));
}

void sync_folder(const std::string &folder) {
  const Descriptor opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (opened.number() < 0) return;
  if (::fsync(opened.number()) != 0 && errno != EINVAL) fail_io("sync folder", folder, errno);
}

}  // namespace mvs::core
