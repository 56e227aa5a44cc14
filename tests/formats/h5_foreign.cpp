// HDF5 files of other programs: files that are not of libmvs, and structures that it never writes,
// are refused with the reason.
#ifdef MVS_HAVE_HDF5
#include <hdf5.h>

#include <doctest/doctest.h>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "formats/formats.h"
#include "formats/hdf5/tree.h"
#include "tests/formats/h5_outcome.h"

using namespace mvs::core;

namespace {

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

TEST_CASE("attributes_are_refused") {
  const auto attribute = [](hid_t object) {
    const hid_t space = H5Screate(H5S_SCALAR);
    H5Aclose(H5Acreate2(object, "x", H5T_STD_I32LE, space, H5P_DEFAULT, H5P_DEFAULT));
    H5Sclose(space);
  };
  CHECK(refused(outcome(sealed(attribute)), MVS_E_FORMAT, "mvs of the file has an attribute"));
  CHECK(refused(outcome(sealed([&](hid_t g) {
                  add_doubles(g, {4});
                  const hid_t array = H5Dopen2(g, "x", H5P_DEFAULT);
                  attribute(array);
                  H5Dclose(array);
                })),
                MVS_E_FORMAT, "mvs/x of the file has an attribute"));
}

TEST_CASE("empty_groups_are_refused") {
  const auto add_group = [](hid_t group, const char *name) {
    H5Gclose(H5Gcreate2(group, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  };
  CHECK(refused(outcome(sealed([&](hid_t g) {
                  add_doubles(g, {4});
                  add_group(g, "extra");
                })),
                MVS_E_FORMAT, "group mvs/extra of the file is empty"));
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
#endif
