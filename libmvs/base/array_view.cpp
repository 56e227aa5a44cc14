// Conversion by element: any stride, any alignment, F32 widened to F64.
#include "base/array_view.h"

#include <cstring>

#include "base/error.h"

namespace mvs::core {
namespace {

constexpr uint64_t count_limit = uint64_t{1} << 24;
constexpr uint64_t stride_limit = uint64_t{1} << 20;

const char *type_name(uint32_t type) {
  switch (type) {
    case MVS_TYPE_F64:
      return "MVS_TYPE_F64";
    case MVS_TYPE_F32:
      return "MVS_TYPE_F32";
    case MVS_TYPE_U32:
      return "MVS_TYPE_U32";
    case MVS_TYPE_U64:
      return "MVS_TYPE_U64";
    case MVS_TYPE_U8:
      return "MVS_TYPE_U8";
    default:
      return "no type";
  }
}

void check_layout(const mvs_array &array, uint32_t components, uint64_t value_size,
                  const char *what) {
  check_list(array.data, array.count, what);
  MVS_MUST(array.components == components, MVS_E_ARGUMENT, what,
           "%s has %u components a row, it needs %u", what, array.components, components);
  const uint64_t row = components * value_size;
  MVS_MUST(array.stride == 0 || (array.stride >= row && array.stride <= stride_limit),
           MVS_E_ARGUMENT, what,
           "%s has a stride of %llu bytes, it has to be 0 (packed) or %llu to %llu", what,
           static_cast<unsigned long long>(array.stride), static_cast<unsigned long long>(row),
           static_cast<unsigned long long>(stride_limit));
}

// Calls take(row, k, value) for each value, of type `Value`, of an array of checked layout.
template <typename Value, typename Take>
void for_each_value(const mvs_array &array, Take take) {
  const uint64_t stride = array.stride ? array.stride : array.components * sizeof(Value);
  const char *row = static_cast<const char *>(array.data);
  for (uint64_t r = 0; r < array.count; ++r, row += stride) {
    for (uint32_t k = 0; k < array.components; ++k) {
      Value value;
      std::memcpy(&value, row + k * sizeof value, sizeof value);
      take(r, k, value);
    }
  }
}

template <typename Take>
void for_each_real(const mvs_array &array, uint32_t components, const char *what, Take take) {
  if (!is_given(array)) return;
  MVS_MUST(array.type == MVS_TYPE_F64 || array.type == MVS_TYPE_F32, MVS_E_ARGUMENT, what,
           "%s is of %s, it has to be MVS_TYPE_F64 or MVS_TYPE_F32", what, type_name(array.type));
  check_layout(array, components, array.type == MVS_TYPE_F64 ? 8 : 4, what);
  if (array.type == MVS_TYPE_F64) {
    for_each_value<double>(array, take);
  } else {
    for_each_value<float>(array, take);
  }
}

template <typename Take>
void for_each_index(const mvs_array &array, uint32_t components, const char *what, Take take) {
  if (!is_given(array)) return;
  MVS_MUST(array.type == MVS_TYPE_U32, MVS_E_ARGUMENT, what,
           "%s is of %s, it has to be MVS_TYPE_U32", what, type_name(array.type));
  check_layout(array, components, 4, what);
  for_each_value<uint32_t>(array, take);
}

}  // namespace

bool is_given(const mvs_array &array) {
  return array.data || array.count || array.components || array.type || array.stride;
}

std::vector<Vec3> read_points(const mvs_array &array, const char *what) {
  std::vector<Vec3> points;
  for_each_real(array, 3, what, [&](uint64_t row, uint32_t k, double value) {
    if (points.empty()) points.resize(array.count);
    points[row][k] = value;
  });
  return points;
}

std::vector<std::array<double, 2>> read_pairs(const mvs_array &array, const char *what) {
  std::vector<std::array<double, 2>> pairs;
  for_each_real(array, 2, what, [&](uint64_t row, uint32_t column, double value) {
    if (pairs.empty()) pairs.resize(array.count);
    pairs[row][column] = value;
  });
  return pairs;
}

std::vector<double> read_numbers(const mvs_array &array, const char *what) {
  std::vector<double> numbers;
  for_each_real(array, 1, what,
                [&](uint64_t, uint32_t, double value) { numbers.push_back(value); });
  return numbers;
}

std::vector<uint32_t> read_indices(const mvs_array &array, const char *what) {
  std::vector<uint32_t> indices;
  for_each_index(array, 1, what,
                 [&](uint64_t, uint32_t, uint32_t index) { indices.push_back(index); });
  return indices;
}

std::vector<Tri> read_triangles(const mvs_array &array, const char *what) {
  std::vector<Tri> triangles;
  for_each_index(array, 3, what, [&](uint64_t row, uint32_t k, uint32_t node) {
    if (triangles.empty()) triangles.resize(array.count);
    triangles[row][k] = node;
  });
  return triangles;
}

void check_list(const void *list, uint64_t count, const char *what) {
  MVS_MUST(count <= count_limit, MVS_E_MEMORY, what, "%s has %llu entries, the limit is %llu", what,
           static_cast<unsigned long long>(count), static_cast<unsigned long long>(count_limit));
  MVS_MUST(count == 0 || list, MVS_E_ARGUMENT, what, "%s has %llu entries but is a null pointer",
           what, static_cast<unsigned long long>(count));
}

}  // namespace mvs::core
