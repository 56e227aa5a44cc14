// Three closures and their orifices.
#include "patient/fit/leak_interval.h"

#include <algorithm>

#include "base/error.h"
#include "measure/orifice/orifice.h"
#include "patient/fit/closure.h"

namespace mvs::core {
namespace {

// Confidence of a leak that does not depend on the lengths, and the difference at which none is
// left: grades of regurgitation are 10 to 20 mm2 apart (0.2, 0.3, 0.4 cm2).
constexpr double same_leak_confidence = 0.8, unknown_leak = 20e-6;

}  // namespace

LeakInterval leak_interval(const ModelPtr &model, Findings &findings) {
  LeakInterval interval;
  bool at_rest = true;
  const auto record = [&](size_t k, const ClosedValve &closed) {
    interval.leak[k] = measure_orifice(*closed.model, closed.state.x).area;
    interval.at_rest[k] = closed.stats.converged;
    interval.iterations[k] = closed.stats.iterations;
    at_rest = at_rest && closed.stats.converged;
  };
  // a solver of its own: the middle leak is the one that the built valve shows
  Solver solver(Backend::fastest);
  const ClosedValve middle = close_open(solver, model, systolic_pressure);
  record(1, middle);
  for (const size_t k : {size_t{0}, size_t{2}}) {
    Valve changed = model->valve;
    for (Chord &chord : changed.chords) chord.rest_length *= interval.factor[k];
    // from the closed valve: a third of the time, and the same folds
    record(k, close_again(solver, middle, changed));
  }
  const auto [least, most] = std::minmax_element(interval.leak.begin(), interval.leak.end());
  const double unsure = std::min(1.0, (*most - *least) / unknown_leak);
  const double confidence = same_leak_confidence * (1 - unsure) * (at_rest ? 1 : 0.5);
  findings.push_back(
      {"leak",
       FindingSource::measured,
       confidence,
       format(
           "regurgitant orifice at 120 mmHg with chordae of 90, 100 and 110 %% of their lengths: "
           "%.1f, %.1f and %.1f mm2%s; lengths of chordae are not seen in images, so one of "
           "these numbers alone says little",
           interval.leak[0] * 1e6, interval.leak[1] * 1e6, interval.leak[2] * 1e6,
           at_rest ? "" : ", not all of them at rest"),
       {interval.leak.begin(), interval.leak.end()},
       "m2"});
  return interval;
}

}  // namespace mvs::core
