// Decimal text through to_chars and from_chars, with the exponent shifted in between.
#include "formats/text/decimal.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/chars.h"

namespace mvs::core {
namespace {

// Numbers in this range of exponents are written without one: 0.0001 to 10^16.
constexpr int lowest_plain = -4, highest_plain = 15;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

struct Mantissa {
  size_t length = 0;  // with sign and point
  bool nonzero = false;
};

// [-] digits [. digits]
bool scan_mantissa(std::string_view text, Mantissa &mantissa) {
  bool any = false, point = false;
  size_t &at = mantissa.length;
  if (!text.empty() && text[0] == '-') at = 1;
  for (; at < text.size(); ++at) {
    if (text[at] == '.' && !point) {
      point = true;
    } else if (is_digit(text[at])) {
      any = true;
      mantissa.nonzero = mantissa.nonzero || text[at] != '0';
    } else {
      break;
    }
  }
  return any;
}

// Empty, or e [sign] digits.
bool scan_exponent(std::string_view text, int &exponent) {
  constexpr int beyond_any_double = 9999;
  if (text.empty()) return true;
  if (text[0] != 'e' && text[0] != 'E') return false;
  text.remove_prefix(1);
  const bool negative = !text.empty() && text[0] == '-';
  if (!text.empty() && (text[0] == '-' || text[0] == '+')) text.remove_prefix(1);
  if (text.empty()) return false;
  for (const char c : text) {
    if (!is_digit(c)) return false;
    exponent = std::min(10 * exponent + (c - '0'), beyond_any_double);
  }
  if (negative) exponent = -exponent;
  return true;
}

// Appends digits d1 d2 d3 ... that stand for d1.d2d3... * 10^exponent.
void append_digits(std::string &out, std::string_view digits, int exponent) {
  if (exponent < lowest_plain || exponent > highest_plain) {
    out += digits[0];
    if (digits.size() > 1) out.append(1, '.').append(digits.substr(1));
    char text[8];
    out.append(1, 'e').append(text, std::to_chars(text, text + sizeof text, exponent).ptr);
  } else if (exponent < 0) {
    out.append("0.").append(static_cast<size_t>(-exponent - 1), '0').append(digits);
  } else {
    const size_t whole = static_cast<size_t>(exponent) + 1;
    if (digits.size() <= whole) {
      out.append(digits).append(whole - digits.size(), '0');
    } else {
      out.append(digits.substr(0, whole)).append(1, '.').append(digits.substr(whole));
    }
  }
}

}  // namespace

void append_decimal(std::string &out, double value, int shift) {
  if (std::signbit(value)) out += '-';
  if (value == 0) {
    out += '0';
    return;
  }
  char text[double_chars];
  char *const end = double_to_chars(text, std::abs(value));
  char *const e = std::find(text, end, 'e');
  int exponent = 0;
  std::from_chars(e[1] == '+' ? e + 2 : e + 1, end, exponent);
  if (e - text > 1) {
    text[1] = text[0];  // overwrites the point, so that the digits are contiguous
    append_digits(out, {text + 1, static_cast<size_t>(e - text - 1)}, exponent + shift);
  } else {
    append_digits(out, {text, 1}, exponent + shift);
  }
}

bool parse_decimal(std::string_view token, double &value, int shift) {
  constexpr size_t longest = 64;
  if (token.size() > longest) return false;
  if (token.starts_with('+') && !token.starts_with("+-")) token.remove_prefix(1);
  Mantissa mantissa;
  int exponent = 0;
  if (!scan_mantissa(token, mantissa)) return false;
  if (!scan_exponent(token.substr(mantissa.length), exponent)) return false;
  char text[longest + 16];
  char *end = std::copy_n(token.data(), mantissa.length, text);
  *end++ = 'e';
  end = std::to_chars(end, text + sizeof text, exponent - shift).ptr;
  // implementations report underflow differently: zero from nonzero digits is refused here
  return double_from_chars({text, static_cast<size_t>(end - text)}, value) &&
         std::isfinite(value) && (value != 0 || !mantissa.nonzero);
}

}  // namespace mvs::core
