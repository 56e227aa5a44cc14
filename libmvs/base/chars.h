// Decimal text of a double without locale: std::to_chars and std::from_chars, or where the standard
// library has them for integers only (emscripten's libc++ 14), the same through the C library.
#pragma once

#include <string_view>

namespace mvs::core {

// Room for every number that double_to_chars writes.
constexpr int double_chars = 32;

// Writes the shortest decimal that reads back as `value`, finite and not negative, in scientific
// notation ("1.5e+00"); of several the nearest. Returns its end.
char *double_to_chars(char (&text)[double_chars], double value);

// Reads a decimal with an optional minus and exponent that fills the text; false where it does not,
// or is out of range. At most 128 characters.
bool double_from_chars(std::string_view text, double &value);

// The same through the C library, in the C locale; on every machine, for the test of equality.
namespace c_library {
char *double_to_chars(char (&text)[double_chars], double value);
bool double_from_chars(std::string_view text, double &value);
}  // namespace c_library

}  // namespace mvs::core
