// Builds operations from the text of their fields, as given on a command line.
//
// The library describes the fields (mvs::op_kinds). Lengths are in mm, areas in mm2, moduli in MPa;
// parts are given by name; a site is P2:0.5:0.9 (scallop, along, height), node:17 or
// triangle:12:0.3:0.3:0.4; a point is x,y,z; points are the name of a text file with three numbers
// per line; a choice is a word.
#pragma once

#include <array>
#include <list>
#include <mvs/mvs.hpp>
#include <string>
#include <utility>
#include <vector>

#include "text/op_forms.h"

namespace cli {

// The unit of a field in text: mm for m, ...; "" for a pure number.
const char *unit_in_text(const mvs_field_info &field);

// Converts a value of a field from SI units to the unit in text.
double in_text(const mvs_field_info &field, double si);

// The placeholder of a field in --help: "mm", "CHORD", "SCALLOP:ALONG:HEIGHT", ...
std::string form_of(const mvs_field_info &field);

// Help on one line: meaning, unit, and default in that unit.
std::string help_of(const mvs_field_info &field);

// The words of a choice and their numbers; empty for fields of other types.
std::vector<std::pair<std::string, uint32_t>> choices_of(const mvs_field_info &field);

// An error sentence if the text has a wrong form, else "". Does not look up names or files.
std::string complaint(const mvs_field_info &field, const std::string &text);

// An operation under construction; owns the memory that the struct points to.
class OpText {
 public:
  explicit OpText(mvs::OpKind kind);

  // Sets a field; parts are looked up in `valve`. Throws mvs::Error for a text of a wrong form, a
  // value out of range (the sentence uses the unit in text), an unknown part, or an unreadable file
  // of points.
  void set(const std::string &name, const std::string &text, const mvs::Snapshot &valve);
  // Sets a field of points that are in the unit of the text.
  void set_points(const mvs_field_info &field, Points points);

  bool has_points() const { return !points_.empty(); }
  const mvs_op *get() const { return reinterpret_cast<const mvs_op *>(words_.data()); }

 private:
  void set_number(const mvs_field_info &field, const std::string &text);
  mvs_site site_of(const std::string &text, const mvs::Snapshot &valve) const;
  template <typename Value>
  void put(const mvs_field_info &field, const Value &value);

  mvs::OpKind kind_;
  std::vector<uint64_t> words_;  // the struct, aligned
  std::list<std::string> texts_;
  std::list<Points> points_;
};

}  // namespace cli
