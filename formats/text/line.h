// Parser of one line of a text file; every error names the line and the word.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/error.h"

namespace mvs::core {

// Returns a word for an error message: at most 32 bytes, unprintable ones as \x00, in backquotes.
std::string quoted(std::string_view word);

// Parses a number of digits only; returns false for another text.
bool parse_whole(std::string_view text, uint64_t &value);

// Takes the first line off a text, without its end, "\n" or "\r\n".
std::string_view take_line(std::string_view &text);

class Line {
 public:
  Line() = default;
  Line(std::string_view text, int32_t number) : rest_(text), number_(number) {}

  // Returns the next word, empty at the end. Spaces and tabs separate words.
  std::string_view word();
  // A number, divided by 10^shift.
  double number(int shift = 0);
  // A whole number, without sign.
  uint64_t whole();
  // Returns the 0-based index of one of `count` vertices; files count from 1, or from the end with
  // -1.
  uint32_t vertex(size_t count);
  // Fails if words are left.
  void end();
  bool at_end();

  int32_t number_of_line() const { return number_; }
  [[noreturn, gnu::format(printf, 2, 3)]] void fail(const char *pattern, ...) const;

 private:
  std::string_view rest_;
  int32_t number_ = 0;
};

// The remaining words of a line as key=value pairs. Each getter takes its key; end() refuses the
// others as unknown.
class Fields {
 public:
  explicit Fields(Line &line);

  bool number(std::string_view key, double &value, int shift = 0);
  bool whole(std::string_view key, uint64_t &value);
  bool text(std::string_view key, std::string &value);
  // The index of the value in a list of words.
  bool choice(std::string_view key, uint32_t &value, std::span<const std::string_view> words);
  // Fails unless one of the getters above found its key.
  void need(bool found, std::string_view key) const;
  void end() const;

 private:
  struct Field {
    std::string_view key, value;
    bool taken = false;
  };
  Field *take(std::string_view key);

  const Line &line_;
  std::array<Field, 16> fields_;
  size_t count_ = 0;
};

// Names as words: letters, digits and -_.+/ stand for themselves, other bytes are %XX.
void append_text(std::string &out, std::string_view text);
std::string decoded(std::string_view word, const Line &line);

// Returns the byte that %XX at the start of a text stands for; nothing for another start.
std::optional<char> percent_byte(std::string_view text);

}  // namespace mvs::core
