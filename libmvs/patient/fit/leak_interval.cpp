// Closures from open and their orifices.
#include "patient/fit/leak_interval.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/error.h"
#include "base/tasks.h"
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
constexpr uint32_t draws = 6;
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
                  const TellShare &tell, uint32_t iterations = most_iterations) {
  const auto &[factor, by, thickness] = change;
  const bool moves = range.geometry && by != 0;
  Valve changed = moves ? with_edge_moved(valve, *range.geometry, by) : valve;
  if (thickness != 1) changed = with_thickness(changed, thickness);
  for (size_t c = 0; c < factor.size(); ++c) changed.chords[c].rest_length *= factor[c];
  const auto progress = [&](double share, double) {
    tell(share);
    return true;
  };
  Solver solver(Backend::fastest);
  Closed made;
  // without a shape the valve is built all the same: its closure is the caller's
  without_divergence([&] {
    const ClosedValve closed =
        close_open(solver, make_model(std::move(changed)), systolic_pressure, progress, iterations);
    made = {measure_orifice(*closed.model, closed.state.x).area, closed.stats.converged,
            closed.stats.iterations, closed.state.x};
    return true;
  });
  return made;
}

// Leaks of closures, m2.
struct FoundLeaks {
  std::vector<double> all, at_rest;
  uint32_t rests = 0;  // closures that came to rest

  void add(const Closed &c) {
    all.push_back(c.leak);
    if (!c.at_rest) return;
    ++rests;
    at_rest.push_back(c.leak);
  }
  void add(const std::vector<Closed> &closed) {
    for (const Closed &c : closed) add(c);
  }
  // Whether the valve is sealed in all closures, of which one or more came to rest.
  bool seal() const { return rests > 0 && all_seal(all); }
  // The leaks of all closures that have a shape.
  std::vector<double> finite() const {
    std::vector<double> found;
    std::copy_if(all.begin(), all.end(), std::back_inserter(found),
                 [](double leak) { return !std::isnan(leak); });
    return found;
  }
};

bool few_at_rest(size_t rests, size_t closures) {
  return 2 * rests < closures;
}

// Closes a valve with each of the changes, on all workers.
std::vector<Closed> close_all(const Valve &valve, const std::vector<ClosureChange> &changes,
                              const EdgeRange &range, Workers *workers, const TellShare &tell) {
  std::vector<Closed> closed(changes.size());
  run_tasks(workers, static_cast<uint32_t>(changes.size()), tell,
            [&](uint32_t k, const TellShare &tell_task) {
              closed[k] = close_with(valve, changes[k], range, tell_task);
            });
  return closed;
}

double thickness_factor(const Model &model, const LeakUnknowns &unknowns, double share) {
  const double spread = unknowns.thickness_error / mean_thickness(model.valve);
  return std::max(least_thickness, 1 + share * spread);
}

