// Position in the bytes of a file: lines, words, numbers and blocks of binary numbers in turn.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace mvs::core {

class Cursor {
 public:
  explicit Cursor(std::string_view bytes, int32_t line = 1) : rest_(bytes), line_(line) {}

  // The next line without its end; the lines of a file without a last newline end with it.
  std::string_view line();
  // The next line that is not blank, trimmed; empty at the end of the file.
  std::string_view filled_line();
  // The next word, also of a later line; empty at the end of the file.
  std::string_view word();
  // Fails if the next word is another one.
  void expect(std::string_view wanted);
  // A finite number. `what` is for the sentence: "a coordinate".
  double number(const char *what);
  // The same, but infinite numbers and words such as "nan" are NaN.
  double number_or_nan(const char *what);
  uint64_t whole(const char *what);
  int64_t whole_signed(const char *what);
  // A count of things that take at least `bytes_each` bytes of the rest of the file; fails if these
  // are not there.
  uint64_t count(const char *what, size_t bytes_each);
  // Fails unless `items` things of `bytes_each` bytes can follow.
  void must_hold(uint64_t items, size_t bytes_each, const char *what) const;
  // The next bytes as they are. After them lines are no longer counted.
  std::string_view bytes(uint64_t count, const char *what);
  void skip_blanks();

  bool at_end();
  size_t left() const { return rest_.size(); }
  std::string_view rest() const { return rest_; }
  // The line of the last word; 0 after binary data.
  int32_t line_number() const { return is_binary_ ? 0 : line_; }
  [[noreturn, gnu::format(printf, 2, 3)]] void fail(const char *pattern, ...) const;

 private:
  std::string_view rest_;
  int32_t line_ = 1;
  bool is_binary_ = false;
};

// A text without blanks at its ends; the text in small letters of ASCII.
std::string_view without_blanks(std::string_view text);
std::string in_small_letters(std::string_view text);

// A text in which bytes that are not UTF-8, and control characters, are replaced by '?'.
std::string as_utf8(std::string_view text);

// A text with %XX replaced, as names in VTK legacy files have it; other percent signs stay.
std::string percent_decoded(std::string_view text);

}  // namespace mvs::core
