// Shortest decimal text of a double, and its reading.
#include "base/chars.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "base/bit_cast.h"

namespace mvs::core {
namespace {

// Adds one to the last digit of d[.ddd]e+xx; false where that makes it ten or more.
bool increment(char *text) {
  for (char *at = std::strchr(text, 'e') - 1; at >= text; --at) {
    if (*at == '.') continue;
    if (*at < '9') {
      ++*at;
      return true;
    }
    *at = '0';
  }
  return false;
}

// Removes zeros at the end of the digits, and a point without digits.
char *strip_zeros(char *text) {
  char *const exponent = std::strchr(text, 'e');
  char *end = exponent;
  if (std::find(text, exponent, '.') != exponent) {
    while (end[-1] == '0') --end;
    if (end[-1] == '.') --end;
  }
  const size_t length = std::strlen(exponent);
  std::memmove(end, exponent, length + 1);
  return end + length;
}

}  // namespace

namespace c_library {

// A decimal of 15 digits is read back from the double nearest to it, so that no shorter one than
// that of 15 digits without its zeros reads back as `value`; numbers below 2.2e-308 have fewer bits
// and are tried from one digit on. 17 digits always do. At a power of two the numbers below are
// nearer than those above: the decimal above may read back where the nearest, which is below, does
// not.
char *double_to_chars(char (&text)[double_chars], double value) {
  constexpr uint64_t mantissa = (uint64_t{1} << 52) - 1;
  const bool power_of_two = (bit_cast<uint64_t>(value) & mantissa) == 0;
  const int fewest = value < std::numeric_limits<double>::min() ? 1 : 15;
  for (int digits = fewest; digits < 17; ++digits) {
    std::snprintf(text, sizeof text, "%.*e", digits - 1, value);
    if (std::strtod(text, nullptr) == value) return strip_zeros(text);
    if (power_of_two && increment(text) && std::strtod(text, nullptr) == value) {
      return strip_zeros(text);
    }
  }
  std::snprintf(text, sizeof text, "%.16e", value);
  return strip_zeros(text);
}

bool double_from_chars(std::string_view text, double &value) {
  constexpr size_t longest = 128;
  constexpr std::string_view part_of_decimal = "0123456789.eE+-";
  if (text.empty() || text.size() > longest || text[0] == '+') return false;
  if (text.find_first_not_of(part_of_decimal) != std::string_view::npos) return false;
  char copy[longest + 1];
  *std::copy(text.begin(), text.end(), copy) = '\0';
  char *end = nullptr;
  const double number = std::strtod(copy, &end);
  if (end != copy + text.size() || !std::isfinite(number)) return false;
  value = number;
  return true;
}

}  // namespace c_library

#if defined(__cpp_lib_to_chars)
char *double_to_chars(char (&text)[double_chars], double value) {
  return std::to_chars(text, text + sizeof text, value, std::chars_format::scientific).ptr;
}

bool double_from_chars(std::string_view text, double &value) {
  const char *const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && stop == end;
}
#elif defined(__EMSCRIPTEN__)
// the decimal separator of its C library is a point in every locale
char *double_to_chars(char (&text)[double_chars], double value) {
  return c_library::double_to_chars(text, value);
}

bool double_from_chars(std::string_view text, double &value) {
  return c_library::double_from_chars(text, value);
}
#else
#error "the standard library has no std::to_chars of double: use libstdc++ 11, libc++ 20 or newer"
#endif

}  // namespace mvs::core
