// Lines, words and numbers of a file that may hold binary blocks as well.
#include "formats/surface/cursor.h"

#include <algorithm>
#include <charconv>
#include <cstdarg>
#include <limits>
#include <optional>

#include "base/error.h"
#include "base/utf8.h"
#include "formats/text/decimal.h"
#include "formats/text/line.h"

namespace mvs::core {
namespace {

bool is_space(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r') || c == '\0';
}

}  // namespace

std::string_view Cursor::line() {
  const size_t stop = std::min(rest_.find('\n'), rest_.size());
  std::string_view found = rest_.substr(0, stop);
  const bool has_end = stop < rest_.size();
  rest_.remove_prefix(has_end ? stop + 1 : stop);
  if (has_end && line_ < std::numeric_limits<int32_t>::max()) ++line_;
  if (found.ends_with('\r')) found.remove_suffix(1);
  return found;
}

std::string_view Cursor::filled_line() {
  skip_blanks();
  return without_blanks(line());
}

void Cursor::skip_blanks() {
  size_t k = 0;
  for (; k < rest_.size() && is_space(rest_[k]); ++k) {
    if (rest_[k] == '\n' && line_ < std::numeric_limits<int32_t>::max()) ++line_;
  }
  rest_.remove_prefix(k);
}

std::string_view Cursor::word() {
  skip_blanks();
  size_t k = 0;
  while (k < rest_.size() && !is_space(rest_[k])) ++k;
  const std::string_view found = rest_.substr(0, k);
  rest_.remove_prefix(k);
  return found;
}

void Cursor::expect(std::string_view wanted) {
  const std::string_view found = word();
  if (in_small_letters(found) == wanted) return;
  if (found.empty()) fail("the file ends where `%s` is needed: it is cut short", wanted.data());
  fail("%s stands where `%s` is needed", quoted(found).c_str(), wanted.data());
}

double Cursor::number(const char *what) {
  const std::string_view token = word();
  double value = 0;
  if (token.empty()) fail("the file ends where %s is needed: it is cut short", what);
  if (!parse_decimal(token, value)) {
    fail("%s is not a finite number; %s is needed", quoted(token).c_str(), what);
  }
  return value;
}

double Cursor::number_or_nan(const char *what) {
  const std::string_view token = word();
  double value = 0;
  if (token.empty()) fail("the file ends where %s is needed: it is cut short", what);
  if (parse_decimal(token, value)) return value;
  const std::string small = in_small_letters(token);
  const bool is_no_number =
      small.find("nan") != std::string::npos || small.find("inf") != std::string::npos;
  if (!is_no_number) fail("%s is not a number; %s is needed", quoted(token).c_str(), what);
  return std::numeric_limits<double>::quiet_NaN();
}

uint64_t Cursor::whole(const char *what) {
  const std::string_view token = word();
  uint64_t value = 0;
  if (token.empty()) fail("the file ends where %s is needed: it is cut short", what);
  if (!parse_whole(token, value)) {
    fail("%s is not a whole number; %s is needed", quoted(token).c_str(), what);
  }
  return value;
}

int64_t Cursor::whole_signed(const char *what) {
  const std::string_view token = word();
  int64_t value = 0;
  if (token.empty()) fail("the file ends where %s is needed: it is cut short", what);
  const auto [stop, error] = std::from_chars(token.data(), token.data() + token.size(), value);
  if (error != std::errc() || stop != token.data() + token.size()) {
    fail("%s is not a whole number; %s is needed", quoted(token).c_str(), what);
  }
  return value;
}

uint64_t Cursor::count(const char *what, size_t bytes_each) {
  const uint64_t items = whole(what);
  must_hold(items, bytes_each, what);
  return items;
}

void Cursor::must_hold(uint64_t items, size_t bytes_each, const char *what) const {
  // the last number of a text has no blank behind it
  if (items <= (rest_.size() + 1) / bytes_each) return;
  fail("%s is %llu, but the rest of the file has %zu bytes: it is cut short", what,
       static_cast<unsigned long long>(items), rest_.size());
}

std::string_view Cursor::bytes(uint64_t count, const char *what) {
  if (count > rest_.size()) {
    fail("the file ends within %s, where %llu bytes are needed and %zu are left: it is cut short",
         what, static_cast<unsigned long long>(count), rest_.size());
  }
  is_binary_ = true;
  const std::string_view found = rest_.substr(0, count);
  rest_.remove_prefix(count);
  return found;
}

bool Cursor::at_end() {
  skip_blanks();
  return rest_.empty();
}

void Cursor::fail(const char *pattern, ...) const {
  va_list arguments;
  va_start(arguments, pattern);
  const std::string sentence = vformat(pattern, arguments);
  va_end(arguments);
  throw Error(MVS_E_FORMAT, "", sentence, line_number());
}

std::string_view without_blanks(std::string_view text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

std::string in_small_letters(std::string_view text) {
  std::string small(text);
  for (char &c : small) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return small;
}

std::string as_utf8(std::string_view text) {
  std::string clean;
  while (!text.empty()) {
    const size_t length = utf8_length(text);
    const bool is_control =
        length == 1 && (static_cast<unsigned char>(text[0]) < 0x20 || text[0] == 0x7f);
    if (length == 0 || is_control) {
      clean += '?';
    } else {
      clean += text.substr(0, length);
    }
    text.remove_prefix(std::max<size_t>(length, 1));
  }
  return clean;
}

std::string percent_decoded(std::string_view text) {
  std::string plain;
  for (size_t k = 0; k < text.size(); ++k) {
    const std::optional<char> byte = percent_byte(text.substr(k));
    plain += byte.value_or(text[k]);
    if (byte) k += 2;
  }
  return plain;
}

}  // namespace mvs::core
