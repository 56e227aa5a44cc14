#ifdef MVS_HAVE_HDF5
#include "formats/hdf5/handles.h"

#include <cstdio>

#include "base/error.h"

namespace mvs::core::h5 {
namespace {

// Serialises all HDF5 calls of libmvs in the process.
std::mutex &one_at_a_time() {
  static std::mutex mutex;
  return mutex;
}

// The innermost error message of HDF5.
struct H5Message {
  char text[160] = "no reason given";
  bool out_of_memory = false;
};

herr_t store_message(unsigned number, const H5E_error2_t *error, void *message_to) {
  H5Message &message = *static_cast<H5Message *>(message_to);
  if (number == 0 && error->desc)
    std::snprintf(message.text, sizeof message.text, "%s", error->desc);
  message.out_of_memory = message.out_of_memory || error->maj_num == H5E_RESOURCE;
  return 0;
}

}  // namespace

ExclusiveUse::ExclusiveUse() : alone_(one_at_a_time()) {
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  MVS_MUST(major == H5_VERS_MAJOR && minor == H5_VERS_MINOR && release == H5_VERS_RELEASE,
           MVS_E_UNSUPPORTED, "HDF5",
           "libmvs was built for HDF5 %d.%d.%d and finds %u.%u.%u: build it again, or bring that "
           "HDF5 back",
           H5_VERS_MAJOR, H5_VERS_MINOR, H5_VERS_RELEASE, major, minor, release);
  H5Eget_auto2(H5E_DEFAULT, &handler_, &handler_data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

ExclusiveUse::~ExclusiveUse() {
  H5Eclear2(H5E_DEFAULT);
  H5Eset_auto2(H5E_DEFAULT, handler_, handler_data_);
}

void fail_h5(mvs_result code, const std::string &part, const char *doing) {
  H5Message message;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, store_message, &message);
  fail(message.out_of_memory ? MVS_E_MEMORY : code, part, "HDF5 cannot %s %s of the file: %s",
       doing, part.c_str(), message.text);
}

}  // namespace mvs::core::h5
#endif
