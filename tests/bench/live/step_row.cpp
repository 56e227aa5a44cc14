// Tables of measurements of live steps.
#include "tests/bench/live/step_row.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace bench {
namespace {

std::vector<double> all_of(const StepRow &row) {
  std::vector<double> all = row.active;
  all.insert(all.end(), row.resting.begin(), row.resting.end());
  return all;
}

}  // namespace

void StepRow::add(const StepRow &other) {
  active.insert(active.end(), other.active.begin(), other.active.end());
  resting.insert(resting.end(), other.resting.begin(), other.resting.end());
  hand.insert(hand.end(), other.hand.begin(), other.hand.end());
  lowered_linear += other.lowered_linear;
  lowered_step += other.lowered_step;
  broad += other.broad;
  orderings += other.orderings;
  made += other.made;
  iterations += other.iterations;
  served += other.served;
  passes += other.passes;
  factors += other.factors;
  for (size_t p = 0; p < phase_s.size(); ++p) phase_s[p] += other.phase_s[p];
  crossings = std::max(crossings, other.crossings);
  quiet += other.quiet;
  quiet_by_hand += other.quiet_by_hand;
}

double percentile(std::vector<double> of, double share) {
  if (of.empty()) return 0;
  std::sort(of.begin(), of.end());
  const auto at = static_cast<size_t>(std::ceil(share * static_cast<double>(of.size())));
  return of[std::min(of.size() - 1, at > 0 ? at - 1 : 0)];
}

void print_head() {
  std::printf("%-5s %-10s %6s %8s %8s %8s %8s %9s %7s %12s %6s %6s %5s %4s\n", "scene", "phase",
              "steps", "p50 ms", "p99 ms", "p99.9 ms", "max ms", "active ms", "asleep", "lowered",
              "broad", "order", "cross", "made");
}

void print(const StepRow &row) {
  const std::vector<double> all = all_of(row);
  std::printf(
      "%-5s %-10s %6zu %8.3f %8.3f %8.3f %8.3f %9.3f %6.1f%% %6zu %5zu %6zu %6zu %5zu %4zu\n",
      row.scene.c_str(), row.phase.c_str(), row.steps(), 1e3 * percentile(all, 0.5),
      1e3 * percentile(all, 0.99), 1e3 * percentile(all, 0.999), 1e3 * percentile(all, 1),
      1e3 * percentile(row.active, 0.5),
      100 * static_cast<double>(row.resting.size()) / static_cast<double>(row.steps()),
      row.lowered_linear, row.lowered_step, row.broad, row.orderings, row.crossings, row.made);
  std::fflush(stdout);
}

void print(const StepRow &whole, const char *which, const std::vector<double> &took) {
  std::printf("%s: %zu %s, p50 %.3f ms, p99 %.3f ms, p99.9 %.3f ms, max %.3f ms\n",
              whole.scene.c_str(), took.size(), which, 1e3 * percentile(took, 0.5),
              1e3 * percentile(took, 0.99), 1e3 * percentile(took, 0.999),
              1e3 * percentile(took, 1));
}

void write_head(std::ostream &csv) {
  csv << "scene,phase,steps,p50_ms,p99_ms,p99.9_ms,max_ms,active_p50_ms,active_p99_ms,"
         "active_p99.9_ms,active_max_ms,hand_steps,hand_p50_ms,hand_p99_ms,hand_max_ms,"
         "resting_p50_ms,asleep,lowered_linear,lowered_step,broad_phases,orderings,crossings,"
         "made_energy\n";
}

void write(std::ostream &csv, const StepRow &row) {
  const std::vector<double> all = all_of(row);
  csv << row.scene << ',' << row.phase << ',' << row.steps();
  for (const double share : {0.5, 0.99, 0.999, 1.0}) csv << ',' << 1e3 * percentile(all, share);
  for (const double share : {0.5, 0.99, 0.999, 1.0})
    csv << ',' << 1e3 * percentile(row.active, share);
  csv << ',' << row.hand.size();
  for (const double share : {0.5, 0.99, 1.0}) csv << ',' << 1e3 * percentile(row.hand, share);
  csv << ',' << 1e3 * percentile(row.resting, 0.5) << ',' << row.resting.size() << ','
      << row.lowered_linear << ',' << row.lowered_step << ',' << row.broad << ',' << row.orderings
      << ',' << row.crossings << ',' << row.made << '\n';
}

}  // namespace bench
