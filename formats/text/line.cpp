// Words, numbers, indices and key=value pairs of one line.
#include "formats/text/line.h"

#include <algorithm>
#include <charconv>
#include <cstdarg>
#include <cstring>

#include "base/utf8.h"
#include "formats/text/decimal.h"

namespace mvs::core {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

// Returns the number of leading blanks, or of leading other characters.
size_t count_leading(std::string_view text, bool blanks) {
  size_t count = 0;
  while (count < text.size() && is_blank(text[count]) == blanks) ++count;
  return count;
}

bool parse_signed(std::string_view text, int64_t &value) {
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && stop == text.data() + text.size();
}

// v, v/vt, v//vn or v/vt/vn: texture and normal must be numbers, but are not used.
bool parse_vertex(std::string_view text, int64_t &index) {
  const size_t first = std::min(text.find('/'), text.size());
  if (!parse_signed(text.substr(0, first), index)) return false;
  if (first == text.size()) return true;
  text.remove_prefix(first + 1);
  const size_t second = std::min(text.find('/'), text.size());
  const bool has_normal = second < text.size();
  int64_t unused = 0;
  if (!(has_normal && second == 0) && !parse_signed(text.substr(0, second), unused)) return false;
  return !has_normal || parse_signed(text.substr(second + 1), unused);
}

const char *number_hint(std::string_view word) {
  if (word.find(',') != std::string_view::npos) return ": the decimal mark is a point";
  const bool letters = std::any_of(word.begin(), word.end(), [](char c) {
    return (c >= 'a' && c <= 'z' && c != 'e') || (c >= 'A' && c <= 'Z' && c != 'E');
  });
  return letters ? "" : " that a double can hold, such as -1.5 or 2e-3";
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return -1;
}

bool stands_for_itself(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         (c != '\0' && std::strchr("-_.+/", c) != nullptr);
}

}  // namespace

std::string_view take_line(std::string_view &text) {
  const size_t stop = std::min(text.find('\n'), text.size());
  std::string_view line = text.substr(0, stop);
  text.remove_prefix(std::min(stop + 1, text.size()));
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

bool parse_whole(std::string_view text, uint64_t &value) {
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && stop == text.data() + text.size();
}

std::string quoted(std::string_view word) {
  constexpr size_t shown = 32;
  std::string text = "`";
  for (const char c : word.substr(0, shown)) {
    const unsigned byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte < 0x7f) {
      text += c;
    } else {
      text += format("\\x%02x", byte);
    }
  }
  return text + (word.size() > shown ? "...`" : "`");
}

std::string_view Line::word() {
  rest_.remove_prefix(count_leading(rest_, true));
  const std::string_view found = rest_.substr(0, count_leading(rest_, false));
  rest_.remove_prefix(found.size());
  return found;
}

double Line::number(int shift) {
  const std::string_view token = word();
  double value = 0;
  if (token.empty()) fail("the line ends where a number is needed");
  if (!parse_decimal(token, value, shift)) {
    fail("%s is not a number%s", quoted(token).c_str(), number_hint(token));
  }
  return value;
}

uint64_t Line::whole() {
  const std::string_view token = word();
  uint64_t value = 0;
  if (token.empty()) fail("the line ends where a whole number is needed");
  if (!parse_whole(token, value)) fail("%s is not a whole number", quoted(token).c_str());
  return value;
}

uint32_t Line::vertex(size_t count) {
  const std::string_view token = word();
  int64_t index = 0;
  if (token.empty()) fail("the line ends where a vertex is needed");
  if (!parse_vertex(token, index)) {
    fail("%s is not a vertex: write its number, 1 for the first", quoted(token).c_str());
  }
  const int64_t limit = static_cast<int64_t>(count);
  if (index == 0) fail("%s is not a vertex: the first one is 1", quoted(token).c_str());
  if (index > limit || index < -limit) {
    fail("vertex %s is not one of the %zu above this line", quoted(token).c_str(), count);
  }
  return static_cast<uint32_t>(index > 0 ? index - 1 : limit + index);
}

bool Line::at_end() {
  return count_leading(rest_, true) == rest_.size();
}

void Line::end() {
  if (at_end()) return;
  fail("%s is more than the line should have", quoted(word()).c_str());
}

