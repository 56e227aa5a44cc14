#include "text/sweep_grid.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>

#include "text/command_units.h"
#include "text/console.h"
#include "text/op_forms.h"

namespace cli {
namespace {

constexpr size_t most_values = 1000, most_combinations = 100000;

bool is_number(const mvs_field_info &field) {
  return field.type == MVS_FIELD_NUMBER || field.type == MVS_FIELD_COUNT;
}

// The shortest usual form, so that 0.70 and 0.7 are one combination.
std::string plain_number(double value) {
  return text("%.12g", value);
}

std::vector<std::string> read_range(const std::string &given) {
  const std::vector<std::string> parts = split(given, ':');
  double first = 0, last = 0, step = 0;
  if (parts.size() != 3 || !read_number(parts[0], first) || !read_number(parts[1], last) ||
      !read_number(parts[2], step)) {
    throw std::invalid_argument("'" + given + "' is not a range FIRST:LAST:STEP");
  }
  // a last value that rounding has moved behind the end by 1e-9 of a step still belongs to it
  const double steps = std::floor((last - first) / step + 1e-9);
  if (!(steps >= 0 && steps < most_values)) {
    throw std::invalid_argument(
        text("the range '%s' does not lead from its first to its last "
             "value in at most %zu steps",
             given.c_str(), most_values));
  }
  std::vector<std::string> values;
  for (uint32_t k = 0; k <= static_cast<uint32_t>(steps); ++k) {
    values.push_back(plain_number(first + k * step));
  }
  return values;
}

std::vector<std::string> read_values(const mvs_field_info &field, const std::string &given) {
  const bool is_triple = field.type == MVS_FIELD_POINT || field.type == MVS_FIELD_VECTOR;
  std::vector<std::string> values;
  for (const std::string &item : split(given, is_triple ? ';' : ',')) {
    double number = 0;
    if (is_number(field) && item.find(':') != std::string::npos) {
      const std::vector<std::string> range = read_range(item);
      values.insert(values.end(), range.begin(), range.end());
    } else {
      values.push_back(is_number(field) && read_number(item, number) ? plain_number(number) : item);
    }
  }
  for (const std::string &value : values) {
    const std::string wrong = complaint(field, value);
    if (!wrong.empty()) throw std::invalid_argument(std::string(field.name) + ": " + wrong);
    if (std::count(values.begin(), values.end(), value) > 1) {
      throw std::invalid_argument(std::string(field.name) + ": the value " + value +
                                  " is given twice");
    }
  }
  return values;
}

std::string underscored(std::string name) {
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

// The row of `all` with this name; the sentence lists all names.
template <typename Rows, typename Name>
const auto &named(const Rows &all, const std::string &given, const std::string &what, Name name) {
  std::string names;
  for (const auto &row : all) {
    if (underscored(given) == name(row)) return row;
    names += (names.empty() ? "" : ", ") + std::string(name(row));
  }
  throw std::invalid_argument("'" + given + "' is no " + what + "; choose from: " + names);
}

SweepAxis read_axis(const SweepOp &op, const std::string &word) {
  const size_t sign = word.find('=');
  if (sign == std::string::npos) {
    throw std::invalid_argument("'" + word + "' is not of the form FIELD=VALUES");
  }
  const mvs_field_info &field =
      named(op.kind.fields, word.substr(0, sign), std::string("field of ") + op.kind.info.name,
            [](const mvs_field_info &f) { return f.name; });
  for (const SweepAxis &axis : op.axes) {
    if (axis.field.offset == field.offset) {
      throw std::invalid_argument(std::string(field.name) + " is given twice");
    }
  }
  return {field, read_values(field, word.substr(sign + 1))};
}

}  // namespace

SweepOp read_sweep_op(const std::string &given) {
  static const std::vector<mvs::OpKind> kinds = mvs::op_kinds();
  std::istringstream words(given);
  std::string word;
  words >> word;
  SweepOp op = {
      named(kinds, word, "operation", [](const mvs::OpKind &kind) { return kind.info.name; }), {}};
  while (words >> word) op.axes.push_back(read_axis(op, word));
  for (const mvs_field_info &field : op.kind.fields) {
    const bool is_given = std::any_of(op.axes.begin(), op.axes.end(), [&](const SweepAxis &axis) {
      return axis.field.offset == field.offset;
    });
    if (field.required && !is_given) {
      throw std::invalid_argument(std::string(op.kind.info.name) + " needs " + field.name + "=" +
                                  form_of(field));
    }
  }
  return op;
}

SweepGrid::SweepGrid(std::vector<SweepOp> ops) : ops_(std::move(ops)) {
  for (const SweepOp &op : ops_) {
    for (const SweepAxis &axis : op.axes) count_ *= axis.values.size();
    if (count_ > most_combinations) {
      throw std::invalid_argument(
          text("more than %zu combinations: give fewer values", most_combinations));
    }
  }
  for (const SweepOp &op : ops_) {
    for (const SweepAxis &axis : op.axes) {
      if (axis.field.type != MVS_FIELD_POINTS) continue;
      for (const std::string &path : axis.values) files_.emplace(path, read_points_file(path));
    }
  }
}

std::vector<std::string> SweepGrid::columns() const {
  std::vector<std::string> columns;
  std::map<std::string, int> uses;
  for (const SweepOp &op : ops_) {
    std::string name = op.kind.info.name;
    if (const int use = ++uses[name]; use > 1) name += "_" + std::to_string(use);
    for (const SweepAxis &axis : op.axes) {
      const std::string unit = *axis.field.unit ? unit_in_text(axis.field) : "";
      columns.push_back(name + "_" + axis.field.name + (unit.empty() ? "" : "_" + unit));
    }
  }
  return columns;
}

std::vector<bool> SweepGrid::has_numbers() const {
  std::vector<bool> numbers;
  for (const SweepOp &op : ops_) {
    for (const SweepAxis &axis : op.axes) numbers.push_back(is_number(axis.field));
  }
  return numbers;
}

std::vector<std::string> SweepGrid::values(size_t combination) const {
  std::vector<std::string> values;
  for (auto op = ops_.rbegin(); op != ops_.rend(); ++op) {
    for (auto axis = op->axes.rbegin(); axis != op->axes.rend(); ++axis) {
      values.push_back(axis->values[combination % axis->values.size()]);
      combination /= axis->values.size();
    }
  }
  std::reverse(values.begin(), values.end());
  return values;
}

std::string SweepGrid::files(size_t combination) const {
  const std::vector<std::string> all = values(combination);
  auto value = all.begin();
  std::string hashes;
  for (const SweepOp &op : ops_) {
    for (const SweepAxis &axis : op.axes) {
      const std::string &given = *value++;
      if (axis.field.type != MVS_FIELD_POINTS) continue;
      hashes += (hashes.empty() ? "" : " ") + files_.at(given).hash;
    }
  }
  return hashes;
}

void SweepGrid::apply(size_t combination, mvs::Simulator &sim) const {
  const std::vector<std::string> all = values(combination);
  auto value = all.begin();
  for (const SweepOp &op : ops_) {
    OpText given(op.kind);
    const mvs::Snapshot valve = sim.snapshot();
    for (const SweepAxis &axis : op.axes) {
      const std::string &word = *value++;
      if (axis.field.type == MVS_FIELD_POINTS) {
        given.set_points(axis.field, files_.at(word).points);
      } else {
        given.set(axis.field.name, word, valve);
      }
    }
    with_command_units([&] { return sim.apply(given.get()); });
  }
}

}  // namespace cli
