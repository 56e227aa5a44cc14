// Tables made from ops.def, with compile-time checks of the field types.
#include "surgery/kinds.h"

#include <algorithm>
#include <array>
#include <limits>
#include <type_traits>
#include <vector>

#include "base/chars.h"

namespace mvs::core {
namespace {

// The C type of each field type.
template <uint32_t type>
constexpr auto in_c() {
  using std::type_identity;
  if constexpr (type == MVS_FIELD_NUMBER) return type_identity<double>{};
  if constexpr (type == MVS_FIELD_COUNT) return type_identity<uint32_t>{};
  if constexpr (type == MVS_FIELD_CHOICE) return type_identity<uint32_t>{};
  if constexpr (type == MVS_FIELD_CHORD) return type_identity<mvs_id>{};
  if constexpr (type == MVS_FIELD_HEAD) return type_identity<mvs_id>{};
  if constexpr (type == MVS_FIELD_SCALLOP) return type_identity<mvs_id>{};
  if constexpr (type == MVS_FIELD_SITE) return type_identity<mvs_site>{};
  if constexpr (type == MVS_FIELD_POINT) return type_identity<mvs_point>{};
  if constexpr (type == MVS_FIELD_VECTOR) return type_identity<double[3]>{};
  if constexpr (type == MVS_FIELD_POINTS) return type_identity<mvs_array>{};
  if constexpr (type == MVS_FIELD_TEXT) return type_identity<const char *>{};
}

#define OPERATION(NUMBER, op_name, op_help)                                               \
  static_assert(offsetof(mvs_op_##op_name, op) == 0 && sizeof(mvs_op_##op_name) % 8 == 0, \
                "an operation begins with mvs_op");
#define FIELD(op_name, field, TYPE, required, low, high, unit, choices, help)                      \
  static_assert(                                                                                   \
      std::is_same_v<decltype(mvs_op_##op_name::field), decltype(in_c<MVS_FIELD_##TYPE>())::type>, \
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

constexpr Row field_rows[] = {
#define OPERATION(NUMBER, op_name, op_help)
#define FIELD(op_name, field, TYPE, required, low, high, unit, choices, help)           \
  {number_of_##op_name,                                                                 \
   {#field, MVS_FIELD_##TYPE, static_cast<uint32_t>(offsetof(mvs_op_##op_name, field)), \
    (required) != 0, low, high, unit, choices, help}},
#include "surgery/ops.def"
#undef OPERATION
#undef FIELD
};

constexpr size_t row_count = std::size(field_rows);

constexpr std::array<OpField, row_count> make_fields() {
  std::array<OpField, row_count> fields{};
  for (size_t k = 0; k < row_count; ++k) fields[k] = field_rows[k].field;
  return fields;
}
constexpr std::array<OpField, row_count> fields = make_fields();

// Returns the rows of one operation, which are contiguous.
std::span<const OpField> fields_of(uint32_t op) {
  size_t first = 0;
  while (first < row_count && field_rows[first].op != op) ++first;
  size_t last = first;
  while (last < row_count && field_rows[last].op == op) ++last;
  return {fields.data() + first, last - first};
}

OpDefault read_default(const OpField &field) {
  const std::string_view help = field.help;
  const size_t open = help.rfind('[');
  constexpr double unfixed = std::numeric_limits<double>::quiet_NaN();
  if (open == std::string_view::npos || help.back() != ']') return {"", unfixed};
  OpDefault found{std::string(help.substr(open + 1, help.size() - open - 2)), unfixed};
  if (double_from_chars(found.text, found.value)) return found;
  const std::optional<uint32_t> choice = choice_of(field, found.text);
  found.value = choice ? *choice : unfixed;
  return found;
}

}  // namespace

std::optional<uint32_t> choice_of(const OpField &field, std::string_view word) {
  std::string_view rest = field.choices;
  while (!rest.empty()) {
    const std::string_view pair = rest.substr(0, rest.find(' '));
    const size_t sign = pair.find('=');
    if (pair.substr(0, sign) == word) {
      return static_cast<uint32_t>(std::stoul(std::string(pair.substr(sign + 1))));
    }
    rest.remove_prefix(std::min(rest.size(), pair.size() + 1));
  }
  return {};
}

const OpDefault &default_of(const OpField &field) {
  static const std::vector<OpDefault> defaults = [] {
    std::vector<OpDefault> made;
    made.reserve(fields.size());
    for (const OpField &each : fields) made.push_back(read_default(each));
    return made;
  }();
  return defaults[static_cast<size_t>(&field - fields.data())];
}

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
