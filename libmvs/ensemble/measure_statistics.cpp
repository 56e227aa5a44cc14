// Statistics of each field of mvs_measures.
#include "ensemble/measure_statistics.h"

#include <mvs/ensemble.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mvs::core {
namespace {

using M = mvs_measures;

constexpr double M::*figures[] = {&M::regurgitant_orifice_area,
                                  &M::coaptation_area,
                                  &M::coaptation_length_mean,
                                  &M::coaptation_length_min,
                                  &M::coaptation_length_max,
                                  &M::coaptation_height,
                                  &M::coaptation_depth,
                                  &M::tenting_height,
                                  &M::tenting_area,
                                  &M::tenting_volume,
                                  &M::billow_height,
                                  &M::billow_volume,
                                  &M::annulus_ap,
                                  &M::annulus_cc,
                                  &M::annulus_perimeter,
                                  &M::annulus_area_3d,
                                  &M::annulus_area,
                                  &M::annulus_saddle_height,
                                  &M::annulus_nonplanar_angle,
                                  &M::max_chord_strain,
                                  &M::max_chord_tension,
                                  &M::max_leaflet_strain,
                                  &M::max_leaflet_stress,
                                  &M::leaflet_area};
constexpr uint32_t M::*counts[] = {&M::intersections, &M::chords_over_strain,
                                   &M::chords_over_tension};
static_assert(sizeof(M) == sizeof(uint32_t) + sizeof figures / sizeof figures[0] * sizeof(double) +
                               sizeof counts / sizeof counts[0] * sizeof(uint32_t),
              "every field but struct_size is in one of the two lists");

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

using Row = std::array<double, 5>;

// The statistics of one measure. NaN stands for a measure that a valve does not have.
Row row_of(const std::vector<double> &values) {
  Row row = {missing, missing, missing, missing, 0};
  double &count = row[MVS_ENSEMBLE_STATISTIC_COUNT - 1];
  double sum = 0, first = 0;
  for (const double v : values) {
    if (std::isnan(v)) continue;
    if (count == 0)
      first = row[MVS_ENSEMBLE_STATISTIC_MIN - 1] = row[MVS_ENSEMBLE_STATISTIC_MAX - 1] = v;
    row[MVS_ENSEMBLE_STATISTIC_MIN - 1] = std::min(row[MVS_ENSEMBLE_STATISTIC_MIN - 1], v);
    row[MVS_ENSEMBLE_STATISTIC_MAX - 1] = std::max(row[MVS_ENSEMBLE_STATISTIC_MAX - 1], v);
    // relative to the first value, so that equal values have that mean and a deviation of 0 exactly
    sum += v - first;
    ++count;
  }
  if (count == 0) return row;
  const double mean = first + sum / count;
  row[MVS_ENSEMBLE_STATISTIC_MEAN - 1] = mean;
  double squares = 0;
  for (const double v : values) squares += std::isnan(v) ? 0 : (v - mean) * (v - mean);
  if (count > 1) row[MVS_ENSEMBLE_STATISTIC_DEVIATION - 1] = std::sqrt(squares / (count - 1));
  return row;
}

uint32_t whole(double value) {
  return std::isnan(value) ? 0 : static_cast<uint32_t>(std::lround(value));
}

}  // namespace

Statistics statistics_of(const std::vector<const mvs_measures *> &valves) {
  Statistics statistics = {};
  std::vector<double> values(valves.size());
  for (mvs_measures &m : statistics) m.struct_size = sizeof m;
  for (double M::*figure : figures) {
    for (size_t k = 0; k < valves.size(); ++k) values[k] = valves[k]->*figure;
    const Row row = row_of(values);
    for (size_t s = 0; s < row.size(); ++s) statistics[s].*figure = row[s];
  }
  for (uint32_t M::*count : counts) {
    for (size_t k = 0; k < valves.size(); ++k) values[k] = valves[k]->*count;
    const Row row = row_of(values);
    for (size_t s = 0; s < row.size(); ++s) statistics[s].*count = whole(row[s]);
  }
  return statistics;
}

}  // namespace mvs::core
