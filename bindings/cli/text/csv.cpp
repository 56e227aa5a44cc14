#include "text/csv.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "text/replace_file.h"
#include "valve/host.h"

namespace cli {
namespace {

std::string csv_cell(std::string cell) {
  std::replace_if(
      cell.begin(), cell.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  if (cell.find_first_of(",\"") == std::string::npos) return cell;
  std::string quoted = "\"";
  for (const char c : cell) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

// The path of a file that can be read or does not exist.
const std::string &readable(const std::string &path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return path;
  if (!std::filesystem::is_regular_file(path, error) || !std::ifstream(path)) {
    fail(MVS_E_IO, "csv", path + ": cannot be read: give the name of a file");
  }
  return path;
}

std::string bytes_of(const std::string &path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream content;
  content << file.rdbuf();
  return content.str();
}

std::vector<std::string> complete_lines(const std::string &bytes) {
  std::vector<std::string> lines;
  size_t from = 0, to = 0;
  while ((to = bytes.find('\n', from)) != std::string::npos) {
    lines.push_back(bytes.substr(from, to - from));
    if (!lines.back().empty() && lines.back().back() == '\r') lines.back().pop_back();
    from = to + 1;
  }
  return lines;
}

// ", no \"files\"": the first of the columns that a table has not; "" if it has all.
std::string missing_column(const CsvRow &has, const CsvRow &columns) {
  for (const std::string &column : columns) {
    if (std::find(has.begin(), has.end(), column) == has.end()) return ", no \"" + column + "\"";
  }
  return "";
}

}  // namespace

std::string csv_line(const CsvRow &row) {
  std::string line;
  for (size_t k = 0; k < row.size(); ++k) line += (k == 0 ? "" : ",") + csv_cell(row[k]);
  return line;
}

CsvRow read_csv_line(const std::string &line) {
  CsvRow row(1);
  bool is_quoted = false;
  for (size_t k = 0; k < line.size(); ++k) {
    if (line[k] == '"' && is_quoted && k + 1 < line.size() && line[k + 1] == '"') {
      row.back() += line[++k];
    } else if (line[k] == '"') {
      is_quoted = !is_quoted;
    } else if (line[k] == ',' && !is_quoted) {
      row.emplace_back();
    } else {
      row.back() += line[k];
    }
  }
  return row;
}

CsvFile::CsvFile(const std::string &path, const CsvRow &columns)
    : path_(path), lock_(readable(path)), columns_(columns) {
  const std::string bytes = bytes_of(path);
  const std::vector<std::string> lines = complete_lines(bytes);
  // a program that was stopped while it wrote the first line leaves the beginning of it
  const bool is_ours =
      lines.empty() ? csv_line(columns).rfind(bytes, 0) == 0 : read_csv_line(lines[0]) == columns;
  if (!is_ours) {
    fail(MVS_E_FORMAT, "csv",
         path + ": has other columns than this sweep" +
             (lines.empty() ? "" : missing_column(read_csv_line(lines[0]), columns)) +
             ": give the name of another file",
         1);
  }
  for (size_t k = 1; k < lines.size(); ++k) {
    rows_.push_back(read_csv_line(lines[k]));
    if (rows_.back().size() == columns.size()) continue;
    fail(MVS_E_FORMAT, "csv", path + ": line " + std::to_string(k + 1) + " is not of this sweep",
         static_cast<int32_t>(k + 1));
  }
  rewrite(rows_);  // without an incomplete last line
}

void CsvFile::append(const CsvRow &row) {
  std::ofstream file(path_, std::ios::binary | std::ios::app);
  file << csv_line(row) + "\n" << std::flush;
  if (!file) fail(MVS_E_IO, "csv", path_ + ": cannot be written: " + std::strerror(errno));
  rows_.push_back(row);
}

void CsvFile::rewrite(std::vector<CsvRow> rows) {
  std::string content = csv_line(columns_) + "\n";
  for (const CsvRow &row : rows) content += csv_line(row) + "\n";
  replace_file(path_, content, "csv", [this](int file) { lock_.take_over(file); });
  lock_.keep();
  rows_ = std::move(rows);
}

}  // namespace cli
