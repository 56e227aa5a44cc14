// Tokenizer of Abaqus input: keyword lines (cards) with parameters and data lines. A card records
// which parameters the readers used; notes.h reports the others.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace mvs::core {

[[noreturn, gnu::format(printf, 2, 3)]] void inp_fail(int32_t line, const char *pattern, ...);

// Returns a label in the form that Abaqus compares: capitals, without quotes and outer blanks.
std::string inp_label(std::string_view word);

struct InpParameter {
  std::string key;         // in capitals
  std::string_view value;  // as written; empty without a value
  bool taken = false;
};

// The comma-separated fields of a data line. Every error names the line.
class InpRow {
 public:
  InpRow(std::string_view text, int32_t line) : rest_(text), line_(line) {}

  int32_t line() const { return line_; }
  bool at_end() const { return rest_.empty(); }
  // Returns the next field without outer blanks; empty for a missing field and at the end.
  std::string_view word();
  // Returns a number divided by 10^shift; a missing one is `otherwise`, or an error without it.
  double number(const char *what, int shift = 0, std::optional<double> otherwise = {});
  uint64_t whole(const char *what);

 private:
  std::string_view rest_;
  int32_t line_;
};

struct InpData {
  std::string_view text;
  int32_t line;
};

class InpCard {
 public:
  std::string keyword;  // in capitals, one blank between words, without the star
  int32_t line = 0;
  std::vector<InpParameter> parameters;
  std::vector<InpData> data;
  bool used = false;

  bool is(std::string_view name) const { return keyword == name; }
  // Returns the value of a parameter and marks it as used.
  std::optional<std::string_view> take(std::string_view key);
  // Returns the label of a required parameter.
  std::string need(std::string_view key);
  InpRow row(size_t k) const { return {data[k].text, data[k].line}; }
};

// Splits a file into cards; fails on *INCLUDE, on data before the first keyword, on overlong lines.
std::vector<InpCard> split_inp(std::string_view text);

// The comment line that declares the units ("** units: mm MPa"), and its line.
struct InpUnitsLine {
  std::string_view words;
  int32_t line = 0;
};
InpUnitsLine find_inp_units(std::string_view text);

}  // namespace mvs::core
