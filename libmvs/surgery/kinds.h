// The kinds of operations and their fields, as listed in ops.def.
#pragma once

#include <mvs/op.h>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace mvs::core {

struct OpField {
  const char *name;
  uint32_t type;    // MVS_FIELD_*
  uint32_t offset;  // bytes into the struct
  bool required;
  double low, high;  // range of a given number, number of points, or bytes of a text
  const char *unit, *choices, *help;
};

// Returns the number of a word of a choice, 2 for "head" in "leaflet=1 head=2"; empty if there is
// no such word.
std::optional<uint32_t> choice_of(const OpField &field, std::string_view word);

// The meaning of a zero or empty field, which stands in [brackets] at the end of its help.
struct OpDefault {
  std::string text;  // empty: no default
  double value;      // of a fixed number, or of a choice; otherwise NaN
};
// Valid as long as the library is loaded.
const OpDefault &default_of(const OpField &field);

struct OpKind {
  uint32_t number;  // MVS_OP_*
  uint32_t size;    // of its struct
  const char *name;
  const char *help;
  std::span<const OpField> fields;
};

// Returns all kinds in the order of their numbers.
std::span<const OpKind> op_kinds();

// Return null for an unknown kind.
const OpKind *find_op_kind(uint32_t number);
const OpKind *find_op_kind(std::string_view name);

}  // namespace mvs::core
