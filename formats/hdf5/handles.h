// RAII handles of HDF5, and its errors as mvs errors.
#pragma once

#include <hdf5.h>

#include <mutex>
#include <string>
#include <utility>

#include "base/error.h"

namespace mvs::core::h5 {

// The name of a file in memory. The core driver looks for a file of that name: it refuses to read
// an image beside one, and reads the other one before it writes. No file can have this path.
inline constexpr const char *name_of_image = "/dev/null/mvs";

// Closes its handle with the function of its kind.
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
  // Closes now; returns a negative value on failure, as HDF5 does.
  herr_t close_now() { return close(std::exchange(id_, H5I_INVALID_HID)); }

 private:
  hid_t id_ = H5I_INVALID_HID;
};
using File = Handle<H5Fclose>;
using GroupHandle = Handle<H5Gclose>;
using Object = Handle<H5Oclose>;
using Dataset = Handle<H5Dclose>;
using Attribute = Handle<H5Aclose>;
using Space = Handle<H5Sclose>;
using Type = Handle<H5Tclose>;
using List = Handle<H5Pclose>;

// Exclusive use of HDF5: holds a lock, because HDF5 may be built without thread safety, and
// replaces the host's error handler until destruction. Refuses an HDF5 library of another version
// than its headers, on which HDF5 itself would abort the program.
class ExclusiveUse {
 public:
  ExclusiveUse();
  ExclusiveUse(const ExclusiveUse &) = delete;
  ExclusiveUse &operator=(const ExclusiveUse &) = delete;
  ~ExclusiveUse();

 private:
  std::lock_guard<std::mutex> alone_;
  H5E_auto2_t handler_ = nullptr;
  void *handler_data_ = nullptr;
};

// Throws `code`, or MVS_E_MEMORY if HDF5 lacks memory, with HDF5's message at the end.
[[noreturn]] void fail_h5(mvs_result code, const std::string &part, const char *doing);

// Throws on a negative result of a call that writes or reads. The message is built only then.
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
