#include "text/sweep_table.h"

#include <algorithm>

#include "text/op_forms.h"
#include "text/readouts.h"

namespace cli {
namespace {

CsvRow sweep_columns(const SweepGrid &grid, bool cost) {
  CsvRow columns = grid.columns();
  columns.emplace_back("converged");
  for (const std::string &key : measure_keys(cost)) columns.push_back(key);
  for (const char *last : {"pressure_mmHg", "valve"}) columns.emplace_back(last);
  if (grid.has_files()) columns.emplace_back("files");
  if (cost) columns.emplace_back("cost");
  columns.emplace_back("error");
  return columns;
}

}  // namespace

std::vector<std::string> measure_keys(bool cost) {
  std::vector<std::string> keys = {"residual_N", "intersections"};
  const mvs_cost costs = {};
  const Json figures = figures_json({}, cost ? &costs : nullptr);
  for (const auto &[key, value] : figures.items()) keys.push_back(key);
  return keys;
}

std::string cell_of(const Json &value) {
  if (value.is_string()) return value.get<std::string>();
  return value.is_null() ? "" : value.dump();
}

SweepTable::SweepTable(const SweepGrid &grid, const std::string &path,
                       const SweepConditions &conditions)
    : columns_(sweep_columns(grid, !conditions.cost.empty())),
      parameters_(grid.columns().size()),
      has_numbers_(grid.has_numbers()),
      file_(path, columns_) {
  for (size_t k = 0; k < grid.combinations(); ++k) order_[grid.values(k)] = k;
  for (const CsvRow &row : file_.rows()) {
    if (has_conditions(row, grid, conditions)) continue;
    fail(MVS_E_FORMAT, "csv",
         path +
             ": holds rows of another valve or pressure, other options of costs, or files with "
             "other contents: give the name of another file");
  }
}

bool SweepTable::has_conditions(const CsvRow &row, const SweepGrid &grid,
                                const SweepConditions &conditions) const {
  if (cell(row, "valve") != conditions.valve) return false;
  if (cell(row, "pressure_mmHg") != cell_of(conditions.pressure_mmhg)) return false;
  if (!conditions.cost.empty() && cell(row, "cost") != conditions.cost) return false;
  const auto combination = order_.find(key(row));
  return !grid.has_files() || combination == order_.end() ||
         cell(row, "files") == grid.files(combination->second);
}

bool SweepTable::is_text(size_t column) const {
  if (column < parameters_) return !has_numbers_[column];
  const std::string &name = columns_[column];
  return name == "valve" || name == "files" || name == "cost" || name == "error";
}

const std::string &SweepTable::cell(const CsvRow &row, const std::string &column) const {
  return row[std::find(columns_.begin(), columns_.end(), column) - columns_.begin()];
}

std::vector<size_t> SweepTable::missing() const {
  std::map<CsvRow, size_t> left = order_;
  for (const CsvRow &row : file_.rows()) left.erase(key(row));
  std::vector<size_t> all;
  all.reserve(left.size());
  for (const auto &[values, combination] : left) all.push_back(combination);
  std::sort(all.begin(), all.end());
  return all;
}

std::vector<CsvRow> SweepTable::rows() const {
  std::vector<CsvRow> rows;
  for (const CsvRow &row : file_.rows()) {
    if (order_.count(key(row))) rows.push_back(row);
  }
  return rows;
}

bool SweepTable::is_at_rest(const CsvRow &row) const {
  const std::string &converged = cell(row, "converged");
  return converged == "true" || converged == "1";  // "1": of an older table
}

std::vector<CsvRow> SweepTable::best(const std::string &measure, bool largest_first,
                                     size_t most) const {
  std::vector<std::pair<double, CsvRow>> found;
  for (const CsvRow &row : rows()) {
    double value = 0;
    if (!is_at_rest(row) || !read_number(cell(row, measure), value)) continue;
    found.emplace_back(largest_first ? -value : value, row);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto &a, const auto &b) { return a.first < b.first; });
  std::vector<CsvRow> best;
  for (size_t k = 0; k < found.size() && k < most; ++k) best.push_back(found[k].second);
  return best;
}

void SweepTable::sort() {
  std::vector<CsvRow> rows = file_.rows();
  std::stable_sort(rows.begin(), rows.end(),
                   [&](const CsvRow &a, const CsvRow &b) { return place(a) < place(b); });
  file_.rewrite(std::move(rows));
}

CsvRow SweepTable::key(const CsvRow &row) const {
  return {row.begin(), row.begin() + static_cast<ptrdiff_t>(parameters_)};
}

size_t SweepTable::place(const CsvRow &row) const {
  const auto found = order_.find(key(row));
  return found == order_.end() ? order_.size() : found->second;
}

}  // namespace cli
