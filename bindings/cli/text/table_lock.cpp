#include "text/table_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "text/output_file.h"
#include "valve/host.h"

namespace cli {
namespace {

using Status = struct stat;

constexpr int patience = 10;  // tries; processes of a killed sweep end within milliseconds
constexpr useconds_t pause = 50000;

// Opens the table, and says whether it was created.
int open_table(const OutputTarget &target, bool &created) {
  constexpr int flags = O_RDWR | O_CLOEXEC;
  int file = ::open(target.file.c_str(), flags | O_CREAT | O_EXCL, 0666);
  created = file >= 0;
  if (file < 0 && errno == EEXIST) file = ::open(target.file.c_str(), flags);
  return file;
}

// Whether the path still names the open file, which a program that ended in between may have
// replaced.
bool is_current(int file, const std::string &path) {
  Status opened, named;
  return ::fstat(file, &opened) == 0 && ::stat(path.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

}  // namespace

// A file system without locks is used without them.
TableLock::TableLock(const std::string &path) {
  const OutputTarget target = output_target(path, "csv");
  for (int k = 0; k < patience; ++k) {
    bool created = false;
    const int file = open_table(target, created);
    if (file < 0) fail_to_write(path, "csv", "open", target.file, errno);
    const bool is_locked = ::flock(file, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
    if (is_locked && is_current(file, target.file)) {
      file_ = file;
      if (created) created_ = target.file;
      return;
    }
    ::close(file);
    if (!is_locked) ::usleep(pause);
  }
  fail(MVS_E_STATE, "csv",
       path + ": another sweep writes to it: wait for its end, or give the name of another file");
}

TableLock::~TableLock() {
  if (!created_.empty()) ::unlink(created_.c_str());
  if (file_ >= 0) ::close(file_);
}

void TableLock::take_over(int file) {
  const int own = ::fcntl(file, F_DUPFD_CLOEXEC, 0);
  if (own < 0) return;
  ::flock(own, LOCK_EX | LOCK_NB);
  ::close(file_);
  file_ = own;
}

}  // namespace cli
