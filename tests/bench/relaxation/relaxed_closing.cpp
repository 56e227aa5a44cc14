// Search for the settings of dynamic relaxation; each trial is a closure.
#include "tests/bench/relaxation/relaxed_closing.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "formats/formats.h"

using namespace mvs::core;

namespace bench {
namespace {

constexpr double safeties[] = {1.2, 1.5, 2};
constexpr double displacements[] = {1e-4, 5e-4};  // m, longest of a step
constexpr uint32_t default_steps = 4000;

Closing attempt(const std::string &valve, const RelaxationOptions &options) {
  Loaded open = read_obj(valve);
  const ModelPtr model = make_model(std::move(open.valve));
  State state = std::move(open.state);
  Closing closing;
  SolveStats stats;
  const Seconds took = timed([&] { stats = relax(*model, state, options); });
  closing.cpu_s.push_back(took.cpu);
  closing.wall_s.push_back(took.wall);
  closing.stats.converged = stats.converged ? 1 : 0;
  closing.stats.stable = stats.stable ? 1 : 0;
  closing.stats.iterations = stats.iterations;
  closing.stats.residual = stats.residual;
  closing.diverged = !std::isfinite(stats.residual);
  closing.profile.passes = stats.work.passes;
  closing.profile.broad_phases = stats.work.broad_phases;
  std::copy(stats.work.seconds.begin(), stats.work.seconds.end(), closing.profile.phase_s);
  closing.closed = closing.diverged ? valve : write_obj(*model, state);
  return closing;
}

bool is_better(const Closing &a, const Closing &b) {
  if (a.at_rest() != b.at_rest()) return a.at_rest();
  return a.at_rest() ? a.cpu() < b.cpu() : !a.diverged && a.stats.residual < b.stats.residual;
}

}  // namespace

Relaxed close_relaxed(const Case &of, Damping damping) {
  const std::string valve = open_valve(of);
  Relaxed best;
  best.closing.diverged = true;
  best.closing.cpu_s = {0};
  for (const double safety : safeties) {
    for (const double longest : displacements) {
      for (const bool often : {false, true}) {
        RelaxationOptions options{damping, safety, often, longest, of.residual};
        options.most = of.most > 0 ? of.most : default_steps;
        Closing closing = attempt(valve, options);
        ++best.tried;
        best.came_to_rest += closing.at_rest() ? 1 : 0;
        if (best.tried > 1 && !is_better(closing, best.closing)) continue;
        best.taken = options;
        best.closing = std::move(closing);
      }
    }
  }
  measure(best.closing);
  return best;
}

std::string words_of(const Relaxed &relaxed) {
  const RelaxationOptions &taken = relaxed.taken;
  char words[200];
  std::snprintf(words, sizeof words,
                "dynamic relaxation, %s damping: masses times %g, renewed every %d steps, nodes "
                "move at most %g mm; %d of %d settings came to rest",
                damping_names.at(taken.damping).c_str(), taken.safety, taken.renews_often ? 2 : 10,
                taken.longest * 1e3, relaxed.came_to_rest, relaxed.tried);
  return words;
}

}  // namespace bench
