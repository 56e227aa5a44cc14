// Fixture: the toy valve of tests/formats/data/three_leaflets.inp as text, with replacements.
#pragma once

#include <doctest/doctest.h>
#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "formats/formats.h"

namespace mvs::core {

// Relative: one rounding of a product with a power of ten, or of a sum of few numbers.
inline constexpr double rounding = 1e-15;

inline std::string toy_inp() {
  std::stringstream text;
  text << std::ifstream(MVS_SOURCE_DIR "/tests/formats/data/three_leaflets.inp").rdbuf();
  return text.str();
}

// Returns the text with changes, each of a piece of text that occurs in one place.
inline std::string changed(std::string text,
                           const std::vector<std::pair<std::string, std::string>> &changes) {
  for (const std::pair<std::string, std::string> &change : changes) {
    const std::string &old = change.first;
    const size_t place = text.find(old);
    REQUIRE_MESSAGE(place != std::string::npos, old);
    REQUIRE_MESSAGE(text.find(old, place + 1) == std::string::npos, old, " stands there twice");
    text.replace(place, old.size(), change.second);
  }
  return text;
}

inline std::string toy_with(const std::string &old, const std::string &with) {
  return changed(toy_inp(), {{old, with}});
}

// The line that contains a piece of the toy valve's text.
inline int32_t toy_line(const std::string &piece) {
  const std::string text = toy_inp();
  const size_t place = text.find(piece);
  REQUIRE_MESSAGE(place != std::string::npos, piece);
  return 1 + static_cast<int32_t>(
                 std::count(text.begin(), text.begin() + static_cast<long>(place), '\n'));
}

// Whether one of the notes contains a piece of text.
inline bool has_note(const Imported &imported, const std::string &piece) {
  for (const Note &note : imported.notes) {
    if (note.text.find(piece) != std::string::npos) return true;
  }
  return false;
}

}  // namespace mvs::core
