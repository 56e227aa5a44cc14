// Abaqus input taken apart: keyword lines with their parameters, and the data lines below them.
// A card marks what was understood of it; inp_notes.h lists the rest.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace mvs::core {

[[noreturn, gnu::format(printf, 2, 3)]] void inp_fail(int32_t line, const char *pattern, ...);

// A label as Abaqus compares it: in capitals, without quotes and outer blanks.
std::string inp_label(std::string_view word);

struct InpParameter {
  std::string key;         // in capitals
  std::string_view value;  // as written; empty where there is none
  bool taken = false;
};

// A data line, field by field; fields are parted by commas. Every complaint names the line.
class InpRow {
 public:
  InpRow(std::string_view text, int32_t line) : rest_(text), line_(line) {}

  int32_t line() const { return line_; }
  bool at_end() const { return rest_.empty(); }
  // The next field without outer blanks; empty where nothing is written, and at the end.
  std::string_view word();
  // A number, divided by 10^shift; what is not written is `otherwise`, or a fault without it.
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
  // The value of a parameter, which counts as understood from now on.
  std::optional<std::string_view> take(std::string_view key);
  // The label that a parameter gives; fails without it.
  std::string need(std::string_view key);
  InpRow row(size_t k) const { return {data[k].text, data[k].line}; }
};

// Fails on *INCLUDE, on data before the first keyword and on lines beyond any sense.
std::vector<InpCard> split_inp(std::string_view text);

// The text of the comment line that names the units ("** units: mm MPa"), and its line.
struct InpUnitsLine {
  std::string_view words;
  int32_t line = 0;
};
InpUnitsLine find_inp_units(std::string_view text);

}  // namespace mvs::core
