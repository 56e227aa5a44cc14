// What whole files and the journal share: descriptors, folders, failures of the system.
#pragma once

#include <unistd.h>

#include <string>
#include <utility>

namespace mvs::core {

// A file descriptor that closes itself; -1 for none.
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
  // Closes now and says whether that went well: some file systems report a full disk only here.
  bool close() { return number_ < 0 || ::close(std::exchange(number_, -1)) == 0; }

 private:
  int number_;
};

// Throws MVS_E_IO, "cannot VERB WHAT: the system's reason".
[[noreturn]] void fail_io(const char *verb, const std::string &what, int error,
                          const char *part = "");

// The folder that a file is in.
std::string folder_of(const std::string &path);

// Brings the names in a folder to the disk. Some file systems cannot, and say so by EINVAL: nothing
// is to be done about that.
void sync_folder(const std::string &folder);

}  // namespace mvs::core
