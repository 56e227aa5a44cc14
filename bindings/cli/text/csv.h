// Comma-separated values (RFC 4180) with one row a line: rows in memory, and a table in a file to
// which rows are appended.
#pragma once

#include <string>
#include <vector>

#include "text/table_lock.h"

namespace cli {

using CsvRow = std::vector<std::string>;

// A row without its line break. Line breaks in cells become blanks.
std::string csv_line(const CsvRow &row);
CsvRow read_csv_line(const std::string &line);

// A table whose first row names its columns. A last line without its end, which a stopped program
// leaves, is no row. The file is locked: no other process appends to it.
class CsvFile {
 public:
  // Reads the rows of an existing file. Throws mvs::Error if the file cannot be read, has other
  // columns, or is locked by another process.
  CsvFile(const std::string &path, const CsvRow &columns);

  const std::vector<CsvRow> &rows() const { return rows_; }
  // Adds a row to the end of the file at once.
  void append(const CsvRow &row);
  // Replaces the file by these rows, by way of a new file beside it.
  void rewrite(std::vector<CsvRow> rows);

 private:
  std::string path_;
  TableLock lock_;
  CsvRow columns_;
  std::vector<CsvRow> rows_;
};

}  // namespace cli