void Line::fail(const char *pattern, ...) const {
  va_list arguments;
  va_start(arguments, pattern);
  const std::string text = vformat(pattern, arguments);
  va_end(arguments);
  throw Error(MVS_E_FORMAT, "", text, number_);
}

Fields::Fields(Line &line) : line_(line) {
  for (std::string_view word = line.word(); !word.empty(); word = line.word()) {
    const size_t equals = word.find('=');
    if (equals == std::string_view::npos || equals == 0) {
      line.fail("%s should be key=value", quoted(word).c_str());
    }
    const std::string_view key = word.substr(0, equals);
    for (size_t k = 0; k < count_; ++k) {
      if (fields_[k].key == key) line.fail("%s is given twice", quoted(key).c_str());
    }
    if (count_ == fields_.size()) line.fail("the line has too many keys");
    fields_[count_++] = {key, word.substr(equals + 1)};
  }
}

Fields::Field *Fields::take(std::string_view key) {
  for (size_t k = 0; k < count_; ++k) {
    if (fields_[k].key != key) continue;
    fields_[k].taken = true;
    return &fields_[k];
  }
  return nullptr;
}

bool Fields::number(std::string_view key, double &value, int shift) {
  const Field *field = take(key);
  if (!field) return false;
  if (!parse_decimal(field->value, value, shift)) {
    line_.fail("%.*s: %s is not a number%s", static_cast<int>(key.size()), key.data(),
               quoted(field->value).c_str(), number_hint(field->value));
  }
  return true;
}

bool Fields::whole(std::string_view key, uint64_t &value) {
  const Field *field = take(key);
  if (!field) return false;
  if (!parse_whole(field->value, value)) {
    line_.fail("%.*s: %s is not a whole number of at most 64 bits", static_cast<int>(key.size()),
               key.data(), quoted(field->value).c_str());
  }
  return true;
}

bool Fields::text(std::string_view key, std::string &value) {
  const Field *field = take(key);
  if (!field) return false;
  value = decoded(field->value, line_);
  return true;
}

bool Fields::choice(std::string_view key, uint32_t &value,
                    std::span<const std::string_view> words) {
  const Field *field = take(key);
  if (!field) return false;
  std::string known;
  for (uint32_t k = 0; k < words.size(); ++k) {
    if (words[k] == field->value) {
      value = k;
      return true;
    }
    known.append(known.empty() ? "" : ", ").append(words[k]);
  }
  line_.fail("%.*s: %s is not known; known are: %s", static_cast<int>(key.size()), key.data(),
             quoted(field->value).c_str(), known.c_str());
}

void Fields::need(bool found, std::string_view key) const {
  if (found) return;
  line_.fail("the line lacks %.*s=", static_cast<int>(key.size()), key.data());
}

void Fields::end() const {
  for (size_t k = 0; k < count_; ++k) {
    if (!fields_[k].taken) line_.fail("key %s is not known", quoted(fields_[k].key).c_str());
  }
}

void append_text(std::string &out, std::string_view text) {
  constexpr char digits[] = "0123456789ABCDEF";
  for (const char c : text) {
    if (stands_for_itself(c)) {
      out += c;
    } else {
      const unsigned byte = static_cast<unsigned char>(c);
      out.append({'%', digits[byte / 16], digits[byte % 16]});
    }
  }
}

std::optional<char> percent_byte(std::string_view text) {
  if (text.size() < 3 || text[0] != '%') return std::nullopt;
  const int high = hex_digit(text[1]), low = hex_digit(text[2]);
  if (high < 0 || low < 0) return std::nullopt;
  return static_cast<char>(16 * high + low);
}

std::string decoded(std::string_view word, const Line &line) {
  std::string text;
  for (size_t k = 0; k < word.size(); ++k) {
    if (stands_for_itself(word[k])) {
      text += word[k];
      continue;
    }
    const std::optional<char> byte = percent_byte(word.substr(k));
    if (!byte) {
      line.fail("%s has a character that a name has to write as %%XX, its hexadecimal code",
                quoted(word).c_str());
    }
    text += *byte;
    k += 2;
  }
  if (!is_utf8(text)) {
    line.fail("%s is not UTF-8: names are UTF-8, with %%XX for each byte of a character",
              quoted(word).c_str());
  }
  return text;
}

}  // namespace mvs::core