// The ends of each range alone: all lengths shorter, as they are, and longer; the edge farther out
// and in, and the tissue thicker and thinner, where they are not exact.
std::vector<ClosureChange> single_changes(const Model &model, const LeakUnknowns &unknowns,
                                          const std::array<double, 3> &factors) {
  std::vector<ClosureChange> changes;
  changes.reserve(7);
  for (const double factor : factors) {
    changes.push_back({std::vector<double>(model.valve.chords.size(), factor)});
  }
  if (unknowns.edge.geometry) {
    changes.push_back({{}, unknowns.edge.out});
    changes.push_back({{}, -unknowns.edge.in});
  }
  if (unknowns.thickness_error > 0) {
    changes.push_back({{}, 0, thickness_factor(model, unknowns, 1)});
    changes.push_back({{}, 0, thickness_factor(model, unknowns, -1)});
  }
  return changes;
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

// Random changes of everything from the same ranges.
std::vector<ClosureChange> random_changes(const Model &model, const LeakUnknowns &unknowns) {
  const EdgeRange &edge = unknowns.edge;
  NormalNumbers random(seed);
  const std::vector<ChordGroup> groups = chord_groups(model, ChordGrouping::halves);
  std::vector<ClosureChange> changes(draws);
  for (ClosureChange &change : changes) {
    change.factor = drawn_factors(groups, unknowns.lengths, model.valve.chords.size(), random);
    if (edge.geometry) change.edge = random.uniform() * (edge.out + edge.in) - edge.in;
    if (unknowns.thickness_error > 0) {
      change.thickness = thickness_factor(model, unknowns, 2 * random.uniform() - 1);
    }
  }
  return changes;
}

// The closures of single_changes, in the interval.
void set_singles(const std::vector<Closed> &closed, const LeakUnknowns &unknowns,
                 LeakInterval &interval) {
  for (size_t k = 0; k < 3; ++k) {
    interval.leak[k] = closed[k].leak;
    interval.at_rest[k] = closed[k].at_rest;
    interval.iterations[k] = closed[k].iterations;
  }
  for (size_t k = 0; unknowns.edge.geometry && k < 2; ++k) {
    interval.edge_leak[k] = closed[3 + k].leak;
  }
  for (size_t k = 0; unknowns.thickness_error > 0 && k < 2; ++k) {
    interval.tissue_leak[k] = closed[closed.size() - 2 + k].leak;
  }
}

// From the leaks of closures at rest to a little beyond them, for the few that were tried.
void set_range(LeakInterval &interval, const std::vector<double> &leaks, bool is_sealed) {
  const auto [least, most] = std::minmax_element(leaks.begin(), leaks.end());
  const double more = sealed_leak + (is_sealed ? 0 : widening * (*most - *least));
  interval.least = std::max(0.0, *least - more);
  interval.most = *most + more;
  interval.of_closures = {interval.least, interval.most};
}

// Widens the interval of a fitted valve, closed at `x`, by the errors and gaps of its surface.
void reach_to_shape(const Model &model, const std::vector<Vec3> &x, const FittedShape &shape,
                    LeakInterval &interval, Findings &findings) {
  interval.shape = leaks_of_shape(model, x, interval.leak[1], shape);
  add_shape_error(interval);
  interval.with_shape = {interval.least, interval.most};
  const ShownGaps shown = shown_gaps(*shape.given, model, x, *shape.geometry, shape.error);
  report_shown_gaps(shown, interval.leak[1], findings);
  reach_to(shown, interval);
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
                           const TellShare &tell, Workers *workers) {
  const Valve &valve = model->valve;
  const EdgeRange &edge = unknowns.edge;
  LeakInterval interval;
  interval.factor = {1 - unknowns.lengths.all, 1, 1 + unknowns.lengths.all};
  const std::vector<ClosureChange> singles = single_changes(*model, unknowns, interval.factor);
  const double most = static_cast<double>(singles.size() + draws);
  const auto tell_from = [&](double begin, size_t count) {
    return [&tell, begin, share = static_cast<double>(count) / most](double done) {
      if (tell) tell(begin + share * done);
    };
  };
  const double singles_share = static_cast<double>(singles.size()) / most;
  std::vector<Closed> closed =
      close_all(valve, singles, edge, workers, tell_from(0, singles.size()));
  FoundLeaks leaks{known, known};
  leaks.add(closed);
  const bool few_rest = few_at_rest(leaks.rests, closed.size());
  if (few_rest && !closed[1].at_rest && !leaks.seal()) {
    Closed longer = close_with(valve, {}, edge, tell_from(singles_share, draws), 0);
    if (longer.at_rest) closed[1] = std::move(longer);
    leaks = {known, known};
    leaks.add(closed);
  }
  set_singles(closed, unknowns, interval);
  const bool is_sealed = leaks.seal();
  if (!few_rest && !is_sealed) {
    interval.draws = draws;
    leaks.add(close_all(valve, random_changes(*model, unknowns), edge, workers,
                        tell_from(singles_share, draws)));
  }
  interval.closures = static_cast<uint32_t>(leaks.all.size() - known.size());
  interval.rests = leaks.rests;
  const bool few = few_at_rest(interval.rests, interval.closures);
  interval.creeps = few && closed[1].at_rest;
  if (!few || interval.creeps || is_sealed) {
    set_range(interval, interval.creeps ? leaks.finite() : leaks.at_rest, is_sealed);
    if (unknowns.shape.given && !closed[1].x.empty()) {
      reach_to_shape(*model, closed[1].x, unknowns.shape, interval, findings);
    }
  }
  report_leaks(interval, edge, unknowns.thickness_error, findings);
  return interval;
}

}  // namespace mvs::core
