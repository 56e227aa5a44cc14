// Reader of HDF5 files as trees, without trust in the file: links must be hard, arrays contiguous,
// inside the file, of a written type, and together no larger than the file.
#ifdef MVS_HAVE_HDF5
#include <algorithm>
#include <new>

#include "base/error.h"
#include "formats/hdf5/handles.h"
#include "formats/hdf5/tree.h"

namespace mvs::core {
namespace {

using namespace h5;

constexpr size_t most_depth = 8, most_objects = 1 << 16;

File open_image(std::string_view bytes) {
  const List access(read(H5Pcreate(H5P_FILE_ACCESS), "access"));
  read(H5Pset_fapl_core(access.id(), envelope_bytes, false), "access");
  // HDF5 copies the image and does not modify it
  read(H5Pset_file_image(access.id(), const_cast<char *>(bytes.data()), bytes.size()), "image");
  return File(read(H5Fopen(name_of_image, H5F_ACC_RDONLY, access.id()), "beginning"));
}

// The member names of a group, and a fault if it contains a soft or external link.
struct Names {
  std::vector<std::string> names;
  const char *fault = nullptr;
  bool no_memory = false;
};

// Callback of HDF5, which must not throw.
herr_t add_name(hid_t, const char *name, const H5L_info_t *link, void *to) noexcept {
  Names &names = *static_cast<Names *>(to);
  try {
    if (link->type != H5L_TYPE_HARD) names.fault = "it has a link to elsewhere";
    if (names.names.size() >= most_objects) names.fault = "it has too many members";
    if (!names.fault) names.names.emplace_back(name);
  } catch (const std::exception &) {
    names.no_memory = true;
  }
  return names.fault || names.no_memory ? 1 : 0;
}

class H5Reader {
 public:
  explicit H5Reader(size_t bytes) : bytes_(bytes), left_(bytes) {}

  // Reads a member of the root with all its descendants.
  void root_member(hid_t file, const std::string &name) {
    H5L_info_t link;
    MVS_MUST(read(H5Lexists(file, name.c_str(), H5P_DEFAULT), name) > 0, MVS_E_FORMAT, name,
             "the file has no group %s", name.c_str());
    read(H5Lget_info(file, name.c_str(), &link, H5P_DEFAULT), name);
    MVS_MUST(link.type == H5L_TYPE_HARD, MVS_E_FORMAT, name,
             "group %s of the file is a link to elsewhere", name.c_str());
    members(Object(read(H5Oopen(file, name.c_str(), H5P_DEFAULT), name)).id(), name, 0);
  }

  H5Tree tree;

 private:
  void object(hid_t group_id, const std::string &name, const std::string &path, size_t depth) {
    MVS_MUST(depth < most_depth && ++objects_ < most_objects, MVS_E_FORMAT, path,
             "the groups of the file are too deep or too many at %s", path.c_str());
    const Object opened(read(H5Oopen(group_id, name.c_str(), H5P_DEFAULT), path));
    const H5I_type_t kind = H5Iget_type(opened.id());
    if (kind == H5I_GROUP) return members(opened.id(), path, depth);
    MVS_MUST(kind == H5I_DATASET, MVS_E_FORMAT, path, "%s of the file is neither group nor array",
             path.c_str());
    array(opened.id(), path);
  }

  static void check_attributes(hid_t id, const std::string &path) {
    H5O_info_t info;
    read(H5Oget_info(id, &info), path);
    MVS_MUST(info.num_attrs == 0, MVS_E_FORMAT, path,
             "%s of the file has an attribute: libmvs never writes one there", path.c_str());
  }

  void members(hid_t id, const std::string &path, size_t depth) {
    check_attributes(id, path);
    Names found;
    hsize_t at = 0;
    read(H5Literate(id, H5_INDEX_NAME, H5_ITER_INC, &at, add_name, &found), path);
    if (found.no_memory) throw std::bad_alloc();
    MVS_MUST(!found.fault, MVS_E_FORMAT, path, "cannot read %s of the file: %s", path.c_str(),
             found.fault);
    MVS_MUST(depth == 0 || !found.names.empty(), MVS_E_FORMAT, path,
             "group %s of the file is empty: libmvs never writes one", path.c_str());
    for (const std::string &member : found.names) {
      object(id, member, std::string(path).append("/").append(member), depth + 1);
    }
  }

