// The forms that values have in text: numbers, triples, places. No locale takes part.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

// False where the text is no such thing from its first to its last character.
bool read_number(std::string_view text, double &value);
bool read_count(std::string_view text, uint32_t &value);

// Three numbers between commas: "1,2.5,-3".
bool read_triple(const std::string &text, std::array<double, 3> &value);

// A place: P2:0.5:0.9, node:17, or triangle:12:0.3:0.3:0.4.
struct PlaceText {
  uint32_t how = 0;     // MVS_SITE_*
  uint32_t index = 0;   // of the node or triangle
  std::string scallop;  // its name
  std::array<double, 3> u = {};
};
bool read_place(const std::string &text, PlaceText &value);

// The points of a text file: three numbers a line, between commas, semicolons or blanks; empty
// lines and lines that begin with '#' do not count, nor does a first line of words. Throws
// mvs::Error with the line.
std::vector<std::array<double, 3>> read_points_file(const std::string &path);

std::vector<std::string> split(const std::string &text, char separator);

}  // namespace cli
