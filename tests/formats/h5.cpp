// The container of HDF5 files: exact, deterministic, and every damage is detected.
#ifdef MVS_HAVE_HDF5
#include <hdf5.h>

#include <doctest/doctest.h>
#include <algorithm>
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "formats/formats.h"
#include "formats/hdf5/tree.h"
#include "tests/formats/h5_outcome.h"

using namespace mvs::core;

namespace {

H5Tree with_other_groups() {
  H5Tree tree = every_type();
  tree.arrays["other/names"] = {std::vector<std::string>{"A", "", "a longer name"}};
  tree.arrays["other/i32"] = {std::vector<int32_t>{1, 2}};
  tree.attributes[{"other", "Type"}] = {"PolyData"};
  tree.attributes[{"other/deep", "numbers"}] = {"", {2, -1}};
  return tree;
}

// Equal to the bit: 0.0 differs from -0.0, and NaN equals NaN.
bool same(const H5Array &a, const H5Array &b) {
  if (a.columns != b.columns || a.values.index() != b.values.index()) return false;
  return std::visit(
      [&](const auto &values) {
        const auto &others = std::get<std::decay_t<decltype(values)>>(b.values);
        if constexpr (std::is_same_v<std::decay_t<decltype(values)>, std::vector<double>>) {
          return std::equal(values.begin(), values.end(), others.begin(), others.end(),
                            [](double x, double y) {
                              return std::bit_cast<uint64_t>(x) == std::bit_cast<uint64_t>(y);
                            });
        } else {
          return values == others;
        }
      },
      a.values);
}

}  // namespace

TEST_CASE("an_hdf5_tree_is_read_back_to_the_bit") {
  const H5Tree tree = every_type();
  const H5Tree found = read_h5(write_h5(with_other_groups(), 7), "mvs", 7);
  CHECK(found.arrays.size() == tree.arrays.size());
  for (const auto &entry : tree.arrays) {
    CAPTURE(entry.first);
    REQUIRE(found.arrays.count(entry.first) == 1);
    CHECK(same(found.arrays.at(entry.first), entry.second));
  }
  CHECK(found.at<double>("mvs/x", 3).size() == 6);
  CHECK_THROWS_WITH(found.at<double>("mvs/y"), "the file has no array mvs/y");
  CHECK_THROWS_WITH(found.at<double>("mvs/x"),
                    "array mvs/x of the file has rows of 3, where 0 is needed");
  CHECK_THROWS_WITH(found.at<uint32_t>("mvs/x", 3),
                    "array mvs/x of the file has another type than it should");
}

TEST_CASE("equal_trees_give_equal_bytes") {
  const std::string first = write_h5(with_other_groups(), 1);
  // uninitialised memory must not get into the file
  for (const char used : {'a', 'b'}) {
    std::vector<std::string> blocks;
    for (size_t size = 16; size < size_t{1} << 22; size += size / 3)
      blocks.emplace_back(size, used);
    blocks.clear();
    CHECK(write_h5(with_other_groups(), 1) == first);
  }
  CHECK(write_h5(with_other_groups(), 2) != first);
}

// Files contain neither B-trees nor heaps, the parts of HDF5 with most of its defects.
TEST_CASE("a_file_has_no_trees_and_no_heaps") {
  H5Tree tree = every_type();
  for (int k = 0; k < 300; ++k) {
    tree.arrays["mvs/many/" + std::to_string(k)] = {std::vector<uint32_t>{7}};
  }
  const std::string bytes = write_h5(tree, 1);
  CHECK(outcome(bytes).code == MVS_OK);
  for (const char *begin : {"TREE", "BTHD", "BTLF", "HEAP", "FRHP", "GCOL", "SNOD", "FAHD"}) {
    CAPTURE(begin);
    CHECK(bytes.find(begin) == std::string::npos);
  }
}

TEST_CASE("hdf5_errors_are_returned_and_do_not_reach_the_hosts_handler") {
  const auto count = [](hid_t, void *told) {
    ++*static_cast<int *>(told);
    return 0;
  };
  int told = 0;
  H5E_auto2_t before = nullptr;
  void *data_before = nullptr;
  H5Eget_auto2(H5E_DEFAULT, &before, &data_before);
  H5Eset_auto2(H5E_DEFAULT, count, &told);
  std::string bytes(2000, '\0');
  seal(bytes, 1);
  CHECK(refused(outcome(bytes), MVS_E_FORMAT, "file signature not found"));
  CHECK(told == 0);
  // the host's handler is restored
  CHECK(H5Fclose(-1) < 0);
  CHECK(told == 1);
  H5Eset_auto2(H5E_DEFAULT, before, data_before);
}

TEST_CASE("an_hdf5_file_cut_anywhere_is_refused") {
  const std::string bytes = write_h5(every_type(), 1);
  CHECK(outcome(bytes).code == MVS_OK);
  for (size_t size = 0; size < bytes.size(); ++size) {
    CAPTURE(size);
    const Outcome found = outcome(std::string_view(bytes).substr(0, size));
    CHECK(found.code == MVS_E_FORMAT);
    CHECK(found.sentence.find(size < 8 ? "" : "cut") != std::string::npos);
  }
  CHECK(refused(outcome(bytes + "x"), MVS_E_FORMAT, "longer than it should be, by 1 bytes"));
}

TEST_CASE("any_changed_byte_of_an_hdf5_file_is_detected") {
  std::string bytes = write_h5(every_type(), 1);
  for (char &byte : bytes) {
    const char before = byte;
    for (const int change : {1, 128, 255}) {
      byte = static_cast<char>(before ^ change);
      CHECK(outcome(bytes).code == MVS_E_FORMAT);
    }
    byte = before;
  }
  CHECK(outcome(bytes).code == MVS_OK);
}

TEST_CASE("an_hdf5_file_of_another_version_is_refused_with_that_reason") {
  const std::string newer = write_h5(every_type(), 2);
  CHECK(outcome(newer, 2).code == MVS_OK);
  CHECK(refused(outcome(newer, 3), MVS_E_VERSION, "has version 2, this libmvs reads version 3"));
  CHECK(refused(outcome(newer, 1), MVS_E_VERSION, "has version 2, this libmvs reads version 1"));
  CHECK(refused(outcome(write_h5(every_type(), 0)), MVS_E_VERSION, "version 0"));
}
#else
#include <doctest/doctest.h>

#include "base/error.h"
#include "formats/hdf5/tree.h"

TEST_CASE("a_build_without_hdf5_reports_it") {
  const char *const sentence =
      "this libmvs was built without HDF5: use OBJ, or build it with -DMVS_HDF5=ON";
  CHECK_THROWS_WITH_AS(mvs::core::write_h5({}, 1), sentence, mvs::core::Error);
  CHECK_THROWS_WITH_AS(mvs::core::read_h5("", "mvs", 1), sentence, mvs::core::Error);
}
#endif
