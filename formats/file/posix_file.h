// POSIX descriptors, folders and system errors, shared by whole files and the journal.
#pragma once

#include <unistd.h>

#include <string>
#include <utility>

namespace mvs::core {

// A file descriptor with automatic close; -1 if empty.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor &&other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor &operator=(Descriptor &&other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor() { close(); }
  int number() const { return number_; }
  // Closes now and returns whether that succeeded: some file systems report a full disk only here.
  bool close() { return number_ < 0 || ::close(std::exchange(number_, -1)) == 0; }

 private:
  int number_;
};

// A path for a sentence: without the middle of a long one, so that the reason after it is not cut.
std::string shown_path(const std::string &path);

// Throws MVS_E_IO, "cannot VERB WHAT: the system's reason"; `error` is errno.
[[noreturn]] void fail_io(const char *verb, const std::string &what, int error,
                          const char *part = "");

// The same for a file that is written; the sentence ends with the remedy where one is known.
[[noreturn]] void fail_to_write(const char *verb, const std::string &what, int error);

// Returns the folder of a file.
std::string folder_of(const std::string &path);

// Flushes the names of a folder to the disk. Some file systems do not support it and return EINVAL,
// which is ignored.
void sync_folder(const std::string &folder);

}  // namespace mvs::core
