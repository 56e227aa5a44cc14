// Frames and units as files state them, in words.
#include <string>

#include "formats/surface/cursor.h"
#include "formats/surface/parts.h"

namespace mvs::core {
namespace {

bool is_letter(char c) {
  return c >= 'a' && c <= 'z';
}

// The word behind `key`, which '=' or ':' separates: "space = \"lps\"", "coordinates..: lps". Other
// letters, blanks and dots may stand before the sign ("coordinate system:"). Empty if there is
// none. `at` is moved behind the key.
std::string_view word_behind(std::string_view small, std::string_view key, size_t &at) {
  at = small.find(key, at);
  if (at == std::string_view::npos) return {};
  at += key.size();
  const auto is_any_of = [](char c, std::string_view of) {
    return of.find(c) != std::string_view::npos;
  };
  size_t k = at;
  while (k < small.size() && (is_letter(small[k]) || is_any_of(small[k], " \t._"))) ++k;
  if (k == small.size() || !is_any_of(small[k], "=:")) return {};
  ++k;
  while (k < small.size() && is_any_of(small[k], " \t\"'")) ++k;
  const size_t start = k;
  while (k < small.size() && (is_letter(small[k]) || small[k] == '-')) ++k;
  return small.substr(start, k - start);
}

}  // namespace

PatientFrame frame_of_word(std::string_view word) {
  const std::string small = in_small_letters(word);
  if (small == "lps" || small == "left-posterior-superior") return PatientFrame::lps;
  if (small == "ras" || small == "right-anterior-superior") return PatientFrame::ras;
  return PatientFrame::unknown;
}

LengthUnit unit_of_word(std::string_view word) {
  const std::string small = in_small_letters(word);
  if (small == "mm" || small == "millimeter" || small == "millimetre") return LengthUnit::mm;
  if (small == "cm" || small == "centimeter" || small == "centimetre") return LengthUnit::cm;
  if (small == "m" || small == "meter" || small == "metre") return LengthUnit::m;
  return LengthUnit::unknown;
}

const char *frame_word(PatientFrame frame) {
  return frame == PatientFrame::lps ? "LPS" : frame == PatientFrame::ras ? "RAS" : "unknown";
}

const char *unit_word(LengthUnit unit) {
  if (unit == LengthUnit::m) return "m";
  if (unit == LengthUnit::mm) return "mm";
  return unit == LengthUnit::cm ? "cm" : "unknown";
}

PatientFrame stated_frame(std::string_view comment) {
  const std::string small = in_small_letters(comment);
  PatientFrame found = PatientFrame::unknown;
  for (const std::string_view key : {"space", "coordinate"}) {
    for (size_t at = 0; at != std::string_view::npos && at < small.size();) {
      const PatientFrame frame = frame_of_word(word_behind(small, key, at));
      if (frame == PatientFrame::unknown || frame == found) continue;
      if (found != PatientFrame::unknown) return PatientFrame::unknown;
      found = frame;
    }
  }
  return found;
}

LengthUnit stated_unit(std::string_view comment) {
  const std::string small = in_small_letters(comment);
  for (size_t at = 0; at != std::string_view::npos && at < small.size();) {
    const LengthUnit unit = unit_of_word(word_behind(small, "unit", at));
    if (unit != LengthUnit::unknown) return unit;
  }
  return LengthUnit::unknown;
}

void note_comment(SurfaceParts &parts, std::string_view comment) {
  if (parts.frame == PatientFrame::unknown) parts.frame = stated_frame(comment);
  if (parts.unit == LengthUnit::unknown) parts.unit = stated_unit(comment);
}

void note_field(SurfaceParts &parts, std::string_view name, std::string_view text) {
  if (name == "SPACE") parts.frame = frame_of_word(text);
  if (name == "UNITS") parts.unit = unit_of_word(text);
}

}  // namespace mvs::core
