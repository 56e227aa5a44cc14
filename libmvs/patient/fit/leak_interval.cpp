// Closures from open and their orifices.
#include "patient/fit/leak_interval.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "measure/orifice/orifice.h"
#include "patient/chordae/chord_groups.h"
#include "patient/fit/closure.h"
#include "patient/fit/free_edge_shift.h"
#include "patient/fit/leak_report.h"
#include "patient/fit/shown_gaps.h"
#include "patient/fit/thickness_range.h"
#include "patient/normal_numbers.h"

namespace mvs::core {
namespace {

constexpr double least_thickness = 0.3;  // share of the thickness that thinner tissue keeps
constexpr uint32_t most_draws = 6;
// The bound of one closure. Closures of sound valves come to rest after 30 to 180 iterations; ten
// closures of a valve that creeps would take minutes.
constexpr uint32_t most_iterations = 400;
constexpr double widening = 0.25;  // of the range, on both sides
constexpr uint64_t seed = 22;
const double half_range = std::sqrt(3.0);  // of a uniform deviate, in standard deviations

struct Closed {
  double leak = NAN;  // of a closure that diverged, which has no shape
  bool at_rest = false;
  uint32_t iterations = 0;
  std::vector<Vec3> x;  // m
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
    const ClosedValve closed = close_open(solver, make_model(std::move(changed)), systolic_pressure,
                                          progress, most_iterations);
    return {measure_orifice(*closed.model, closed.state.x).area, closed.stats.converged,
            closed.stats.iterations, closed.state.x};
  } catch (const Error &error) {
    // the valve is built all the same: its closure is the caller's
    if (error.code != MVS_E_DIVERGED) throw;
    return {};
  }
}

// Closures of one valve with changes, and the leaks found so far.
class Closures {
 public:
  // `known`: leaks of closures at rest. `tell` gets the number of closures that are done.
  Closures(const Model &model, const EdgeRange &edge, const std::vector<double> &known,
           std::function<void(double)> tell)
      : model_(model), edge_(edge), tell_(std::move(tell)), leaks_(known), leaks_at_rest_(known) {}

  Closed close(const ClosureChange &change) {
    const auto share_done = [&](double share, double) {
      tell_(count_ + share);
      return true;
    };
    share_done(0, 0);
    Closed closed = close_with(model_.valve, change, edge_, share_done);
    ++count_;
    leaks_.push_back(closed.leak);
    if (closed.at_rest) {
      ++rests_;
      leaks_at_rest_.push_back(closed.leak);
    }
    return closed;
  }

  uint32_t count() const { return count_; }
  uint32_t rests() const { return rests_; }  // closures that came to rest
  const std::vector<double> &leaks() const { return leaks_; }
  const std::vector<double> &leaks_at_rest() const { return leaks_at_rest_; }

 private:
  const Model &model_;
  const EdgeRange &edge_;
  std::function<void(double)> tell_;
  uint32_t count_ = 0, rests_ = 0;
  std::vector<double> leaks_, leaks_at_rest_;  // m2
};

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

// From the leaks of closures at rest to a little beyond them, for the few that were tried.
void set_range(LeakInterval &interval, const std::vector<double> &leaks, bool is_sealed) {
  const auto [least, most] = std::minmax_element(leaks.begin(), leaks.end());
  const double more = sealed_leak + (is_sealed ? 0 : widening * (*most - *least));
  interval.least = std::max(0.0, *least - more);
  interval.most = *most + more;
}

}  // namespace

bool all_seal(const std::vector<double> &leaks) {
  return std::all_of(leaks.begin(), leaks.end(), [](double leak) { return leak < sealed_leak; });
}

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

void add_shape_error(LeakInterval &interval) {
  const double leak = interval.leak[1];
  const auto together = [](double a, double b) {
    const double positive = std::max(0.0, a);
    return std::sqrt(positive * positive + b * b);
  };
  const double down = together(leak - interval.least, leak - interval.shape.least);
  const double up = together(interval.most - leak, interval.shape.most - leak);
  interval.least = std::max(0.0, std::min(interval.least, leak - down));
  interval.most = std::max(interval.most, leak + up);
}

void reach_to(const ShownGaps &shown, LeakInterval &interval) {
  if (shown.most == 0) return;
  interval.shown = {shown.least, shown.most};
  interval.least = std::min(interval.least, shown.least);
  interval.most = std::max(interval.most, shown.most);
}

LeakInterval leak_interval(const ModelPtr &model, const LeakUnknowns &unknowns,
                           const std::vector<double> &known, Findings &findings,
                           const std::function<void(double)> &tell) {
  const LengthRange &range = unknowns.lengths;
  const EdgeRange &edge = unknowns.edge;
  const double thickness_error = unknowns.thickness_error;
  const size_t chords = model->valve.chords.size();
  const uint32_t most = 3 + (edge.geometry ? 2 : 0) + (thickness_error > 0 ? 2 : 0) + most_draws;
  LeakInterval interval;
  interval.factor = {1 - range.all, 1, 1 + range.all};
  Closures closures(*model, edge, known, [&](double done) {
    if (tell) tell(done / most);
  });
  std::vector<Vec3> as_it_is;
  for (size_t k = 0; k < 3; ++k) {
    Closed closed = closures.close({std::vector<double>(chords, interval.factor[k])});
    interval.leak[k] = closed.leak;
    interval.at_rest[k] = closed.at_rest;
    interval.iterations[k] = closed.iterations;
    if (k == 1) as_it_is = std::move(closed.x);
  }
  for (size_t k = 0; edge.geometry && k < 2; ++k) {
    interval.edge_leak[k] = closures.close({{}, k == 0 ? edge.out : -edge.in}).leak;
  }
  const double spread = thickness_error / mean_thickness(model->valve);
  const auto thickness = [&](double by) { return std::max(least_thickness, 1 + by * spread); };
  for (size_t k = 0; thickness_error > 0 && k < 2; ++k) {
    interval.tissue_leak[k] = closures.close({{}, 0, thickness(k == 0 ? 1 : -1)}).leak;
  }
  const bool is_sealed = closures.rests() > 0 && all_seal(closures.leaks());
  const bool is_worth_draws = closures.rests() > 0 && !is_sealed;
  NormalNumbers random(seed);
  const std::vector<ChordGroup> groups = chord_groups(*model, ChordGrouping::halves);
  for (; is_worth_draws && interval.draws < most_draws; ++interval.draws) {
    ClosureChange change{drawn_factors(groups, range, chords, random)};
    if (edge.geometry) change.edge = random.uniform() * (edge.out + edge.in) - edge.in;
    if (thickness_error > 0) change.thickness = thickness(2 * random.uniform() - 1);
    closures.close(change);
  }
  interval.closures = closures.count();
  interval.rests = closures.rests();
  if (interval.rests > 0) {
    set_range(interval, closures.leaks_at_rest(), is_sealed);
    if (unknowns.shape.given && !as_it_is.empty()) {
      interval.shape = leaks_of_shape(*model, as_it_is, interval.leak[1], unknowns.shape);
      add_shape_error(interval);
      const ShownGaps shown =
          shown_gaps(*unknowns.shape.given, *model, as_it_is, *unknowns.shape.geometry);
      report_shown_gaps(shown, interval.leak[1], findings);
      reach_to(shown, interval);
    }
  }
  report_leaks(interval, edge, thickness_error, findings);
  return interval;
}

}  // namespace mvs::core
