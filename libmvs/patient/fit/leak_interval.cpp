// Closures from open and their orifices.
#include "patient/fit/leak_interval.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "measure/orifice/orifice.h"
#include "patient/chordae/chord_groups.h"
#include "patient/fit/closure.h"
#include "patient/fit/free_edge_shift.h"
#include "patient/fit/thickness_range.h"
#include "patient/normal_numbers.h"

namespace mvs::core {
namespace {

// Confidence of a leak that does not depend on the lengths, and the difference at which none is
// left: grades of regurgitation are 10 to 20 mm2 apart (0.2, 0.3, 0.4 cm2).
constexpr double same_leak_confidence = 0.8, unknown_leak = 20e-6;
// m2, by which meshes of one valve differ: a valve with less is sealed.
constexpr double sealed = 0.5e-6;
constexpr double least_thickness = 0.3;  // share of the thickness that thinner tissue keeps
constexpr uint32_t most_draws = 6;
constexpr double widening = 0.25;  // of the range, on both sides
constexpr uint64_t seed = 22;
const double half_range = std::sqrt(3.0);  // of a uniform deviate, in standard deviations

struct Closed {
  double leak;
  bool at_rest;
  uint32_t iterations;
};
// The change of the valve in a closure of the interval.
struct ClosureChange {
  std::vector<double> factor;  // on the length of each chord; empty: 1
  double edge = 0;             // m, farther out
  double thickness = 1;        // factor
};

Closed close_with(const Valve &valve, const ClosureChange &change, const EdgeRange &range,
                  const Progress &progress) {
  const auto &[factor, by, thickness] = change;
  const bool moves = range.geometry && by != 0;
  Valve changed = moves ? with_edge_moved(valve, *range.geometry, by) : valve;
  if (thickness != 1) changed = with_thickness(changed, thickness);
  for (size_t c = 0; c < factor.size(); ++c) changed.chords[c].rest_length *= factor[c];
  Solver solver(Backend::fastest);
  try {
    const ClosedValve closed =
        close_open(solver, make_model(std::move(changed)), systolic_pressure, progress);
    return {measure_orifice(*closed.model, closed.state.x).area, closed.stats.converged,
            closed.stats.iterations};
  } catch (const Error &error) {
    // the valve is built all the same: its closure is the caller's
    if (error.code != MVS_E_DIVERGED) throw;
    return {0, false, 0};
  }
}

std::vector<double> drawn_factors(const std::vector<ChordGroup> &groups, const LengthRange &range,
                                  size_t chords, NormalNumbers &random) {
  const auto deviate = [&](double half) { return half * (2 * random.uniform() - 1); };
  std::vector<double> factor(chords, 1);
  for (size_t g = 0; g < groups.size(); ++g) {
    const double shared = 1 + deviate(g < range.group.size() ? range.group[g] : range.all);
    for (const uint32_t c : groups[g].chords) factor[c] = shared * (1 + deviate(range.single));
  }
  return factor;
}

std::string ranges_of(const LeakInterval &interval, const EdgeRange &edge, double thickness_error) {
  std::string ranges = "lengths of chordae within that range";
  if (edge.geometry) {
    ranges += format(
        ", a free edge up to %.1f mm farther out (%.1f mm2 with the lengths as they are) or "
        "%.1f mm farther in (%.1f mm2)",
        edge.out * 1e3, interval.edge_leak[0] * 1e6, edge.in * 1e3, interval.edge_leak[1] * 1e6);
  }
  if (thickness_error > 0) {
    ranges +=
        format(", tissue up to %.2f mm thicker (%.1f mm2) or thinner (%.1f mm2)",
               thickness_error * 1e3, interval.tissue_leak[0] * 1e6, interval.tissue_leak[1] * 1e6);
  }
  return ranges;
}

void report(const LeakInterval &interval, const EdgeRange &edge, double thickness_error,
            bool at_rest, Findings &findings) {
  const double unsure = std::min(1.0, (interval.most - interval.least) / unknown_leak);
  const double confidence = same_leak_confidence * (1 - unsure) * (at_rest ? 1 : 0.5);
  const auto &[f0, f1, f2] = interval.factor;
  findings.push_back(
      {"leak",
       FindingSource::measured,
       confidence,
       format("regurgitant orifice at 120 mmHg with chordae of %.0f, %.0f and %.0f %% of their "
              "lengths: %.1f, %.1f and %.1f mm2%s; lengths are known to that range only, so one of "
              "these numbers alone says little",
              100 * f0, 100 * f1, 100 * f2, interval.leak[0] * 1e6, interval.leak[1] * 1e6,
              interval.leak[2] * 1e6, at_rest ? "" : ", not all of them at rest"),
       {interval.leak.begin(), interval.leak.end()},
       "m2"});
  findings.push_back(
      {"leak_interval",
       FindingSource::measured,
       confidence,
       format(
           "%.1f to %.1f mm2 for %s%s", interval.least * 1e6, interval.most * 1e6,
           ranges_of(interval, edge, thickness_error).c_str(),
           interval.draws == 0
               ? ": sealed with all of them"
               : format("; %u closures with random ones are among them", interval.draws).c_str()),
       {interval.least, interval.most},
       "m2"});
}

}  // namespace

LengthRange range_after(const ChordFit &fit) {
  LengthRange range;
  double sum = 0;
  for (const double deviation : fit.deviation) {
    range.group.push_back(std::min(range.all, half_range * deviation));
    sum += range.group.back() * range.group.back();
  }
  // of the mean of independent factors; as a common factor, their errors would never cancel
  range.all = std::sqrt(sum) / static_cast<double>(fit.deviation.size());
  return range;
}

LeakInterval leak_interval(const ModelPtr &model, const LengthRange &range, const EdgeRange &edge,
                           double thickness_error, const std::vector<double> &known,
                           Findings &findings, const std::function<void(double)> &tell) {
  const size_t chords = model->valve.chords.size();
  LeakInterval interval;
  interval.factor = {1 - range.all, 1, 1 + range.all};
  bool at_rest = true;
  std::vector<double> leaks = known;
  uint32_t number = 0;
  const uint32_t closures =
      3 + (edge.geometry ? 2 : 0) + (thickness_error > 0 ? 2 : 0) + most_draws;
  const auto close = [&](const ClosureChange &change) {
    const auto share_done = [&](double share, double) {
      if (tell) tell((number + share) / closures);
      return true;
    };
    share_done(0, 0);
    const Closed closed = close_with(model->valve, change, edge, share_done);
    ++number;
    if (closed.at_rest) leaks.push_back(closed.leak);
    at_rest = at_rest && closed.at_rest;
    return closed;
  };
  for (size_t k = 0; k < 3; ++k) {
    const Closed closed = close({std::vector<double>(chords, interval.factor[k])});
    interval.leak[k] = closed.leak;
    interval.at_rest[k] = closed.at_rest;
    interval.iterations[k] = closed.iterations;
  }
  for (size_t k = 0; edge.geometry && k < 2; ++k) {
    interval.edge_leak[k] = close({{}, k == 0 ? edge.out : -edge.in}).leak;
  }
  const double spread = thickness_error / mean_thickness(model->valve);
  const auto thickness = [&](double by) { return std::max(least_thickness, 1 + by * spread); };
  for (size_t k = 0; thickness_error > 0 && k < 2; ++k) {
    interval.tissue_leak[k] = close({{}, 0, thickness(k == 0 ? 1 : -1)}).leak;
  }
  const bool is_sealed = at_rest && *std::max_element(leaks.begin(), leaks.end()) < sealed;
  NormalNumbers random(seed);
  const std::vector<ChordGroup> groups = chord_groups(*model, ChordGrouping::halves);
  for (; !is_sealed && interval.draws < most_draws; ++interval.draws) {
    ClosureChange change{drawn_factors(groups, range, chords, random)};
    if (edge.geometry) change.edge = random.uniform() * (edge.out + edge.in) - edge.in;
    if (thickness_error > 0) change.thickness = thickness(2 * random.uniform() - 1);
    close(change);
  }
  if (leaks.empty()) leaks.assign(interval.leak.begin(), interval.leak.end());
  const auto [least, most] = std::minmax_element(leaks.begin(), leaks.end());
  const double more = sealed + (is_sealed ? 0 : widening * (*most - *least));
  interval.least = std::max(0.0, *least - more);
  interval.most = *most + more;
  report(interval, edge, thickness_error, at_rest, findings);
  return interval;
}

}  // namespace mvs::core
