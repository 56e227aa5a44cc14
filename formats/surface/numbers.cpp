// Types of numbers by their names in PLY, VTK legacy and VTK XML files, and their bytes.
#include "formats/surface/numbers.h"

#include <bit>
#include <cstring>

#include "formats/surface/cursor.h"

namespace mvs::core {
namespace {

using NumberKind = NumberType::Kind;

struct TypeName {
  std::string_view name;
  NumberType type;
};

// vtkIdType is written with 32 bits in legacy files, long with 64.
constexpr TypeName type_names[] = {
    {"char", {NumberKind::whole_signed, 1}},
    {"int8", {NumberKind::whole_signed, 1}},
    {"signed_char", {NumberKind::whole_signed, 1}},
    {"uchar", {NumberKind::whole, 1}},
    {"uint8", {NumberKind::whole, 1}},
    {"unsigned_char", {NumberKind::whole, 1}},
    {"short", {NumberKind::whole_signed, 2}},
    {"int16", {NumberKind::whole_signed, 2}},
    {"ushort", {NumberKind::whole, 2}},
    {"uint16", {NumberKind::whole, 2}},
    {"unsigned_short", {NumberKind::whole, 2}},
    {"int", {NumberKind::whole_signed, 4}},
    {"int32", {NumberKind::whole_signed, 4}},
    {"vtkidtype", {NumberKind::whole_signed, 4}},
    {"vtktypeint32", {NumberKind::whole_signed, 4}},
    {"uint", {NumberKind::whole, 4}},
    {"uint32", {NumberKind::whole, 4}},
    {"unsigned_int", {NumberKind::whole, 4}},
    {"vtktypeuint32", {NumberKind::whole, 4}},
    {"long", {NumberKind::whole_signed, 8}},
    {"int64", {NumberKind::whole_signed, 8}},
    {"vtktypeint64", {NumberKind::whole_signed, 8}},
    {"unsigned_long", {NumberKind::whole, 8}},
    {"uint64", {NumberKind::whole, 8}},
    {"vtktypeuint64", {NumberKind::whole, 8}},
    {"float", {NumberKind::floating, 4}},
    {"float32", {NumberKind::floating, 4}},
    {"double", {NumberKind::floating, 8}},
    {"float64", {NumberKind::floating, 8}},
};

template <typename Number>
double read_as(const char *bytes) {
  Number number;
  std::memcpy(&number, bytes, sizeof number);
  return static_cast<double>(number);
}

}  // namespace

std::optional<NumberType> number_type(std::string_view name) {
  const std::string small = in_small_letters(name);
  for (const TypeName &known : type_names) {
    if (known.name == small) return known.type;
  }
  return {};
}

double number_at(const char *at, NumberType type, bool is_big_endian) {
  char bytes[8];
  const bool swaps = is_big_endian != (std::endian::native == std::endian::big);
  for (size_t k = 0; k < type.size; ++k) bytes[k] = at[swaps ? type.size - 1 - k : k];
  if (type.kind == NumberKind::floating) {
    return type.size == 4 ? read_as<float>(bytes) : read_as<double>(bytes);
  }
  const bool has_sign = type.kind == NumberKind::whole_signed;
  switch (type.size) {
    case 1:
      return has_sign ? read_as<int8_t>(bytes) : read_as<uint8_t>(bytes);
    case 2:
      return has_sign ? read_as<int16_t>(bytes) : read_as<uint16_t>(bytes);
    case 4:
      return has_sign ? read_as<int32_t>(bytes) : read_as<uint32_t>(bytes);
    default:
      return has_sign ? read_as<int64_t>(bytes) : read_as<uint64_t>(bytes);
  }
}

int64_t index_of_number(double number) {
  constexpr double most = 9007199254740992;  // 2^53
  if (!(number >= 0 && number < most)) return -1;
  const auto index = static_cast<int64_t>(number);
  return static_cast<double>(index) == number ? index : -1;
}

void append_numbers(std::vector<double> &to, std::string_view block, NumberType type,
                    bool is_big_endian) {
  const size_t count = block.size() / type.size;
  to.reserve(to.size() + count);
  for (size_t k = 0; k < count; ++k) {
    to.push_back(number_at(block.data() + k * type.size, type, is_big_endian));
  }
}

}  // namespace mvs::core
