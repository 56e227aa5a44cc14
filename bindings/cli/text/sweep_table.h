// The table of a sweep: one row for each combination, in a CSV file that a later run continues.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "text/console.h"
#include "text/csv.h"
#include "text/sweep_grid.h"

namespace cli {

// The columns between "converged" and "pressure_mmHg": all measures with their units; with `cost`
// the cost of a repair, too.
std::vector<std::string> measure_keys(bool cost);

// A number as in JSON; "" for null.
std::string cell_of(const Json &value);

// The conditions of all rows of a table.
struct SweepConditions {
  std::string valve;  // hash of the valve in the file
  double pressure_mmhg = 0;
  std::string cost;  // how costs are measured, in words; "": they are not
};

// Columns: the parameters, "converged", the measures, "pressure_mmHg", "valve", with files of
// points "files", which has the hashes of their contents, with costs "cost", "error".
class SweepTable {
 public:
  // Reads the rows of an existing file. Throws mvs::Error if it has other columns, rows of other
  // conditions, or rows of the grid whose files had other contents.
  SweepTable(const SweepGrid &grid, const std::string &path, const SweepConditions &conditions);

  const CsvRow &columns() const { return columns_; }
  // Whether the cells of a column are text, also those that look like numbers.
  bool is_text(size_t column) const;
  const std::string &cell(const CsvRow &row, const std::string &column) const;
  // The combinations of the grid without a row.
  std::vector<size_t> missing() const;
  // The rows of the grid.
  std::vector<CsvRow> rows() const;
  bool is_at_rest(const CsvRow &row) const;
  // At most `most` rows at rest, sorted by a measure.
  std::vector<CsvRow> best(const std::string &measure, bool largest_first, size_t most) const;

  // Adds a row to the file.
  void append(const std::string &line) { file_.append(read_csv_line(line)); }
  // Sorts the file: rows of the grid in the order of the combinations, then those of other grids.
  void sort();

 private:
  bool has_conditions(const CsvRow &row, const SweepGrid &grid,
                      const SweepConditions &conditions) const;
  CsvRow key(const CsvRow &row) const;
  size_t place(const CsvRow &row) const;

  CsvRow columns_;
  size_t parameters_;              // the first columns
  std::vector<bool> has_numbers_;  // of the parameters
  CsvFile file_;
  std::map<CsvRow, size_t> order_;  // of the combinations, by their values
};

}  // namespace cli
