// Writer of trees as HDF5, in the format of HDF5 1.8 and with its simplest storage: groups keep
// their links in their own header whatever their number, so that the file has no heaps and no
// B-trees.
#ifdef MVS_HAVE_HDF5
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <type_traits>

#include "base/error.h"
#include "formats/hdf5/handles.h"
#include "formats/hdf5/tree.h"

namespace mvs::core {
namespace {

using namespace h5;

// The file image in memory. HDF5 leaves gaps between its parts with the bytes of malloc: equal
// trees would not give equal bytes, and files could contain other data of the process. The
// callbacks therefore clear the memory. The image is taken when HDF5 closes the file, because
// H5Fget_file_image of HDF5 1.10 returns a first block with a wrong checksum.
struct Image {
  Image() = default;
  Image(const Image &) = delete;
  Image &operator=(const Image &) = delete;
  ~Image() { std::free(closed); }
  size_t size = 0;
  char *closed = nullptr;
};

void *image_malloc(size_t size, H5FD_file_image_op_t, void *image) {
  static_cast<Image *>(image)->size = size;
  return std::calloc(size, 1);
}
void *image_realloc(void *memory, size_t size, H5FD_file_image_op_t, void *image) {
  size_t &old = static_cast<Image *>(image)->size;
  char *const moved = static_cast<char *>(std::realloc(memory, size));
  if (!moved) return nullptr;
  if (size > old) std::memset(moved + old, 0, size - old);
  old = size;
  return moved;
}
void *image_memcpy(void *to, const void *from, size_t size, H5FD_file_image_op_t, void *) {
  return std::memcpy(to, from, size);
}
herr_t image_free(void *memory, H5FD_file_image_op_t when, void *image) {
  if (when == H5FD_FILE_IMAGE_OP_FILE_CLOSE) {
    static_cast<Image *>(image)->closed = static_cast<char *>(memory);
  } else {
    std::free(memory);
  }
  return 0;
}
void *same_image(void *image) {
  return image;
}
herr_t keep_image(void *) {
  return 0;
}

File create_file(Image &image) {
  const List access(wrote(H5Pcreate(H5P_FILE_ACCESS), "access")),
      creation(wrote(H5Pcreate(H5P_FILE_CREATE), "creation"));
  constexpr size_t growth = 1 << 20;
  H5FD_file_image_callbacks_t callbacks = {image_malloc, image_memcpy, image_realloc, image_free,
                                           same_image,   keep_image,   &image};
  wrote(H5Pset_fapl_core(access.id(), growth, false), "access");
  wrote(H5Pset_file_image_callbacks(access.id(), &callbacks), "access");
  wrote(H5Pset_libver_bounds(access.id(), H5F_LIBVER_V18, H5F_LIBVER_V18), "access");
  wrote(H5Pset_userblock(creation.id(), envelope_bytes), "creation");
  wrote(H5Pset_obj_track_times(creation.id(), false), "creation");
  wrote(H5Pset_link_phase_change(creation.id(), UINT16_MAX, 0), "creation");
  return File(wrote(H5Fcreate(name_of_image, H5F_ACC_TRUNC, creation.id(), access.id()), "file"));
}

template <typename Value>
Type file_type(const std::vector<Value> &) {
  if constexpr (std::is_same_v<Value, double>) return Type(H5Tcopy(H5T_IEEE_F64LE));
  if constexpr (std::is_same_v<Value, uint64_t>) return Type(H5Tcopy(H5T_STD_U64LE));
  if constexpr (std::is_same_v<Value, int64_t>) return Type(H5Tcopy(H5T_STD_I64LE));
  if constexpr (std::is_same_v<Value, uint32_t>) return Type(H5Tcopy(H5T_STD_U32LE));
  if constexpr (std::is_same_v<Value, int32_t>) return Type(H5Tcopy(H5T_STD_I32LE));
  if constexpr (std::is_same_v<Value, uint8_t>) return Type(H5Tcopy(H5T_STD_U8LE));
}

// VTK 9.7.2 reads text arrays of variable length marked as ASCII, and crashes on other types.
Type file_type(const std::vector<std::string> &) {
  Type type(H5Tcopy(H5T_C_S1));
  wrote(H5Tset_size(type.id(), H5T_VARIABLE), "text");
  return type;
}

class H5Writer {
 public:
  explicit H5Writer(hid_t file) : file_(file) {
    wrote(H5Pset_layout(array_creation_.id(), H5D_CONTIGUOUS), "array");
    wrote(H5Pset_obj_track_times(array_creation_.id(), false), "array");
    wrote(H5Pset_obj_track_times(group_creation_.id(), false), "group");
    wrote(H5Pset_link_phase_change(group_creation_.id(), UINT16_MAX, 0), "group");
  }

