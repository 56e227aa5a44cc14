// A tree of named arrays as an HDF5 file in memory, and back.
//
// The writer uses contiguous arrays, no filters, chunks or times, and links only to groups and
// arrays; equal trees give equal bytes. The reader accepts files from any source: it checks the
// envelope first, and then each object before HDF5 reads its values. (A checksum detects accidents,
// not malice: a file made to crash HDF5 can have a valid one.)
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "formats/hdf5/envelope.h"

namespace mvs::core {

// The element type of the array in the file, which is little-endian. Texts end at their first zero
// byte; they are for other programs, and the reader refuses them.
using H5Values = std::variant<std::vector<double>, std::vector<uint64_t>, std::vector<int64_t>,
                              std::vector<uint32_t>, std::vector<int32_t>, std::vector<uint8_t>,
                              std::vector<std::string>>;

struct H5Array {
  H5Values values;
  uint32_t columns = 0;  // 0: one dimension; otherwise the length of a row
};

// Numbers, or a text if `numbers` is empty. Attributes are for other programs and are not read
// back.
struct H5Attribute {
  std::string text;
  std::vector<int64_t> numbers = {};
};

struct H5Tree {
  std::map<std::string, H5Array> arrays;  // by path, "mvs/numbers/ends"; paths define the groups
  std::map<std::pair<std::string, std::string>, H5Attribute> attributes;  // of a group, by name

  // Returns the values of an array; throws MVS_E_FORMAT unless it exists with this type and shape.
  template <typename Value>
  const std::vector<Value> &at(const std::string &path, uint32_t columns = 0) const {
    const auto *values = std::get_if<std::vector<Value>>(&found(path, columns).values);
    return values ? *values : wrong_type<Value>(path);
  }

 private:
  const H5Array &found(const std::string &path, uint32_t columns) const;
  [[noreturn]] static void refuse_type(const std::string &path);
  template <typename Value>
  static const std::vector<Value> &wrong_type(const std::string &path) {
    refuse_type(path);
  }
};

// Returns the whole file with its envelope. MVS_E_UNSUPPORTED in a build without HDF5.
std::string write_h5(const H5Tree &tree, uint32_t version);

// Reads the arrays of one group of the root, with paths "group/...". A file of another version is
// refused with MVS_E_VERSION.
H5Tree read_h5(std::string_view bytes, const std::string &group, uint32_t version);

}  // namespace mvs::core
