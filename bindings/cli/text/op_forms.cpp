#include "text/op_forms.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>

#include "text/content_hash.h"
#include "valve/host.h"

namespace cli {
namespace {

template <typename Value>
bool read_all(std::string_view text, Value &value) {
  const char *last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value);
  return error == std::errc() && end == last;
}

// Reads the coordinates from part `first` to the last; the caller has checked their number.
bool read_shares(const std::vector<std::string> &parts, size_t first, std::array<double, 3> &u) {
  for (size_t k = first; k < parts.size(); ++k) {
    if (!read_number(parts[k], u[k - first])) return false;
  }
  return true;
}

// Three numbers with any separators and nothing else.
bool read_row(std::string line, std::array<double, 3> &row) {
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c == ',' || c == ';' || c == '\t'; }, ' ');
  std::vector<std::string> words = split(line, ' ');
  std::erase_if(words, [](const std::string &word) { return word.empty(); });
  if (words.size() != 3) return false;
  for (size_t k = 0; k < 3; ++k) {
    if (!read_number(words[k], row[k])) return false;
  }
  return true;
}

}  // namespace

bool read_number(std::string_view text, double &value) {
  return read_all(text, value);
}

bool read_count(std::string_view text, uint32_t &value) {
  return read_all(text, value);
}

std::vector<std::string> split(const std::string &text, char separator) {
  std::vector<std::string> parts;
  size_t from = 0, to = 0;
  while ((to = text.find(separator, from)) != std::string::npos) {
    parts.push_back(text.substr(from, to - from));
    from = to + 1;
  }
  parts.push_back(text.substr(from));
  return parts;
}

bool read_triple(const std::string &text, std::array<double, 3> &value) {
  const std::vector<std::string> parts = split(text, ',');
  return parts.size() == 3 && read_shares(parts, 0, value);
}

bool read_site(const std::string &text, SiteText &value) {
  const std::vector<std::string> parts = split(text, ':');
  if (parts.size() == 2 && parts[0] == "node") {
    value.how = MVS_SITE_NODE;
    return read_count(parts[1], value.index);
  }
  if (parts.size() == 5 && parts[0] == "triangle") {
    value.how = MVS_SITE_TRIANGLE;
    return read_count(parts[1], value.index) && read_shares(parts, 2, value.u);
  }
  value.how = MVS_SITE_ANATOMICAL;
  value.scallop = parts[0];
  return parts.size() == 3 && !value.scallop.empty() && read_shares(parts, 1, value.u);
}

PointsFile read_points_file(const std::string &path) {
  std::ifstream opened(path, std::ios::binary);
  std::stringstream file;
  if (opened.peek() != std::ifstream::traits_type::eof()) file << opened.rdbuf();
  // a folder can be opened, but not read
  if (!opened.is_open() || opened.bad()) {
    fail(MVS_E_IO, path, "cannot read the points of " + path);
  }
  Points points;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.find_first_not_of(" \t") == std::string::npos || line[0] == '#') continue;
    std::array<double, 3> row;
    // the first line may be a heading
    const bool is_row = read_row(line, row);
    if (!is_row && number == 1) continue;
    if (!is_row ||
        !std::all_of(row.begin(), row.end(), [](double x) { return std::isfinite(x); })) {
      fail(MVS_E_FORMAT, path,
           path + ":" + std::to_string(number) + ": needs three numbers in mm: x, y, z", number);
    }
    points.push_back(row);
  }
  if (points.empty()) {
    fail(MVS_E_FORMAT, path, path + " has no points: it needs three numbers per line, in mm");
  }
  return {std::move(points), content_hash(file.str())};
}

}  // namespace cli
