// Tables of points: 3D Slicer's .fcsv, and .csv with the columns x, y, z (or r, a, s; l, p, s) and
// label, or without a header three numbers and at most one name a line.
#include <algorithm>

#include "base/error.h"
#include "base/utf8.h"
#include "formats/surface/cursor.h"
#include "formats/surface/parts.h"
#include "formats/text/decimal.h"
#include "formats/text/line.h"

namespace mvs::core {
namespace {

constexpr size_t no_column = SIZE_MAX;

struct TableRow {
  std::vector<std::string> fields;
  int32_t line = 0;
};

struct PointColumns {
  size_t axis[3] = {no_column, no_column, no_column};
  size_t label = no_column, defined = no_column;

  bool has_points() const {
    return std::find(std::begin(axis), std::end(axis), no_column) == std::end(axis);
  }
};

[[noreturn]] void fail_in_row(const TableRow &row, const std::string &sentence) {
  throw Error(MVS_E_FORMAT, "", sentence, row.line);
}

// The fields of a line; a field in quotation marks may hold the separator and "" for one mark.
std::vector<std::string> table_fields(std::string_view line, char separator) {
  std::vector<std::string> fields(1);
  bool in_quotes = false;
  for (size_t k = 0; k < line.size(); ++k) {
    if (line[k] == '"') {
      const bool is_mark = in_quotes && k + 1 < line.size() && line[k + 1] == '"';
      if (is_mark) fields.back() += line[++k];
      if (!is_mark) in_quotes = !in_quotes;
    } else if (line[k] == separator && !in_quotes) {
      // runs of blanks are one separator
      if (separator != ' ' || !fields.back().empty()) fields.emplace_back();
    } else {
      fields.back() += line[k];
    }
  }
  for (std::string &field : fields) field = without_blanks(field);
  if (separator == ' ' && fields.back().empty()) fields.pop_back();
  return fields;
}

char separator_of(std::string_view line) {
  for (const char separator : {';', '\t', ','}) {
    if (line.find(separator) != std::string_view::npos) return separator;
  }
  return ' ';
}

// The rows without comments, which go to `parts`; `header` is the last comment "columns = ...".
// Without a separator the first row decides.
std::vector<TableRow> table_rows(std::string_view bytes, SurfaceParts &parts, std::string &header,
                                 char separator = '\0') {
  std::vector<TableRow> rows;
  Cursor cursor(without_byte_order_mark(bytes));
  while (!cursor.at_end()) {
    const int32_t number = cursor.line_number();
    const std::string_view line = cursor.filled_line();
    if (line.starts_with('#')) {
      note_comment(parts, line);
      const size_t columns = in_small_letters(line).find("columns");
      const size_t equals = line.find('=');
      const bool is_header = columns != std::string::npos && equals != std::string_view::npos;
      if (is_header) header = without_blanks(line.substr(equals + 1));
      continue;
    }
    if (separator == '\0') separator = separator_of(line);
    rows.push_back({table_fields(line, separator), number});
  }
  return rows;
}

PointColumns named_columns(const std::vector<std::string> &names, SurfaceParts &parts) {
  struct Axes {
    const char *name[3];
    PatientFrame frame;
  };
  constexpr Axes known[] = {{{"x", "y", "z"}, PatientFrame::unknown},
                            {{"r", "a", "s"}, PatientFrame::ras},
                            {{"l", "p", "s"}, PatientFrame::lps}};
  std::vector<std::string> small;
  small.reserve(names.size());
  for (const std::string &name : names) small.push_back(in_small_letters(name));
  const auto column = [&](std::string_view name) {
    const auto found = std::find(small.begin(), small.end(), name);
    return found == small.end() ? no_column : static_cast<size_t>(found - small.begin());
  };
  PointColumns columns;
  columns.label = std::min(column("label"), column("name"));
  columns.defined = column("defined");
  for (const Axes &axes : known) {
    for (size_t c = 0; c < 3; ++c) columns.axis[c] = column(axes.name[c]);
    if (!columns.has_points()) continue;
    if (axes.frame != PatientFrame::unknown) parts.frame = axes.frame;
    return columns;
  }
  return columns;
}

// Columns of a table without a header: three numbers, and a name before or behind them.
PointColumns plain_columns(const TableRow &row) {
  PointColumns columns;
  size_t numbers = 0;
  for (size_t k = 0; k < row.fields.size(); ++k) {
    double value = 0;
    if (!parse_decimal(row.fields[k], value)) {
      if (columns.label == no_column) columns.label = k;
    } else if (numbers++ < 3) {
      columns.axis[numbers - 1] = k;
    }
  }
  if (numbers != 3) {
    fail_in_row(row, format("the line has %zu numbers, and no line above names the columns: begin "
                            "the table with the line `label,x,y,z`",
                            numbers));
  }
  return columns;
}

double coordinate_in(const TableRow &row, size_t column) {
  if (column >= row.fields.size()) {
    fail_in_row(row, format("the line has %zu fields, but coordinates stand in column %zu: it may "
                            "be cut short",
                            row.fields.size(), column + 1));
  }
  double value = 0;
  const std::string &field = row.fields[column];
  if (!parse_decimal(field, value)) {
    const char *hint = field.find(',') != std::string::npos ? ": the decimal mark is a point" : "";
    fail_in_row(row, format("%s is not a finite number%s", quoted(field).c_str(), hint));
  }
  return value;
}

void add_rows(const std::vector<TableRow> &rows, size_t first, const PointColumns &columns,
              SurfaceParts &parts) {
  for (size_t k = first; k < rows.size(); ++k) {
    const TableRow &row = rows[k];
    const bool is_defined =
        columns.defined >= row.fields.size() || row.fields[columns.defined] != "0";
    if (!is_defined) continue;
    double point[3];
    for (size_t c = 0; c < 3; ++c) point[c] = coordinate_in(row, columns.axis[c]);
    add_points(parts, point);
    if (columns.label == no_column) continue;
    const bool has_label = columns.label < row.fields.size();
    parts.point_names.push_back(has_label ? as_utf8(row.fields[columns.label]) : "");
  }
}

}  // namespace

// Fields are separated by commas, and descriptions may hold any other separator. The frame of older
// files is a number: 0 RAS, 1 LPS, 2 voxel indices.
SurfaceParts read_fcsv(std::string_view bytes) {
  SurfaceParts parts;
  parts.format = "FCSV";
  std::string header = "id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID";
  const std::vector<TableRow> rows = table_rows(bytes, parts, header, ',');
  const PointColumns columns = named_columns(table_fields(header, ','), parts);
  MVS_MUST(columns.has_points(), MVS_E_FORMAT, "columns",
           "the comment `columns` does not name x, y and z");
  for (const TableRow &row : rows) {
    if (row.fields.size() < 4) fail_in_row(row, "the line has fewer than four fields: cut short");
  }
  const std::string text = in_small_letters(bytes.substr(0, std::min<size_t>(bytes.size(), 2000)));
  const size_t key = text.find("coordinatesystem");
  const size_t equals = key == std::string::npos ? key : text.find('=', key);
  if (equals != std::string::npos) {
    const std::string word(Cursor(std::string_view(text).substr(equals + 1)).word());
    MVS_MUST(word != "2" && word != "ijk", MVS_E_UNSUPPORTED, "CoordinateSystem",
             "the points are voxel indices (IJK): save them in LPS or RAS");
    if (word == "0") parts.frame = PatientFrame::ras;
    if (word == "1") parts.frame = PatientFrame::lps;
  }
  add_rows(rows, 0, columns, parts);
  return parts;
}

SurfaceParts read_point_table(std::string_view bytes) {
  SurfaceParts parts;
  parts.format = "CSV";
  std::string header;
  const std::vector<TableRow> rows = table_rows(bytes, parts, header);
  if (rows.empty()) return parts;
  PointColumns columns = named_columns(rows[0].fields, parts);
  const bool has_header = columns.has_points();
  if (!has_header) columns = plain_columns(rows[0]);
  add_rows(rows, has_header ? 1 : 0, columns, parts);
  return parts;
}

}  // namespace mvs::core
