// Fixture: an HDF5 tree with an array of every type, and the error with which a file is refused.
#pragma once

#include <hdf5.h>

#include <doctest/doctest.h>
#include <bit>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "formats/hdf5/tree.h"

namespace mvs::core {

inline H5Tree every_type() {
  H5Tree tree;
  const double odd[] = {-0.0, std::numeric_limits<double>::denorm_min(),
                        -std::numeric_limits<double>::infinity(),
                        std::bit_cast<double>(0x7ff8000000000123u)};
  tree.arrays["mvs/x"] = {std::vector<double>{0.1, 1e300, -2.5, odd[0], odd[1], odd[2]}, 3};
  tree.arrays["mvs/nan"] = {std::vector<double>{odd[3]}};
  tree.arrays["mvs/in/a/u64"] = {std::vector<uint64_t>{0, UINT64_MAX, 1}};
  tree.arrays["mvs/in/a/i64"] = {std::vector<int64_t>{INT64_MIN, -1, INT64_MAX}};
  tree.arrays["mvs/in/u32"] = {std::vector<uint32_t>{0, UINT32_MAX, 2, 3}, 2};
  tree.arrays["mvs/in/i32"] = {std::vector<int32_t>{INT32_MIN, 5}};
  tree.arrays["mvs/text"] = {std::vector<uint8_t>{'a', 0, 255}};
  tree.arrays["mvs/none"] = {std::vector<double>{}, 3};
  tree.arrays["mvs/nothing"] = {std::vector<uint8_t>{}};
  return tree;
}

// The code and sentence with which reading fails; MVS_OK and "" if it succeeds.
struct Outcome {
  mvs_result code = MVS_OK;
  std::string sentence;
};

inline Outcome outcome(std::string_view bytes, uint32_t version = 1) {
  Outcome made;
  try {
    read_h5(bytes, "mvs", version);
  } catch (const Error &error) {
    made = {error.code, error.what()};
  }
  CHECK(H5Fget_obj_count(H5F_OBJ_ALL, H5F_OBJ_ALL) == 0);
  return made;
}

inline bool refused(const Outcome &found, mvs_result code, const char *words) {
  CAPTURE(found.code);
  CAPTURE(found.sentence);
  CAPTURE(words);
  CHECK(found.code == code);
  CHECK(found.sentence.find(words) != std::string::npos);
  return found.code == code && found.sentence.find(words) != std::string::npos;
}

}  // namespace mvs::core
