// Statistics of each field of mvs_measures.
#include "ensemble/measure_statistics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "base/struct_fields.h"

namespace mvs::core {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

using Row = std::array<double, 5>;

// The statistics of one measure. NaN stands for a measure that a valve does not have.
Row row_of(const std::vector<double> &values) {
  Row row = {missing, missing, missing, missing, 0};
  auto &[mean, least, most, deviation, count] = row;
  double sum = 0, first = 0;
  for (const double v : values) {
    if (std::isnan(v)) continue;
    if (count == 0) first = least = most = v;
    least = std::min(least, v);
    most = std::max(most, v);
    // relative to the first value, so that equal values have that mean and a deviation of 0 exactly
    sum += v - first;
    ++count;
  }
  if (count == 0) return row;
  mean = first + sum / count;
  double squares = 0;
  for (const double v : values) squares += std::isnan(v) ? 0 : (v - mean) * (v - mean);
  if (count > 1) deviation = std::sqrt(squares / (count - 1));
  return row;
}

// The value of a measure; NaN for the depth of a coaptation that is not there (DEFINITIONS.md).
double value_in(const mvs_measures &valve, const mvs_field_info &field) {
  const double value = read_field(&valve, field);
  const bool is_depth = field.offset == offsetof(mvs_measures, coaptation_depth);
  return is_depth && value == 0 && valve.coaptation_height == 0 ? missing : value;
}

}  // namespace

Statistics statistics_of(const std::vector<const mvs_measures *> &valves) {
  Statistics statistics = {};
  std::vector<double> values(valves.size());
  for (mvs_measures &m : statistics) m.struct_size = sizeof m;
  for (const mvs_field_info &field : struct_fields(MVS_STRUCT_MEASURES)) {
    for (size_t k = 0; k < valves.size(); ++k) values[k] = value_in(*valves[k], field);
    const Row row = row_of(values);
    const bool count = field.type == MVS_FIELD_COUNT;
    for (size_t s = 0; s < row.size(); ++s) {
      const double whole = std::isnan(row[s]) ? 0 : std::round(row[s]);
      write_field(&statistics[s], field, count ? whole : row[s]);
    }
  }
  return statistics;
}

}  // namespace mvs::core
