#include "tests/stability/watch.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>

namespace stability {
namespace {

// A step may make this share of its energy: rounding of sums of some thousand terms.
constexpr double step_bound = 1e-9;
// J by which Newton may end above its start, since its last iterations follow the force and not the
// energy. Checked only if no node moved farther than `near`: the work at the free edge is computed
// along a straight path, which is wrong for a leaflet that turned over. A settle by steps in time
// is not checked: the mode `live` checks each step.
constexpr double newton_bound = 1e-4;
constexpr double near = 5e-3;       // m
constexpr double tolerance = 1e-5;  // N, the library's own
constexpr double arrival = 1e-9;    // m

std::vector<double> positions(const mvs::Snapshot &now) {
  const auto x = now.view<double>(MVS_ARRAY_NODE_POSITION);
  return {x.begin(), x.end()};
}

bool is_held(uint8_t kind) {
  return kind == MVS_NODE_KIND_ANNULUS || kind == MVS_NODE_KIND_HEAD;
}

double farthest(const std::vector<double> &from, const mvs::View<double> &to) {
  double most = 0;
  for (size_t n = 0; n < to.rows(); ++n) {
    const double *a = &from[3 * n], *b = to.row(n);
    most = std::max(most, std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
  }
  return most;
}

bool all_finite(const mvs::View<double> &rows) {
  return std::all_of(rows.begin(), rows.end(), [](double v) { return std::isfinite(v); });
}

bool held_nodes_stayed(const mvs::Snapshot &now, const std::vector<double> &before) {
  const auto kinds = now.view<uint8_t>(MVS_ARRAY_NODE_KIND);
  const double *x = now.view<double>(MVS_ARRAY_NODE_POSITION).data();
  for (size_t n = 0; n < kinds.rows(); ++n) {
    if (!is_held(kinds.data()[n])) continue;
    for (size_t k = 3 * n; k < 3 * n + 3; ++k) {
      if (x[k] != before[k]) return false;
    }
  }
  return true;
}

// The largest out-of-balance force on a free node, N, from the snapshot.
double residual_of(const mvs::Snapshot &now) {
  const auto kinds = now.view<uint8_t>(MVS_ARRAY_NODE_KIND);
  const auto force = now.view<double>(MVS_ARRAY_NODE_FORCE);
  double most = 0;
  for (size_t n = 0; n < kinds.rows(); ++n) {
    const double *f = force.row(n);
    if (!is_held(kinds.data()[n])) most = std::max(most, std::hypot(f[0], f[1], f[2]));
  }
  return most;
}

// Whether a reported residual is that of these forces and of the instruments that push: a hand in
// free space has the force of its spring out of balance; for a touching tool, snapshots do not hold
// the rest.
bool is_residual(double told, double of_nodes, const mvs::Snapshot &now) {
  bool may_be_more = false;
  double most = of_nodes;
  for (const mvs_tool_state &tool : mvs::tools_of(now)) {
    if (tool.kind == MVS_TOOL_KIND_GRASP) continue;  // a force like any other on the node it holds
    const double *f = tool.force;
    if (tool.touching == 0) most = std::max(most, std::hypot(f[0], f[1], f[2]));
    may_be_more = may_be_more || tool.touching == 1;
  }
  // forces are recomputed with candidate pairs of their own: the same to rounding
  return std::abs(told - most) <= 1e-6 * told + 1e-9 || (may_be_more && told > most);
}

bool boundary_is_there(const mvs::Snapshot &now) {
  const auto kinds = now.view<uint8_t>(MVS_ARRAY_NODE_KIND);
  const double *x = now.view<double>(MVS_ARRAY_NODE_POSITION).data();
  const double *open = now.view<double>(MVS_ARRAY_NODE_OPEN).data();
  const double *loaded = now.view<double>(MVS_ARRAY_NODE_LOADED).data();
  const double share = now.load().boundary_fraction;
  for (size_t n = 0; n < kinds.rows(); ++n) {
    if (!is_held(kinds.data()[n])) continue;
    for (size_t k = 3 * n; k < 3 * n + 3; ++k) {
      if (!(std::abs(open[k] + share * (loaded[k] - open[k]) - x[k]) <= arrival)) return false;
    }
  }
  return true;
}

}  // namespace

const char *name_of(SolverMode mode) {
  return mode == SolverMode::newton ? "newton" : mode == SolverMode::implicit ? "implicit" : "live";
}

void Watch::demand(bool condition, const std::string &fault) {
  if (condition) return;
  auto &faults = verdict_.faults;
  const std::string said = about_.empty() ? fault : about_ + ": " + fault;
  if (std::find(faults.begin(), faults.end(), said) == faults.end()) faults.push_back(said);
}

void Watch::begin() {
  mvs::must(mvs_set_checkpoint(sim_.get(), "begin"));
  first_ = sim_.snapshot().hash();
  look_again();
}

// To be called after a change that is no move: later crossings are compared with those of now, and
// the energy is unknown.
void Watch::look_again() {
  const mvs::Snapshot now = sim_.snapshot();
  x_ = positions(now);
  const auto triangles = now.view<uint32_t>(MVS_ARRAY_TRIANGLE_NODES);
  crossing_ = crossings(x_.data(), x_.size() / 3, triangles.data(), triangles.rows());
  energy_is_known_ = false;
}

bool Watch::attempt(mvs_result result) {
  if (result == MVS_OK) return true;
  ++verdict_.refused;
  verdict_.sentence = mvs_last_error()->message;
  demand(std::strlen(mvs_last_error()->message) > 0, "refused without a sentence");
  return false;
}

bool Watch::operate(const mvs_op *op) {
  const Hash before = sim_.snapshot().hash();
  const mvs_result checked = mvs_check_op(sim_.get(), op);
  const mvs_result applied = mvs_apply_op(sim_.get(), op, nullptr);
  demand(checked == applied, "check and apply disagree");
  if (!attempt(applied)) {
    demand(sim_.snapshot().hash() == before, "a refused operation changed something");
    return false;
  }
  if (!operated_) first_ = before;
  operated_ = true;
  const Hash after = sim_.snapshot().hash();
  mvs::must(mvs_undo(sim_.get()));
  demand(sim_.snapshot().hash() == before, "undo did not give the bits before");
  mvs::must(mvs_redo(sim_.get()));
  demand(sim_.snapshot().hash() == after, "redo did not give the bits after");
  look_again();
  return true;
}

void Watch::load(double pressure, double boundary_fraction) {
  sim_.set_load(pressure, boundary_fraction);
  energy_is_known_ = false;
}

// The potential before a settle, from the statistics of a step too short for any motion.
double Watch::potential_at_start() {
  mvs::Simulator probe;
  mvs::must(mvs_restore(probe.get(), sim_.snapshot().get()));
  mvs_step_options options = mvs::sized<mvs_step_options>();
  options.dt = 1e-9;
  if (mvs_step(probe.get(), &options) != MVS_OK) return INFINITY;
  return probe.stats().energy + probe.stats().kinetic;
}

// A refused move: the state is unchanged, and where the case allows it that is a valid result.
void Watch::refuse(const char *what, const Hash &before) {
  demand(sim_.snapshot().hash() == before, std::string("a refused ") + what + " changed something");
  const bool diverged = mvs_last_error()->code == MVS_E_DIVERGED;
  demand(effort_.may_refuse && diverged, what + (": " + verdict_.sentence));
}

void Watch::settle(uint32_t solver, uint32_t iterations) {
  const Hash before = sim_.snapshot().hash();
  mvs_settle_options options = mvs::sized<mvs_settle_options>();
  options.solver = solver;
  options.max_iterations = iterations;
  options.dt = solver == MVS_SOLVER_IMPLICIT ? effort_.dt : 0;
  const double energy = potential_at_start();
  mvs_stats stats = mvs::sized<mvs_stats>();
  if (!attempt(mvs_settle(sim_.get(), &options, &stats))) return refuse("settle", before);
  const mvs::Snapshot now = sim_.snapshot();
  const auto x = now.view<double>(MVS_ARRAY_NODE_POSITION);
  if (std::isfinite(energy) && !tool_has_changed_ && held_nodes_stayed(now, x_) &&
      farthest(x_, x) < near) {
    const double work = now.load().pressure * EdgeWork(now).followed(x_.data(), x.data());
    verdict_.gained = std::max(verdict_.gained, stats.energy - energy - work);
    demand(solver != MVS_SOLVER_NEWTON || verdict_.gained <= newton_bound, "a settle made energy");
  }
  const bool rests = residual_of(now) <= tolerance * (1 + 1e-6) && boundary_is_there(now);
  demand(!stats.converged || rests, "said to be at rest and is not");
  // implicit steps have to stay at rest for a while, and may end before
  demand(stats.converged || !rests || stats.iterations >= iterations,
         "at rest and does not say so");
  look(stats);
}

bool Watch::step(double dt) {
  const Hash before = sim_.snapshot().hash();
  mvs_step_options options = mvs::sized<mvs_step_options>();
  options.dt = dt;
  if (!attempt(mvs_step(sim_.get(), &options))) {
    refuse("step", before);
    return false;
  }
  const mvs_stats stats = sim_.stats();
  const mvs::Snapshot now = sim_.snapshot();
  const double energy = stats.energy + stats.kinetic;
  if (energy_is_known_ && held_nodes_stayed(now, x_)) {
    const double work =
        now.load().pressure *
        EdgeWork(now).held(x_.data(), now.view<double>(MVS_ARRAY_NODE_POSITION).data());
    const double scale = std::abs(stats.energy) + std::abs(energy_) + stats.kinetic;
    const double made = (energy - energy_ - work) / scale;
    verdict_.made = std::max(verdict_.made, made);
    demand(made <= step_bound, "a step made energy");
  }
  look(stats);
  energy_ = energy;
  energy_is_known_ = true;
  return true;
}

// The criteria of every move.
void Watch::look(const mvs_stats &stats) {
  ++verdict_.moves;
  tool_has_changed_ = false;
  const mvs::Snapshot now = sim_.snapshot();
  demand(all_finite(now.view<double>(MVS_ARRAY_NODE_POSITION)) &&
             all_finite(now.view<double>(MVS_ARRAY_NODE_VELOCITY)) && std::isfinite(stats.energy) &&
             std::isfinite(stats.kinetic) && std::isfinite(stats.residual),
         "not finite");
  verdict_.residual = residual_of(now);
  verdict_.at_rest = verdict_.residual <= tolerance * (1 + 1e-6) && boundary_is_there(now);
  demand(is_residual(stats.residual, verdict_.residual, now),
         "the residual told is not the one there is");
  compare_crossings(now);
  x_ = positions(now);
  energy_is_known_ = false;
}

void Watch::compare_crossings(const mvs::Snapshot &now) {
  const auto x = now.view<double>(MVS_ARRAY_NODE_POSITION);
  const auto triangles = now.view<uint32_t>(MVS_ARRAY_TRIANGLE_NODES);
  std::vector<Pair> found = crossings(x.data(), x.rows(), triangles.data(), triangles.rows());
  std::vector<Pair> fresh;
  std::set_difference(found.begin(), found.end(), crossing_.begin(), crossing_.end(),
                      std::back_inserter(fresh));
  verdict_.crossed += fresh.size();
  demand(fresh.empty(), "triangles cross that did not");
  crossing_ = std::move(found);
}

void Watch::rest() {
  if (mode_ == SolverMode::newton) return settle(MVS_SOLVER_NEWTON, effort_.newton);
  if (mode_ == SolverMode::implicit) return settle(MVS_SOLVER_IMPLICIT, effort_.implicit);
  for (uint32_t k = 0; k < effort_.live && step(effort_.dt); ++k) {
  }
}

void Watch::take_back() {
  if (operated_) {
    while (mvs_undo(sim_.get()) == MVS_OK) {
    }
  } else {
    mvs::must(mvs_restore_checkpoint(sim_.get(), "begin"));
  }
  demand(sim_.snapshot().hash() == first_, "undo did not give the first hash");
  operated_ = false;
  first_ = sim_.snapshot().hash();
  look_again();
}

Verdict Watch::finish() {
  about_.clear();
  if (is_laid_out()) take_back();
  return verdict_;
}

Verdict Watch::failed(const std::string &thrown) {
  demand(false, "thrown: " + thrown);
  return verdict_;
}

bool Watch::is_laid_out() const {
  const mvs_snapshot *held = nullptr;
  if (mvs_get_snapshot(sim_.get(), &held) != MVS_OK) return false;
  mvs_snapshot_release(held);
  return true;
}

}  // namespace stability