  void array(const std::string &path, const H5Array &array) {
    std::visit([&](const auto &values) { values_at(path, array.columns, values); }, array.values);
  }
  void attribute(const std::string &path, const std::string &name, const H5Attribute &value) {
    const hid_t place = path.empty() ? file_ : group(path);
    if (value.numbers.empty()) return write_text(place, name, value.text);
    const hsize_t count = value.numbers.size();
    const Type type = file_type(value.numbers), memory(H5Tcopy(H5T_NATIVE_INT64));
    const Space space(wrote(H5Screate_simple(1, &count, nullptr), name));
    write_attribute(place, name, type, memory, space, value.numbers.data());
  }

 private:
  // Returns the group of a path; creates it and its parents if needed.
  hid_t group(const std::string &path) {
    const auto place = groups_.find(path);
    if (place != groups_.end()) return place->second.id();
    const size_t slash = path.rfind('/');
    const hid_t above = slash == std::string::npos ? file_ : group(path.substr(0, slash));
    const std::string name = path.substr(slash == std::string::npos ? 0 : slash + 1);
    GroupHandle made(wrote(
        H5Gcreate2(above, name.c_str(), H5P_DEFAULT, group_creation_.id(), H5P_DEFAULT), path));
    return groups_.emplace(path, std::move(made)).first->second.id();
  }

  template <typename Value>
  void values_at(const std::string &path, uint32_t columns, const std::vector<Value> &values) {
    const size_t slash = path.rfind('/');
    MVS_MUST(slash != std::string::npos && (columns == 0 || values.size() % columns == 0),
             MVS_E_INTERNAL, path, "%s has no group, or rows of different length", path.c_str());
    const hsize_t shape[2] = {values.size() / std::max(columns, 1u), columns};
    const Type type = file_type(values);
    const Space space(wrote(H5Screate_simple(columns == 0 ? 1 : 2, shape, nullptr), path));
    const Dataset made(
        wrote(H5Dcreate2(group(path.substr(0, slash)), path.c_str() + slash + 1, type.id(),
                         space.id(), H5P_DEFAULT, array_creation_.id(), H5P_DEFAULT),
              path));
    if (!values.empty()) fill(made, type, path, values);
  }

  template <typename Value>
  static void fill(const Dataset &made, const Type &type, const std::string &path,
                   const std::vector<Value> &values) {
    const Type memory(wrote(H5Tget_native_type(type.id(), H5T_DIR_DEFAULT), path));
    wrote(H5Dwrite(made.id(), memory.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), path);
  }
  static void fill(const Dataset &made, const Type &type, const std::string &path,
                   const std::vector<std::string> &texts) {
    std::vector<const char *> pointers;
    pointers.reserve(texts.size());
    for (const std::string &text : texts) pointers.push_back(text.c_str());
    wrote(H5Dwrite(made.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data()), path);
  }

  static void write_text(hid_t place, const std::string &name, const std::string &text) {
    const Type type(H5Tcopy(H5T_C_S1));
    wrote(H5Tset_size(type.id(), std::max<size_t>(text.size(), 1)), name);
    wrote(H5Tset_strpad(type.id(), H5T_STR_NULLPAD), name);
    const Space space(wrote(H5Screate(H5S_SCALAR), name));
    write_attribute(place, name, type, type, space, text.data());
  }
  static void write_attribute(hid_t place, const std::string &name, const Type &type,
                              const Type &memory, const Space &space, const void *data) {
    const Attribute made(wrote(
        H5Acreate2(place, name.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT), name));
    wrote(H5Awrite(made.id(), memory.id(), data), name);
  }

  const hid_t file_;
  const List array_creation_{wrote(H5Pcreate(H5P_DATASET_CREATE), "array")};
  const List group_creation_{wrote(H5Pcreate(H5P_GROUP_CREATE), "group")};
  std::map<std::string, GroupHandle> groups_;
};

// Returns the size of the file, which is smaller than its memory: the end address at byte 28 of the
// superblock of version 2, which H5F_LIBVER_V18 gives (HDF5 File Format Specification 3.0, section
// II.A).
size_t end_of(const Image &image) {
  constexpr size_t end_at = envelope_bytes + 28;
  MVS_MUST(image.closed && image.size >= end_at + 8 && image.closed[envelope_bytes + 8] == 2,
           MVS_E_INTERNAL, "file", "HDF5 made a file of another version than it was asked for");
  uint64_t end = 0;
  for (size_t k = 8; k-- > 0;) {
    end = end << 8 | static_cast<unsigned char>(image.closed[end_at + k]);
  }
  MVS_MUST(end <= image.size, MVS_E_INTERNAL, "file", "HDF5 made a file that it cut");
  return end;
}

}  // namespace

std::string write_h5(const H5Tree &tree, uint32_t version) {
  const ExclusiveUse use;
  Image image;
  File file = create_file(image);
  {
    H5Writer writer(file.id());
    for (const auto &[path, array] : tree.arrays) writer.array(path, array);
    for (const auto &[place, value] : tree.attributes) {
      writer.attribute(place.first, place.second, value);
    }
  }
  wrote(file.close_now(), "file");
  std::string bytes(image.closed, end_of(image));
  seal(bytes, version);
  return bytes;
}

}  // namespace mvs::core
#endif
