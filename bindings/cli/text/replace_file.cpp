// Atomic replacement of a file, in the order that survives a crash: create a new file beside the
// target, flush its bytes, rename it over the target, flush the folder.
#include "text/replace_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>

#include "text/output_file.h"

namespace cli {
namespace {

void sync_folder(const std::string &folder) {
  const int opened = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (opened < 0) return;
  ::fsync(opened);  // some file systems cannot; the file is whole all the same
  ::close(opened);
}

}  // namespace

int write_bytes(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes.remove_prefix(static_cast<size_t>(written));
  }
  return 0;
}

int open_new(const std::string &folder, std::string &name) {
  constexpr int tries = 1000;
  for (int k = 0; k < tries; ++k) {
    name = folder + "/.mvs-" + std::to_string(::getpid()) + "-" + std::to_string(k) + ".tmp";
    const int file = ::open(name.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file >= 0 || errno != EEXIST) return file;
  }
  return -1;
}

void replace_file(const std::string &path, const std::string &bytes, const std::string &part,
                  const std::function<void(int)> &before_rename) {
  const OutputTarget target = output_target(path, part);
  std::string beside;
  const int file = open_new(target.folder, beside);
  if (file < 0) fail_to_write(path, part, "write into folder", target.folder, errno);
  int error = write_bytes(file, bytes);
  if (error == 0 && ::fsync(file) != 0) error = errno;
  if (error == 0 && target.mode && ::fchmod(file, *target.mode) != 0) error = errno;
  if (error == 0 && before_rename) before_rename(file);
  if (::close(file) != 0 && error == 0) error = errno;
  if (error == 0 && std::rename(beside.c_str(), target.file.c_str()) != 0) error = errno;
  if (error == 0) return sync_folder(target.folder);
  ::unlink(beside.c_str());
  fail_to_write(path, part, "write", target.file, error);
}

}  // namespace cli
