// Atomic replacement of files, in the order that survives a crash: create a new file beside the
// target, flush its bytes, rename it over the target, flush the folder. Rename alone may leave an
// empty file after a power loss.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <deque>
#include <memory>

#include "base/error.h"
#include "formats/file/posix_file.h"
#include "formats/formats.h"

namespace mvs::core {
namespace {

using Status = struct stat;

// Creates a file with a new name in `folder` (O_EXCL), with the mode of the umask.
int open_new(const std::string &folder, std::string &path) {
  constexpr int tries = 1000;
  for (int k = 0; k < tries; ++k) {
    path = folder + "/.mvs-" + std::to_string(::getpid()) + "-" + std::to_string(k) + ".tmp";
    const int number = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (number >= 0) return number;
    if (errno != EEXIST) fail_to_write("write into folder", folder, errno);
  }
  fail_to_write("find a new name in folder", folder, EEXIST);
}

void write_all(const Descriptor &file, std::string_view bytes, const std::string &target) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file.number(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail_to_write("write", target, errno);
    bytes.remove_prefix(static_cast<size_t>(written));
  }
}

// Resolves links, so that the target is replaced and the link stays. realpath() resolves those to a
// file that exists, readlink() those to a new one.
std::string follow_links(std::string path) {
  constexpr int most_links = 40;  // as Linux
  for (int k = 0; k < most_links; ++k) {
    const std::unique_ptr<char, decltype(&std::free)> found(::realpath(path.c_str(), nullptr),
                                                            &std::free);
    if (found) return found.get();
    if (errno == ELOOP) break;
    char target[4096];
    const ssize_t length = ::readlink(path.c_str(), target, sizeof target);
    if (length < 0) return path;
    const std::string_view next(target, static_cast<size_t>(length));
    path = next.starts_with('/') ? std::string(next) : folder_of(path) + "/" + std::string(next);
  }
  fail_to_write("write", path, ELOOP);
}

// Returns whether a file exists that is to be replaced, and its status.
bool find_old(const std::string &target, Status &old) {
  if (::stat(target.c_str(), &old) != 0) return false;
  if (S_ISDIR(old.st_mode)) fail_to_write("write", target, EISDIR);
  MVS_MUST(S_ISREG(old.st_mode), MVS_E_IO, "", "cannot write %s: it is a device or pipe, no file",
           shown_path(target).c_str());
  if (::access(target.c_str(), W_OK) != 0) fail_to_write("write", target, errno);
  return true;
}

// A whole new file beside its target. Removed with this object unless it took the target's place.
class Replacement {
 public:
  Replacement(const std::string &path, std::string_view bytes) : Replacement(path) {
    Status old;
    const bool replaces = find_old(target_, old);
    Descriptor file(open_new(folder_, path_));
    write_all(file, bytes, target_);
    if (replaces && ::fchmod(file.number(), old.st_mode & 07777) != 0) {
      fail_to_write("keep the mode of", target_, errno);
    }
    if (::fsync(file.number()) != 0) fail_to_write("write", target_, errno);
    if (!file.close()) fail_to_write("write", target_, errno);
  }
  Replacement(const Replacement &) = delete;
  Replacement &operator=(const Replacement &) = delete;
  ~Replacement() {
    if (!path_.empty()) ::unlink(path_.c_str());
  }
  void take_place() {
    if (::rename(path_.c_str(), target_.c_str()) != 0) fail_to_write("replace", target_, errno);
    path_.clear();
    sync_folder(folder_);
  }

 private:
  // A constructor that delegates to this one and then fails runs the destructor.
  explicit Replacement(const std::string &path)
      : target_(follow_links(path)), folder_(folder_of(target_)) {}

  std::string target_, folder_;
  std::string path_;  // of the new file; empty without one
};

// Returns the initial buffer size; fails for a folder or a file that is too large.
size_t size_to_read(const Descriptor &file, const std::string &path, size_t limit) {
  Status status;
  if (::fstat(file.number(), &status) != 0) fail_io("read", path, errno);
  if (S_ISDIR(status.st_mode)) fail_io("read", path, EISDIR);
  MVS_MUST(S_ISREG(status.st_mode) || S_ISFIFO(status.st_mode), MVS_E_IO, "",
           "cannot read %s: it is a device, no file", shown_path(path).c_str());
  const auto size = static_cast<uint64_t>(std::max<off_t>(status.st_size, 0));
  MVS_MUST(size <= limit, MVS_E_MEMORY, "", "%s has %llu bytes, the limit is %zu",
           shown_path(path).c_str(), static_cast<unsigned long long>(size), limit);
  return static_cast<size_t>(size);
}

}  // namespace

std::string read_whole_file(const std::string &path, size_t limit) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.number() < 0) fail_io("open", path, errno);
  constexpr size_t least = 64 * 1024;
  std::string bytes(std::max(size_to_read(file, path, limit) + 1, least), '\0');
  for (size_t filled = 0;;) {
    const ssize_t got = ::read(file.number(), bytes.data() + filled, bytes.size() - filled);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail_io("read", path, errno);
    filled += static_cast<size_t>(got);
    MVS_MUST(filled <= limit, MVS_E_MEMORY, "", "%s has more than %zu bytes, the limit",
             shown_path(path).c_str(), limit);
    if (got == 0) {
      bytes.resize(filled);
      return bytes;
    }
    if (filled == bytes.size()) bytes.resize(2 * bytes.size());
  }
}

bool make_folder(const std::string &path) {
  Status found;
  if (::mkdir(path.c_str(), 0777) == 0) return true;
  const int error = errno;
  if (error == EEXIST && ::stat(path.c_str(), &found) == 0 && S_ISDIR(found.st_mode)) return false;
  fail_to_write("create folder", path, error);
}

void remove_empty_folder(const std::string &path) {
  ::rmdir(path.c_str());
}

void write_whole_file(const std::string &path, std::string_view bytes) {
  Replacement(path, bytes).take_place();
}

void write_whole_files(const std::vector<NamedFile> &files, const std::string &folder) {
  std::deque<Replacement> all;
  for (const NamedFile &file : files) all.emplace_back(folder + file.path, file.bytes);
  for (Replacement &one : all) one.take_place();
}

}  // namespace mvs::core
