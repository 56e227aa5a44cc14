// A table that is printed row by row, and written as CSV if a file is named.
#pragma once

#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace bench {

// A figure or a word; figures to four digits.
struct Cell {
  Cell(const char *word) : text(word), is_word(true) {}
  Cell(std::string word) : text(std::move(word)), is_word(true) {}
  Cell(bool yes) : text(yes ? "yes" : "NO"), is_word(true) {}
  template <typename Number, std::enable_if_t<std::is_arithmetic_v<Number>, int> = 0>
  Cell(Number number) {
    char digits[40];
    std::snprintf(digits, sizeof digits, std::is_integral_v<Number> ? "%.0f" : "%.4g",
                  static_cast<double>(number));
    text = digits;
  }
  std::string text;
  bool is_word = false;
};

class Table {
 public:
  // A column is as wide as its name with its trailing blanks, and at least eight; `csv` may be
  // empty.
  explicit Table(std::vector<std::string> columns, const std::string &csv = "")
      : columns_(std::move(columns)), path_(csv) {
    if (!path_.empty()) file_.open(path_);
    if (!path_.empty() && !file_) throw std::runtime_error("could not write " + path_);
    std::vector<Cell> heads;
    for (const std::string &name : columns_) {
      heads.emplace_back(name.substr(0, name.find_last_not_of(' ') + 1));
      heads.back().is_word = name.back() == ' ';
    }
    row(heads);
  }

  void row(const std::vector<Cell> &cells) {
    if (cells.size() != columns_.size()) throw std::logic_error("a row is not as its table");
    for (size_t k = 0; k < cells.size(); ++k) {
      const int width = static_cast<int>(std::max<size_t>(columns_[k].size(), 8));
      std::printf(cells[k].is_word ? "%s%-*s" : "%s%*s", k ? "  " : "", width,
                  cells[k].text.c_str());
      if (file_.is_open()) file_ << (k ? "," : "") << cells[k].text;
    }
    std::printf("\n");
    std::fflush(stdout);
    if (file_.is_open() && !(file_ << std::endl))
      throw std::runtime_error("could not write " + path_);
  }

 private:
  std::vector<std::string> columns_;
  std::string path_;
  std::ofstream file_;
};

}  // namespace bench
