// Sentences and remedies of system errors; folders that are synced.
#include "formats/file/posix_file.h"

#include <fcntl.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "base/error.h"
#include "base/utf8.h"

namespace mvs::core {

namespace {

const char *remedy_of(int error) {
  switch (error) {
    case EISDIR:
      return "; give the name of a file";
    case ENOENT:
    case ENOTDIR:
      return "; create the folder first";
    case EACCES:
    case EPERM:
    case EROFS:
      return "; choose another folder, or get the right to write there (chmod, chown)";
    case ELOOP:
      return "; remove the link, which leads back to itself";
    case ENOSPC:
    case EDQUOT:
      return "; free space on the disk";
    default:
      return "";
  }
}

// errno is a number of the generic category, not of the system's
std::string reason_of(int error) {
  return std::generic_category().message(error);
}

}  // namespace

std::string shown_path(const std::string &path) {
  constexpr size_t longest = 140;
  return without_middle(path, longest);
}

void fail_io(const char *verb, const std::string &what, int error, const char *part) {
  fail(MVS_E_IO, part, "cannot %s %s: %s", verb, shown_path(what).c_str(),
       reason_of(error).c_str());
}

void fail_to_write(const char *verb, const std::string &what, int error) {
  fail(MVS_E_IO, "", "cannot %s %s: %s%s", verb, shown_path(what).c_str(), reason_of(error).c_str(),
       remedy_of(error));
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
