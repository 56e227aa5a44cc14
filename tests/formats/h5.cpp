// The container of HDF5 files: exact, deterministic, and every damage is detected.
#ifdef MVS_HAVE_HDF5
#include <hdf5.h>

#include <doctest/doctest.h>
#include <bit>
#include <cstring>
#include <functional>
#include <limits>

#include "base/error.h"
#include "formats/formats.h"
#include "formats/hdf5/tree.h"

using namespace mvs::core;

namespace {

H5Tree every_type() {
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

// The code and sentence with which reading fails; MVS_OK and "" if it succeeds.
struct Outcome {
  mvs_result code = MVS_OK;
  std::string sentence;
};

Outcome outcome(std::string_view bytes, uint32_t version = 1) {
  Outcome made;
  try {
    read_h5(bytes, "mvs", version);
  } catch (const Error &error) {
    made = {error.code, error.what()};
  }
  CHECK(H5Fget_obj_count(H5F_OBJ_ALL, H5F_OBJ_ALL) == 0);
  return made;
}

bool refused(const Outcome &found, mvs_result code, const char *words) {
  CAPTURE(found.code);
  CAPTURE(found.sentence);
  CAPTURE(words);
  CHECK(found.code == code);
  CHECK(found.sentence.find(words) != std::string::npos);
  return found.code == code && found.sentence.find(words) != std::string::npos;
}

// A file as another program might write it, with group mvs and a user block of `block` bytes.
std::string made_by_hand(const std::function<void(hid_t)> &fill, hsize_t block = envelope_bytes) {
  const char *const path = "made_by_hand.h5";
  const hid_t creation = H5Pcreate(H5P_FILE_CREATE);
  H5Pset_userblock(creation, block);
  const hid_t file = H5Fcreate(path, H5F_ACC_TRUNC, creation, H5P_DEFAULT);
  const hid_t group = H5Gcreate2(file, "mvs", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  fill(group);
  H5Gclose(group);
  H5Pclose(creation);
  CHECK(H5Fget_obj_count(file, H5F_OBJ_ALL) == 1);
  H5Fclose(file);
  std::string bytes = read_whole_file(path);
  std::remove(path);
  return bytes;
}

std::string sealed(const std::function<void(hid_t)> &fill) {
  std::string bytes = made_by_hand(fill);
  seal(bytes, 1);
  return bytes;
}

void add_array(
    hid_t group, const char *name, hid_t type, std::vector<hsize_t> shape,
    const std::function<void(hid_t)> &plan = [](hid_t) {}) {
  const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_alloc_time(creation, H5D_ALLOC_TIME_EARLY);
  plan(creation);
  const hid_t space = shape.empty()
                          ? H5Screate(H5S_SCALAR)
                          : H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
  const hid_t made = H5Dcreate2(group, name, type, space, H5P_DEFAULT, creation, H5P_DEFAULT);
  CHECK(made >= 0);
  H5Dclose(made);
  H5Sclose(space);
  H5Pclose(creation);
}

void add_doubles(
    hid_t group, std::vector<hsize_t> shape,
    const std::function<void(hid_t)> &plan = [](hid_t) {}) {
  add_array(group, "x", H5T_IEEE_F64LE, std::move(shape), plan);
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

TEST_CASE("a_foreign_file_is_refused_with_that_reason") {
  CHECK(refused(outcome(""), MVS_E_FORMAT, "the file is empty"));
  CHECK(refused(outcome("v 0 0 0\n"), MVS_E_FORMAT, "not an HDF5 file of libmvs"));
  std::string text_mode = write_h5(every_type(), 1);
  text_mode.erase(text_mode.find('\r'), 1);
  CHECK(refused(outcome(text_mode), MVS_E_FORMAT, "in binary mode"));
  for (const hsize_t block : {0, 512, 1024, 4096}) {
    const std::string other = made_by_hand([](hid_t) {}, block);
    CHECK(refused(outcome(other), MVS_E_FORMAT, "this HDF5 file is not one of libmvs"));
  }
}

// Structures that libmvs never writes are refused before HDF5 reads them, even under a valid
// checksum.
TEST_CASE("arrays_that_are_not_plain_are_refused") {
  const auto of = [](const std::function<void(hid_t)> &fill) { return outcome(sealed(fill)); };
  CHECK(of([](hid_t g) { add_doubles(g, {5, 3}); }).code == MVS_OK);
  const hsize_t chunk = 4;
  CHECK(refused(
      of([&](hid_t g) { add_doubles(g, {8}, [&](hid_t plan) { H5Pset_chunk(plan, 1, &chunk); }); }),
      MVS_E_FORMAT, "in chunks"));
  CHECK(refused(of([&](hid_t g) {
                  add_doubles(g, {8}, [&](hid_t plan) {
                    H5Pset_chunk(plan, 1, &chunk);
                    H5Pset_deflate(plan, 6);
                  });
                }),
                MVS_E_FORMAT, "in chunks"));
  CHECK(refused(of([](hid_t g) {
                  add_doubles(g, {8}, [](hid_t plan) { H5Pset_layout(plan, H5D_COMPACT); });
                }),
                MVS_E_FORMAT, "in chunks"));
  CHECK(refused(of([](hid_t g) {
                  add_doubles(g, {8},
                              [](hid_t plan) { H5Pset_external(plan, "/etc/passwd", 0, 64); });
                }),
                MVS_E_FORMAT, "elsewhere"));
  CHECK(refused(of([](hid_t g) { add_doubles(g, {2, 2, 2}); }), MVS_E_FORMAT, "3 dimensions"));
  CHECK(refused(of([](hid_t g) { add_doubles(g, {}); }), MVS_E_FORMAT, "0 dimensions"));
  CHECK(refused(of([](hid_t g) {
                  add_doubles(g, {size_t{1} << 60},
                              [](hid_t plan) { H5Pset_alloc_time(plan, H5D_ALLOC_TIME_LATE); });
                }),
                MVS_E_FORMAT, "larger than the file"));
  CHECK(refused(of([](hid_t g) {
                  add_doubles(g, {8},
                              [](hid_t plan) { H5Pset_alloc_time(plan, H5D_ALLOC_TIME_LATE); });
                }),
                MVS_E_FORMAT, "not whole inside"));
  CHECK(refused(of([](hid_t g) { add_array(g, "x", H5T_IEEE_F64BE, {4}); }), MVS_E_FORMAT, "type"));
  CHECK(refused(of([](hid_t g) { add_array(g, "x", H5T_C_S1, {4}); }), MVS_E_FORMAT, "type"));
}

TEST_CASE("external_soft_and_repeated_links_are_refused") {
  const auto of = [](const std::function<void(hid_t)> &fill) { return outcome(sealed(fill)); };
  CHECK(refused(of([](hid_t g) { H5Lcreate_soft("/mvs", g, "x", H5P_DEFAULT, H5P_DEFAULT); }),
                MVS_E_FORMAT, "link to elsewhere"));
  CHECK(refused(
      of([](hid_t g) { H5Lcreate_external("/etc/passwd", "/", g, "x", H5P_DEFAULT, H5P_DEFAULT); }),
      MVS_E_FORMAT, "link to elsewhere"));
  CHECK(refused(of([](hid_t g) { H5Lcreate_hard(g, ".", g, "round", H5P_DEFAULT, H5P_DEFAULT); }),
                MVS_E_FORMAT, "too deep"));
  // the same array a hundred times would be a large tree from a small file
  CHECK(refused(of([](hid_t g) {
                  add_doubles(g, {500});
                  for (int k = 0; k < 100; ++k) {
                    H5Lcreate_hard(g, "x", g, std::to_string(k).c_str(), H5P_DEFAULT, H5P_DEFAULT);
                  }
                }),
                MVS_E_FORMAT, "exceed the file"));
  CHECK(refused(of([](hid_t g) {
                  const hid_t type = H5Tcopy(H5T_NATIVE_INT);
                  H5Tcommit2(g, "type", type, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
                  H5Tclose(type);
                }),
                MVS_E_FORMAT, "neither group nor array"));
  CHECK(refused(of([](hid_t g) { H5Ldelete(g, "/mvs", H5P_DEFAULT); }), MVS_E_FORMAT,
                "has no group mvs"));
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
