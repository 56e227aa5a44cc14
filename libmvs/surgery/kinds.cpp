// ops.def as tables; what the compiler can check about them is checked here.
#include "surgery/kinds.h"

#include <array>
#include <type_traits>

namespace mvs::core {
namespace {

// What a field of each type is in C.
template <uint32_t type>
struct InC;
template <>
struct InC<MVS_FIELD_NUMBER> : std::type_identity<double> {};
template <>
struct InC<MVS_FIELD_COUNT> : std::type_identity<uint32_t> {};
template <>
struct InC<MVS_FIELD_CHOICE> : std::type_identity<uint32_t> {};
template <>
struct InC<MVS_FIELD_CHORD> : std::type_identity<mvs_id> {};
template <>
struct InC<MVS_FIELD_HEAD> : std::type_identity<mvs_id> {};
template <>
struct InC<MVS_FIELD_SCALLOP> : std::type_identity<mvs_id> {};
template <>
struct InC<MVS_FIELD_SITE> : std::type_identity<mvs_site> {};
template <>
struct InC<MVS_FIELD_POINT> : std::type_identity<mvs_point> {};
template <>
struct InC<MVS_FIELD_VECTOR> : std::type_identity<double[3]> {};
template <>
struct InC<MVS_FIELD_POINTS> : std::type_identity<mvs_array> {};
template <>
struct InC<MVS_FIELD_TEXT> : std::type_identity<const char *> {};

#define OPERATION(NUMBER, op_name, op_help)                                               \
  static_assert(offsetof(mvs_op_##op_name, op) == 0 && sizeof(mvs_op_##op_name) % 8 == 0, \
                "an operation begins with mvs_op");
#define FIELD(op_name, field, TYPE, required, low, high, unit, choices, help)                   \
  static_assert(std::is_same_v<decltype(mvs_op_##op_name::field), InC<MVS_FIELD_##TYPE>::type>, \
                "the field has the type that ops.def says");
#include "surgery/ops.def"
#undef OPERATION
#undef FIELD

// All fields in one table, each with the number of its operation.
struct Row {
  uint32_t op;
  OpField field;
};

#define OPERATION(NUMBER, op_name, op_help) \
  constexpr uint32_t number_of_##op_name = MVS_OP_##NUMBER;
#define FIELD(...)
#include "surgery/ops.def"
#undef OPERATION
#undef FIELD

constexpr Row rows[] = {
#define OPERATION(NUMBER, op_name, op_help)
#define FIELD(op_name, field, TYPE, required, low, high, unit, choices, help)           \
  {number_of_##op_name,                                                                 \
   {#field, MVS_FIELD_##TYPE, static_cast<uint32_t>(offsetof(mvs_op_##op_name, field)), \
    (required) != 0, low, high, unit, choices, help}},
#include "surgery/ops.def"
#undef OPERATION
#undef FIELD
};

constexpr size_t row_count = std::size(rows);

constexpr std::array<OpField, row_count> make_fields() {
  std::array<OpField, row_count> fields{};
  for (size_t k = 0; k < row_count; ++k) fields[k] = rows[k].field;
  return fields;
}
constexpr std::array<OpField, row_count> fields = make_fields();

// The rows of one operation: they stand together.
std::span<const OpField> fields_of(uint32_t op) {
  size_t first = 0;
  while (first < row_count && rows[first].op != op) ++first;
  size_t last = first;
  while (last < row_count && rows[last].op == op) ++last;
  return {fields.data() + first, last - first};
}

}  // namespace

std::span<const OpKind> op_kinds() {
  static const OpKind kinds[] = {
#define OPERATION(NUMBER, op_name, op_help) \
  {MVS_OP_##NUMBER, sizeof(mvs_op_##op_name), #op_name, op_help, fields_of(MVS_OP_##NUMBER)},
#define FIELD(...)
#include "surgery/ops.def"
#undef OPERATION
#undef FIELD
  };
  return kinds;
}

const OpKind *find_op_kind(uint32_t number) {
  for (const OpKind &kind : op_kinds()) {
    if (kind.number == number) return &kind;
  }
  return nullptr;
}

const OpKind *find_op_kind(std::string_view name) {
  for (const OpKind &kind : op_kinds()) {
    if (kind.name == name) return &kind;
  }
  return nullptr;
}

}  // namespace mvs::core
