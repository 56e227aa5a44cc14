// Access to arrays of a tree; stubs for builds without HDF5.
#include "formats/hdf5/tree.h"

#include "base/error.h"

namespace mvs::core {

const H5Array &H5Tree::found(const std::string &path, uint32_t columns) const {
  const auto place = arrays.find(path);
  MVS_MUST(place != arrays.end(), MVS_E_FORMAT, path, "the file has no array %s", path.c_str());
  MVS_MUST(place->second.columns == columns, MVS_E_FORMAT, path,
           "array %s of the file has rows of %u, where %u is needed", path.c_str(),
           place->second.columns, columns);
  return place->second;
}

void H5Tree::refuse_type(const std::string &path) {
  fail(MVS_E_FORMAT, path, "array %s of the file has another type than it should", path.c_str());
}

#ifndef MVS_HAVE_HDF5

namespace {

constexpr char without_hdf5[] =
    "this libmvs was built without HDF5: use OBJ, or build it with -DMVS_HDF5=ON";

}  // namespace

std::string write_h5(const H5Tree &, uint32_t) {
  fail(MVS_E_UNSUPPORTED, "format", without_hdf5);
}

H5Tree read_h5(std::string_view, const std::string &, uint32_t) {
  fail(MVS_E_UNSUPPORTED, "format", without_hdf5);
}

#endif

}  // namespace mvs::core
