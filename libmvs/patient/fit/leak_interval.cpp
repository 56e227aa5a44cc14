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
    const ClosedValve closed =
        close_open(solver, make_model(std::move(changed)), systolic_pressure, progress);
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

// One decimal, in mm2.
std::string area_words(double leak) {
  return std::isnan(leak) ? "(diverged)" : format("%.1f mm2", leak * 1e6);
}

std::string shape_words(const ShapeLeaks &shape) {
  return format(
      "; the closed valve lies %.2f mm (RMS) from the given surface: with edges %.2f mm short of "
      "where they are it leaks %s, and %s through gaps as much narrower on both sides",
      shape.distance * 1e3, shape.error * 1e3, area_words(shape.most).c_str(),
      area_words(shape.least).c_str());
}

std::string ranges_of(const LeakInterval &interval, const EdgeRange &edge, double thickness_error) {
  const double more = interval.factor[2] - 1;
  std::string ranges = format("lengths of chordae up to %.0f %% shorter or longer", 100 * more);
  if (edge.geometry) {
    ranges += format(
        ", a free edge up to %.1f mm farther out (%s with the lengths as they are) or %.1f mm "
        "farther in (%s)",
        edge.out * 1e3, area_words(interval.edge_leak[0]).c_str(), edge.in * 1e3,
        area_words(interval.edge_leak[1]).c_str());
  }
  if (thickness_error > 0) {
    ranges += format(", tissue up to %.2f mm thicker (%s) or thinner (%s)", thickness_error * 1e3,
                     area_words(interval.tissue_leak[0]).c_str(),
                     area_words(interval.tissue_leak[1]).c_str());
  }
  return ranges;
}

Finding leaks_by_length(const LeakInterval &interval, double confidence, bool at_rest) {
  const auto &[f0, f1, f2] = interval.factor;
  Finding finding{
      "leak",
      FindingSource::measured,
      confidence,
      format("regurgitant orifice at 120 mmHg with chordae of %.0f, %.0f and %.0f %% of their "
             "lengths: %s, %s and %s%s; lengths are known to that range only, so one of these "
             "numbers alone says little",
             100 * f0, 100 * f1, 100 * f2, area_words(interval.leak[0]).c_str(),
             area_words(interval.leak[1]).c_str(), area_words(interval.leak[2]).c_str(),
             at_rest ? "" : ", not all of them at rest"),
      {},
      "m2"};
  for (const double leak : interval.leak) {
    if (!std::isnan(leak)) finding.value.push_back(leak);
  }
  return finding;
}

// From the leaks of closures at rest to a little beyond them, for the few that were tried.
void set_range(LeakInterval &interval, const std::vector<double> &leaks, bool is_sealed) {
  const auto [least, most] = std::minmax_element(leaks.begin(), leaks.end());
  const double more = sealed + (is_sealed ? 0 : widening * (*most - *least));
  interval.least = std::max(0.0, *least - more);
  interval.most = *most + more;
}

}  // namespace

void report_leaks(const LeakInterval &interval, const EdgeRange &edge, double thickness_error,
                  Findings &findings) {
  const bool known = !std::isnan(interval.most);
  const bool at_rest = interval.rests == interval.closures;
  const double unsure =
      known ? std::min(1.0, (interval.most - interval.least) / unknown_leak) : 1.0;
  const double confidence = same_leak_confidence * (1 - unsure) * (at_rest ? 1 : 0.5);
  findings.push_back(leaks_by_length(interval, confidence, at_rest));
  const std::string ranges = ranges_of(interval, edge, thickness_error);
  Finding finding{"leak_interval", FindingSource::measured, confidence, {}, {}, "m2"};
  if (known) {
    finding.sentence = format("%.1f to %.1f mm2 for %s", interval.least * 1e6, interval.most * 1e6,
                              ranges.c_str());
    finding.sentence +=
        interval.draws == 0
            ? format(": each of these closures leaks less than %.1f mm2", sealed * 1e6)
            : format("; %u closures with random ones are among them", interval.draws);
    if (!at_rest) {
      finding.sentence += format("; %u of %u closures did not come to rest and are left out",
                                 interval.closures - interval.rests, interval.closures);
    }
    if (interval.shape.distance > 0) finding.sentence += shape_words(interval.shape);
    finding.value = {interval.least, interval.most};
  } else {
    finding.sentence = format(
        "not determined: none of %u closures came to rest, for %s; check the surface, the "
        "thickness and the papillary tips",
        interval.closures, ranges.c_str());
  }
  findings.push_back(finding);
  findings.push_back(
      {"leak_limits",
       FindingSource::assumed,
       1,
       format(
           "meshes of one valve leak alike to %.1f mm2; an interval of %.0f mm2 says nothing, "
           "as grades of regurgitation are that far apart; leaks of ruptured or missing chordae, "
           "and of other insertions than those of this valve, are not in it",
           sealed * 1e6, unknown_leak * 1e6),
       {sealed, unknown_leak},
       "m2"});
}

bool all_seal(const std::vector<double> &leaks) {
  return std::all_of(leaks.begin(), leaks.end(), [](double leak) { return leak < sealed; });
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
  NormalNumbers random(seed);
  const std::vector<ChordGroup> groups = chord_groups(*model, ChordGrouping::halves);
  for (; !is_sealed && interval.draws < most_draws; ++interval.draws) {
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
    }
  }
  report_leaks(interval, edge, thickness_error, findings);
  return interval;
}

}  // namespace mvs::core
