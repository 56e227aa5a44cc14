#include "text/op_text.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "text/console.h"
#include "text/op_forms.h"
#include "valve/host.h"

namespace cli {
namespace {

// SI units and their units in text. Two factors per unit, so that 40 MPa is exactly 40e6 Pa.
struct Unit {
  const char *si, *text;
  double times, over;  // SI = text * times / over
};
constexpr Unit units[] = {{"m", "mm", 1, 1e3},
                          {"m2", "mm2", 1, 1e6},
                          {"Pa", "MPa", 1e6, 1},
                          {"rad", "deg", std::numbers::pi, 180},
                          {"", "", 1, 1}};

const Unit &unit_of(const mvs_field_info &field) {
  for (const Unit &unit : units) {
    if (std::strcmp(unit.si, field.unit) == 0) return unit;
  }
  throw std::logic_error(
      text("the field %s has the unit %s, which the command cannot write", field.name, field.unit));
}

double si(const mvs_field_info &field, double value) {
  const Unit &unit = unit_of(field);
  return value * unit.times / unit.over;
}

std::array<double, 3> si(const mvs_field_info &field, std::array<double, 3> value) {
  for (double &x : value) x = si(field, x);
  return value;
}

uint32_t part_kind(const mvs_field_info &field) {
  if (field.type == MVS_FIELD_CHORD) return MVS_PART_CHORD;
  return field.type == MVS_FIELD_HEAD ? MVS_PART_HEAD : MVS_PART_SCALLOP;
}

std::string words_of(const mvs_field_info &field, const char *separator) {
  std::string words;
  for (const auto &[word, number] : choices_of(field))
    words += (words.empty() ? "" : separator) + word;
  return words;
}

bool has_form(const mvs_field_info &field, const std::string &given) {
  double number;
  uint32_t count;
  std::array<double, 3> triple;
  SiteText site;
  switch (field.type) {
    case MVS_FIELD_NUMBER:
      return read_number(given, number);
    case MVS_FIELD_COUNT:
      return read_count(given, count);
    case MVS_FIELD_CHOICE: {
      const auto choices = choices_of(field);
      return std::any_of(choices.begin(), choices.end(),
                         [&](const auto &choice) { return choice.first == given; });
    }
    case MVS_FIELD_SITE:
      return read_site(given, site);
    case MVS_FIELD_POINT:
    case MVS_FIELD_VECTOR:
      return read_triple(given, triple);
    default:
      return !given.empty();
  }
}

}  // namespace

const char *unit_in_text(const mvs_field_info &field) {
  return unit_of(field).text;
}

double in_text(const mvs_field_info &field, double value) {
  const Unit &unit = unit_of(field);
  return value * unit.over / unit.times;
}

std::vector<std::pair<std::string, uint32_t>> choices_of(const mvs_field_info &field) {
  std::vector<std::pair<std::string, uint32_t>> choices;
  for (const std::string &word : split(field.choices, ' ')) {
    const std::vector<std::string> sides = split(word, '=');
    uint32_t number = 0;
    if (sides.size() == 2 && read_count(sides[1], number)) choices.emplace_back(sides[0], number);
  }
  return choices;
}

std::string form_of(const mvs_field_info &field) {
  switch (field.type) {
    case MVS_FIELD_NUMBER:
      return *field.unit ? unit_in_text(field) : "FACTOR";
    case MVS_FIELD_COUNT:
      return "COUNT";
    case MVS_FIELD_CHOICE:
      return "{" + words_of(field, "|") + "}";
    case MVS_FIELD_CHORD:
      return "CHORD";
    case MVS_FIELD_HEAD:
      return "HEAD";
    case MVS_FIELD_SCALLOP:
      return "SCALLOP";
    case MVS_FIELD_SITE:
      return "SCALLOP:ALONG:HEIGHT|node:INDEX|triangle:INDEX:U:V:W";
    case MVS_FIELD_POINT:
    case MVS_FIELD_VECTOR:
      return "X,Y,Z";
    case MVS_FIELD_POINTS:
      return "FILE";
    default:
      return "TEXT";
  }
}

std::string help_of(const mvs_field_info &field) {
  const std::string help = field.help;
  const std::string unit = *field.unit ? std::string(", ") + unit_in_text(field) : "";
  const size_t bracket = std::min(help.find(" ["), help.size());
  const bool is_number = field.type != MVS_FIELD_CHOICE && !std::isnan(field.default_value);
  return help.substr(0, bracket) + unit +
         (is_number ? text(" [%g]", in_text(field, field.default_value)) : help.substr(bracket));
}

std::string complaint(const mvs_field_info &field, const std::string &given) {
  if (has_form(field, given)) return "";
  const std::string unit = *field.unit ? std::string(" in ") + unit_in_text(field) : "";
  if (field.type == MVS_FIELD_NUMBER) return "'" + given + "' is not a number" + unit;
  if (field.type == MVS_FIELD_COUNT) return "'" + given + "' is not a non-negative integer";
  if (field.type != MVS_FIELD_CHOICE) {
    return "'" + given + "' is not of the form " + form_of(field) + unit;
  }
  return "'" + given + "' is unknown; choose from: " + words_of(field, ", ");
}

OpText::OpText(mvs::OpKind kind) : kind_(std::move(kind)), words_((kind_.info.size + 7) / 8) {
  const mvs_op head = {kind_.info.size, kind_.info.kind};
  std::memcpy(words_.data(), &head, sizeof head);
}

template <typename Value>
void OpText::put(const mvs_field_info &field, const Value &value) {
  std::memcpy(reinterpret_cast<char *>(words_.data()) + field.offset, &value, sizeof value);
}

void OpText::set(const std::string &name, const std::string &given, const mvs::Snapshot &valve) {
  const auto found = std::find_if(kind_.fields.begin(), kind_.fields.end(),
                                  [&](const mvs_field_info &f) { return name == f.name; });
  const std::string part = std::string(kind_.info.name) + "." + name;
  if (found == kind_.fields.end()) fail(MVS_E_ARGUMENT, part, "there is no field " + part);
  const mvs_field_info &field = *found;
  const std::string wrong = complaint(field, given);
  if (!wrong.empty()) fail(MVS_E_ARGUMENT, part, part + ": " + wrong);
  switch (field.type) {
    case MVS_FIELD_NUMBER:
    case MVS_FIELD_COUNT:
      return set_number(field, given);
    case MVS_FIELD_CHOICE:
      for (const auto &[word, number] : choices_of(field)) {
        if (word == given) put(field, number);
      }
      return;
    case MVS_FIELD_SITE:
      return put(field, site_of(given, valve));
    case MVS_FIELD_POINT:
    case MVS_FIELD_VECTOR: {
      std::array<double, 3> at;
      read_triple(given, at);
      at = si(field, at);
      return field.type == MVS_FIELD_VECTOR ? put(field, at)
                                            : put(field, mvs_point{{at[0], at[1], at[2]}, 1, 0});
    }
    case MVS_FIELD_POINTS:
      return set_points(field, read_points_file(given).points);
    case MVS_FIELD_TEXT:
      texts_.push_back(given);
      return put(field, texts_.back().c_str());
    default:
      return put(field, valve.find(part_kind(field), given).id);
  }
}

// Checks the range of the library here, so that the sentence can use the unit in text and a zero,
// which means "not given" in the struct, is refused.
void OpText::set_number(const mvs_field_info &field, const std::string &given) {
  double value = 0;
  read_number(given, value);
  const double number = si(field, value);
  if (!(number >= field.low && number <= field.high)) {
    const char *unit = unit_in_text(field);
    fail(MVS_E_ARGUMENT, std::string(kind_.info.name) + "." + field.name,
         text("%s: %s is %s%s%s, the range is %g to %g", kind_.info.name, field.name, given.c_str(),
              *unit ? " " : "", unit, in_text(field, field.low), in_text(field, field.high)));
  }
  if (field.type == MVS_FIELD_NUMBER) return put(field, number);
  put(field, static_cast<uint32_t>(value));
}

mvs_site OpText::site_of(const std::string &given, const mvs::Snapshot &valve) const {
  SiteText parsed;
  read_site(given, parsed);
  mvs_site site = {parsed.how, parsed.index, 0, {parsed.u[0], parsed.u[1], parsed.u[2]}};
  if (parsed.how == MVS_SITE_ANATOMICAL)
    site.scallop = valve.find(MVS_PART_SCALLOP, parsed.scallop).id;
  return site;
}

void OpText::set_points(const mvs_field_info &field, Points points) {
  points_.push_back(std::move(points));
  for (std::array<double, 3> &point : points_.back()) point = si(field, point);
  put(field, mvs_array{points_.back().data(), points_.back().size(), 3, MVS_TYPE_F64, 0});
}

}  // namespace cli
