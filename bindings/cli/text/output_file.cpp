#include "text/output_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <memory>
#include <system_error>

#include "valve/host.h"

namespace cli {
namespace {

using Status = struct stat;

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

std::string folder_of(const std::string &path) {
  const size_t slash = path.rfind('/');
  return slash == std::string::npos ? "." : path.substr(0, std::max<size_t>(slash, 1));
}

// realpath() resolves links to a file that exists, readlink() those to a new one.
std::string follow_links(const std::string &path, const std::string &part) {
  constexpr int most_links = 40;  // as Linux
  std::string file = path;
  for (int k = 0; k < most_links; ++k) {
    const std::unique_ptr<char, decltype(&std::free)> found(::realpath(file.c_str(), nullptr),
                                                            &std::free);
    if (found) return found.get();
    if (errno == ELOOP) break;
    char target[4096];
    const ssize_t length = ::readlink(file.c_str(), target, sizeof target);
    if (length < 0) return file;
    const std::string next(target, static_cast<size_t>(length));
    file = next.starts_with('/') ? next : folder_of(file) + "/" + next;
  }
  fail_to_write(path, part, "write", file, ELOOP);
}

}  // namespace

void fail_to_write(const std::string &path, const std::string &part, const std::string &verb,
                   const std::string &what, int error) {
  fail(MVS_E_IO, part,
       path + ": cannot " + verb + " " + (what == path ? "it" : what) + ": " +
           std::generic_category().message(error) + remedy_of(error));
}

OutputTarget output_target(const std::string &path, const std::string &part) {
  OutputTarget target;
  target.file = follow_links(path, part);
  target.folder = folder_of(target.file);
  Status old;
  if (::stat(target.file.c_str(), &old) != 0) return target;
  if (S_ISDIR(old.st_mode)) fail_to_write(path, part, "write", target.file, EISDIR);
  if (!S_ISREG(old.st_mode)) {
    fail(MVS_E_IO, part,
         path + ": cannot write " + target.file + ": it is a device or pipe, no file");
  }
  if (::access(target.file.c_str(), W_OK) != 0) {
    fail_to_write(path, part, "write", target.file, errno);
  }
  target.mode = old.st_mode & 07777;
  return target;
}

}  // namespace cli
