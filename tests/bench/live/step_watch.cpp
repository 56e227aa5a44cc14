#include "tests/bench/live/step_watch.h"

#include <cmath>

#include "tests/stability/crossings.h"

namespace bench {
namespace {

// Relative to its energy: rounding of sums of some thousand terms (tests/stability/README.md).
constexpr double bound = 1e-9;

bool held_nodes_stayed(const mvs::Snapshot &now, const std::vector<double> &before) {
  const auto kinds = now.view<uint8_t>(MVS_ARRAY_NODE_KIND);
  const double *x = now.view<double>(MVS_ARRAY_NODE_POSITION).data();
  for (size_t n = 0; n < kinds.rows(); ++n) {
    const uint8_t kind = kinds.data()[n];
    if (kind != MVS_NODE_KIND_ANNULUS && kind != MVS_NODE_KIND_HEAD) continue;
    for (size_t k = 3 * n; k < 3 * n + 3; ++k) {
      if (x[k] != before[k]) return false;
    }
  }
  return true;
}

}  // namespace

size_t StepWatch::crossings(const mvs::Simulator &sim) {
  const mvs::Snapshot now = sim.snapshot();
  const auto x = now.view<double>(MVS_ARRAY_NODE_POSITION);
  const auto triangles = now.view<uint32_t>(MVS_ARRAY_TRIANGLE_NODES);
  return stability::crossings(x.data(), x.rows(), triangles.data(), triangles.rows()).size();
}

double StepWatch::quiet(const mvs::Simulator &sim, double dt, double least) {
  const mvs::Snapshot now = sim.snapshot();
  const auto kinds = now.view<uint8_t>(MVS_ARRAY_NODE_KIND);
  const double *v = now.view<double>(MVS_ARRAY_NODE_VELOCITY).data();
  size_t free = 0, quiet = 0;
  for (size_t n = 0; n < kinds.rows(); ++n, v += 3) {
    const uint8_t kind = kinds.data()[n];
    if (kind == MVS_NODE_KIND_ANNULUS || kind == MVS_NODE_KIND_HEAD) continue;
    ++free;
    quiet += dt * std::hypot(v[0], v[1], v[2]) < least;
  }
  return free > 0 ? static_cast<double>(quiet) / static_cast<double>(free) : 0;
}

// The pressure at the free edge has no potential and is left out of the energy: its work is known
// from the shapes before and after.
bool StepWatch::makes_energy(const mvs::Simulator &sim, const mvs_stats &stats) {
  const mvs::Snapshot now = sim.snapshot();
  const auto x = now.view<double>(MVS_ARRAY_NODE_POSITION);
  if (!edge_work_) edge_work_.emplace(now);
  const double energy = stats.energy + stats.kinetic;
  bool made = false;
  if (energy_is_known_ && held_nodes_stayed(now, x_)) {
    const double work = now.load().pressure * edge_work_->held(x_.data(), x.data());
    const double size = std::abs(stats.energy) + std::abs(energy_) + stats.kinetic;
    made = energy - energy_ - work > bound * size;
  }
  x_.assign(x.begin(), x.end());
  energy_ = energy;
  energy_is_known_ = true;
  return made;
}

}  // namespace bench