  void array(hid_t id, const std::string &path) {
    check_attributes(id, path);
    H5Array made;
    const size_t rows = check_shape(id, path, made.columns);
    const Type type(read(H5Dget_type(id), path));
    const size_t count = rows * std::max(made.columns, 1u);
    const bool known = values<double>(id, path, type, H5T_IEEE_F64LE, count, made) ||
                       values<uint64_t>(id, path, type, H5T_STD_U64LE, count, made) ||
                       values<int64_t>(id, path, type, H5T_STD_I64LE, count, made) ||
                       values<uint32_t>(id, path, type, H5T_STD_U32LE, count, made) ||
                       values<int32_t>(id, path, type, H5T_STD_I32LE, count, made) ||
                       values<uint8_t>(id, path, type, H5T_STD_U8LE, count, made);
    MVS_MUST(known, MVS_E_FORMAT, path, "array %s of the file has a type that libmvs never writes",
             path.c_str());
    tree.arrays.emplace(path, std::move(made));
  }

  // Returns the number of rows, bounded so that products with the other sizes do not overflow.
  size_t check_shape(hid_t id, const std::string &path, uint32_t &columns) const {
    const Space space(read(H5Dget_space(id), path));
    const int rank = H5Sget_simple_extent_ndims(space.id());
    MVS_MUST(H5Sget_simple_extent_type(space.id()) == H5S_SIMPLE && (rank == 1 || rank == 2),
             MVS_E_FORMAT, path, "array %s of the file has %d dimensions, not one or two",
             path.c_str(), rank);
    hsize_t shape[2] = {0, 0};
    read(H5Sget_simple_extent_dims(space.id(), shape, nullptr), path);
    MVS_MUST(shape[0] <= left_ && shape[1] <= UINT16_MAX && (rank == 1 || shape[1] > 0),
             MVS_E_FORMAT, path, "array %s of the file is larger than the file", path.c_str());
    columns = static_cast<uint32_t>(shape[1]);
    return shape[0];
  }

  template <typename Value>
  bool values(hid_t id, const std::string &path, const Type &type, hid_t wanted, size_t count,
              H5Array &made) {
    if (read(H5Tequal(type.id(), wanted), path) == 0) return false;
    check_storage(id, path, count * sizeof(Value));
    std::vector<Value> values(count);
    const Type memory(read(H5Tget_native_type(wanted, H5T_DIR_DEFAULT), path));
    if (count > 0) {
      read(H5Dread(id, memory.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), path);
    }
    made.values = std::move(values);
    return true;
  }

  void check_storage(hid_t id, const std::string &path, size_t size) {
    const List creation(read(H5Dget_create_plist(id), path));
    MVS_MUST(H5Pget_layout(creation.id()) == H5D_CONTIGUOUS &&
                 H5Pget_external_count(creation.id()) == 0 && H5Pget_nfilters(creation.id()) == 0,
             MVS_E_FORMAT, path,
             "array %s of the file is in chunks, filtered or elsewhere: libmvs never writes that",
             path.c_str());
    MVS_MUST(size <= left_, MVS_E_FORMAT, path, "the arrays of the file up to %s exceed the file",
             path.c_str());
    left_ -= size;
    if (size == 0) return;
    const haddr_t at = H5Dget_offset(id);
    MVS_MUST(H5Dget_storage_size(id) == size && at <= bytes_ && size <= bytes_ - at, MVS_E_FORMAT,
             path, "array %s is not whole inside the file", path.c_str());
  }

  const size_t bytes_;
  size_t left_;
  size_t objects_ = 0;
};

}  // namespace

H5Tree read_h5(std::string_view bytes, const std::string &group, uint32_t version) {
  check_seal(bytes, version);
  const ExclusiveUse use;
  const File file = open_image(bytes);
  H5Reader reader(bytes.size());
  reader.root_member(file.id(), group);
  return std::move(reader.tree);
}

}  // namespace mvs::core
#endif
