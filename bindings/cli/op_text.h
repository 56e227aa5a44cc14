// Operations from text: what a command line, or any file of text, says about their fields.
//
// Which fields there are is told by the library (mvs::op_kinds). Lengths are in mm, areas in mm2,
// moduli in MPa; parts are named; a place is P2:0.5:0.9 (scallop, along, height), node:17 or
// triangle:12:0.3:0.3:0.4; a point is x,y,z; points are a text file with three numbers a line;
// a choice is a word.
#pragma once

#include <array>
#include <list>
#include <mvs/mvs.hpp>
#include <string>
#include <utility>
#include <vector>

namespace cli {

// The unit a field has in text: mm for m, ...; "" for none.
const char *unit_in_text(const mvs_field_info &field);

// A number of a field in SI units, as it is written in text.
double in_text(const mvs_field_info &field, double si);

// What a field is given as: "MM", "CHORD", "SCALLOP:ALONG:HEIGHT", ...
std::string form_of(const mvs_field_info &field);

// Help on one line: what it is, its unit, and its default in that unit.
std::string help_of(const mvs_field_info &field);

// The words of a choice and their numbers; empty for other types.
std::vector<std::pair<std::string, uint32_t>> choices_of(const mvs_field_info &field);

// What is wrong with the form of a text, or "". Names and files are not looked up.
std::string complaint(const mvs_field_info &field, const std::string &text);

// An operation under construction, and all that it points to.
class OpText {
 public:
  explicit OpText(mvs::OpKind kind);

  // Sets a field; parts are looked up in `valve`. Throws mvs::Error for a text of a wrong form, a
  // value out of range (in the text's units), a part that is not there, a file that is no points.
  void set(const std::string &name, const std::string &text, const mvs::Snapshot &valve);

  const mvs_op *get() const { return reinterpret_cast<const mvs_op *>(words_.data()); }

 private:
  void set_number(const mvs_field_info &field, const std::string &text);
  mvs_site site_of(const std::string &text, const mvs::Snapshot &valve) const;
  void set_points(const mvs_field_info &field, const std::string &text);
  template <typename Value>
  void put(const mvs_field_info &field, const Value &value);

  mvs::OpKind kind_;
  std::vector<uint64_t> words_;  // the struct, aligned
  std::list<std::string> texts_;
  std::list<std::vector<std::array<double, 3>>> points_;
};

}  // namespace cli
