// HDF5's handles as objects, and its errors as ours.
#pragma once

#include <hdf5.h>

#include <mutex>
#include <string>
#include <utility>

#include "base/error.h"

namespace mvs::core::h5 {

// Closes its handle by the function of its kind.
template <herr_t (*close)(hid_t)>
class Handle {
 public:
  Handle() = default;
  explicit Handle(hid_t id) : id_(id) {}
  Handle(Handle &&other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)) {}
  Handle &operator=(Handle other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  ~Handle() {
    if (id_ >= 0) close(id_);
  }
  hid_t id() const { return id_; }
  // Closes now; negative if that fails, as all HDF5 calls.
  herr_t close_now() { return close(std::exchange(id_, H5I_INVALID_HID)); }

 private:
  hid_t id_ = H5I_INVALID_HID;
};
using File = Handle<H5Fclose>;
using Group = Handle<H5Gclose>;
using Object = Handle<H5Oclose>;
using Dataset = Handle<H5Dclose>;
using Attribute = Handle<H5Aclose>;
using Space = Handle<H5Sclose>;
using Type = Handle<H5Tclose>;
using List = Handle<H5Pclose>;

// One conversation with HDF5: alone, because not every HDF5 is built for threads; and silent, with
// the host's own handler of HDF5 errors back at the end. Refuses to begin where the HDF5 found at
// run time is not that of the headers: HDF5 itself would abort the program.
class Conversation {
 public:
  Conversation();
  Conversation(const Conversation &) = delete;
  Conversation &operator=(const Conversation &) = delete;
  ~Conversation();

 private:
  std::lock_guard<std::mutex> alone_;
  H5E_auto2_t handler_ = nullptr;
  void *handler_data_ = nullptr;
};

// Throws `code`, or MVS_E_MEMORY where that is what HDF5 lacks, with HDF5's own words at the end.
[[noreturn]] void fail_h5(mvs_result code, const std::string &part, const char *doing);

// Turns a negative result into a failure of writing or reading; nothing is looked up if it is none.
template <typename Result>
Result wrote(Result result, const std::string &part) {
  if (result < 0) fail_h5(MVS_E_INTERNAL, part, "make");
  return result;
}
template <typename Result>
Result read(Result result, const std::string &part) {
  if (result < 0) fail_h5(MVS_E_FORMAT, part, "read");
  return result;
}

}  // namespace mvs::core::h5
