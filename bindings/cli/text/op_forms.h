// Parsers of values in text: numbers, triples, sites on leaflets. They ignore the locale.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

// Return false unless the whole text has the form.
bool read_number(std::string_view text, double &value);
bool read_count(std::string_view text, uint32_t &value);

// Three numbers between commas: "1,2.5,-3".
bool read_triple(const std::string &text, std::array<double, 3> &value);

// A site: P2:0.5:0.9, node:17, or triangle:12:0.3:0.3:0.4.
struct SiteText {
  uint32_t how = 0;     // MVS_SITE_*
  uint32_t index = 0;   // of the node or triangle
  std::string scallop;  // its name
  std::array<double, 3> u = {};
};
bool read_site(const std::string &text, SiteText &value);

using Points = std::vector<std::array<double, 3>>;

// The points of a text file, and a hash of the bytes that were read.
struct PointsFile {
  Points points;
  std::string hash;
};

// Reads three numbers per line, separated by commas, semicolons or blanks. Skips empty lines, lines
// that begin with '#', and a heading in the first line. Throws mvs::Error with the line number.
PointsFile read_points_file(const std::string &path);

std::vector<std::string> split(const std::string &text, char separator);

}  // namespace cli
