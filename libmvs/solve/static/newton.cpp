// Newton in a trust region: the loop, the piece that goes first, steps at rest, the boundary, and
// how far a step may go. Travel: newton_travel.cpp; the linear system: newton_system.cpp.
#include "solve/static/newton.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "energy/forces.h"
#include "solve/nodes.h"
#include "solve/static/local_subproblem.h"

namespace mvs::core {
namespace {

constexpr double longest_step = 1e-3;     // m a node may go in one iteration
constexpr double torn = 1e3;              // of rest_force_: more, and the boundary waits
constexpr uint32_t longest_wait = 20;     // iterations
constexpr double boundary_step = 0.5e-3;  // m a prescribed node may go in one iteration
// Of the contact thickness: what candidate pairs hold for beside the step. Steps far from rest need
// new ones anyway, those near rest are far smaller.
constexpr double slack_share = 0.02;
// Of the shift that an attempt at rest needed, what the next begins with: one that stays when the
// valve has left where it took it slows down all that follow.
constexpr double relief = 0.1;
constexpr int most_patience = 64;
// The piece around a disturbance that goes to rest first: an operation disturbs a few nodes, a load
// all of them; the share and the reach are where piece and whole together cost least.
constexpr double disturbed = 0.25;      // of rest_force_: more, and a node feels the operation
constexpr double many_disturbed = 0.1;  // share of the nodes: more, and there is no piece
constexpr double piece_share = 0.2;     // of the nodes, at most, is free
constexpr double piece_radius = 10e-3;  // m from the disturbance, at most
constexpr double piece_leash = 4e-3;    // m a node of it may go
constexpr uint32_t piece_iterations = 12;
constexpr double piece_rest = 0.2;  // of rest_force_: its rim is as far from rest

std::vector<uint32_t> disturbed_nodes(const Model &model, const std::vector<Vec3> &g,
                                      double rest_force) {
  std::vector<uint32_t> nodes;
  for (uint32_t i = 0; i < g.size(); ++i) {
    const bool far = g[i].squaredNorm() > disturbed * disturbed * rest_force * rest_force;
    if (far && !model.topology.fixed[i]) nodes.push_back(i);
  }
  return nodes;
}

double largest(const std::vector<Vec3> &v) {
  double square = 0;
  for (const Vec3 &a : v) square = std::max(square, a.squaredNorm());
  return std::sqrt(square);
}

}  // namespace

bool far_from_rest(const Model &model, const State &state) {
  if (!boundary_is_there(model, state.x, state.load.boundary_fraction, 0)) return true;
  const std::vector<Vec3> force = evaluate_forces(model, state).total;
  const auto nodes = static_cast<double>(state.x.size());
  const size_t places =
      disturbed_nodes(model, force, scale_of(state.load) * mean_area(model)).size();
  return static_cast<double>(places) > many_disturbed * nodes;
}

SolveStats Newton::settle(State &state, const SolveOptions &options, const Progress &progress) {
  const double start = seconds_now();
  const double tolerance = options.residual > 0 ? options.residual : 1e-5;
  const uint32_t most = options.max_iterations > 0 ? options.max_iterations : 1000;
  begin(state);
  // a piece is cut out without the tools that are in it
  if (state.tools.empty()) settle_disturbed(state.load);
  while (true) {
    const bool arrived = boundary_is_there(*model_, x_, fraction_, 0);
    stats_.converged = arrived && residual_ <= tolerance;
    if (stats_.converged || stats_.iterations == most || held_) break;
    const double share = static_cast<double>(stats_.iterations) / most;
    MVS_MUST(!progress || progress(share, residual_), MVS_E_CANCELLED, "settle",
             "settling was cancelled by the progress callback; the valve is as before");
    ++stats_.iterations;
    if (!arrived && may_move_boundary()) move_boundary();
    iterate();
  }
  state.x = x_;
  state.v.assign(x_.size(), Vec3::Zero());
  stats_.residual = residual_;
  stats_.energy = energy_;
  stats_.contact_pairs = static_cast<uint32_t>(total_energy_.contact().contact_pairs().size());
  stats_.skipped |= total_energy_.skipped();
  stats_.wall_s = seconds_now() - start;
  return stats_;
}

void Newton::begin(const State &state) {
  stats_ = {};
  x_ = state.x;
  trial_.resize(x_.size());
  fraction_ = state.load.boundary_fraction;
  total_energy_.set_pressure(state.load.pressure);
  total_energy_.set_tools(state.tools);
  const double pressure = scale_of(state.load), area = mean_area(*model_);
  shift_scale_.clear();
  for (const double a : model_->vertex_area) {
    shift_scale_.push_back(pressure * std::sqrt(std::max(a, area)));
  }
  near_force_ = 4 * pressure * area;
  rest_force_ = pressure * area;
  shift_ = 1;
  rest_shift_ = 0;
  patterns_ = 0;
  wait_ = 0;
  boundary_wait_ = 0;
  patience_ = 1;
  best_ = rest_force_;
  slack_ = slack_share * model_->valve.contact_thickness;
  evaluate();
}

// Where an operation has left only a few nodes far from rest, their neighbourhood goes to rest
// first, held by the remaining valve: many steps there cost less than one of the whole.
void Newton::settle_disturbed(const Load &load) {
  if (leash_ > 0 || !boundary_is_there(*model_, x_, fraction_, 0)) return;
  const std::vector<uint32_t> places = disturbed_nodes(*model_, g_, rest_force_);
  const auto nodes = static_cast<double>(x_.size());
  if (places.empty() || static_cast<double>(places.size()) > many_disturbed * nodes) return;
  const auto most = static_cast<size_t>(piece_share * nodes);
  const LocalSubproblem region = cut_out(*model_, x_, places, {piece_radius, most, piece_leash});
  State piece;
  for (const uint32_t i : region.node) piece.x.push_back(x_[i]);
  piece.load = load;
  SolveOptions options;
  options.max_iterations = piece_iterations;
  options.residual = piece_rest * rest_force_;
  Newton newton(region.model, *factor_);
  newton.leash_ = piece_leash;
  newton.from_ = piece.x;
  const SolveStats done = newton.settle(piece, options, {});
  const auto &x = piece.x.get();
  for (size_t k = 0; k < x.size(); ++k) x_[region.node[k]] = x[k];
  stats_.work.add(done.work);
  evaluate();
}

void Newton::evaluate() {
  if (!total_energy_.prepared_for(x_)) total_energy_.prepare(x_, x_, slack_, stats_.work);
  energy_ = total_energy_.gradient(x_, g_, stats_.work);
  residual_ = largest_free(*model_, g_);
  MVS_MUST(std::isfinite(energy_) && std::isfinite(residual_), MVS_E_DIVERGED, "settle",
           "the forces are not finite: nodes coincide or the material is too stiff; check the "
           "rest shape and the materials");
}

void Newton::iterate() {
  if (residual_ < rest_force_ && wait_ == 0) {
    if (rest_step()) {
      // steps on the force and steps on the energy may undo each other: only a force that has
      // never been so small shows that rest is near
      if (residual_ < 0.5 * best_) {
        best_ = residual_;
        patience_ = 1;
      }
      return;
    }
    wait_ = patience_;
    patience_ = std::min(2 * patience_, most_patience);
  }
  wait_ = std::max(wait_ - 1, 0);
  travel_step();
}

// A full Newton step on the out-of-balance force; false, and nothing moved, unless it falls.
bool Newton::rest_step() {
  const double kept = shift_;
  shift_ = rest_shift_;
  assemble(Curvature::exact);
  factorise();
  const bool close = added_ < 1;
  rest_shift_ = added_ > least_shift ? relief * added_ : 0;
  shift_ = kept;
  solve(!close);
  limit_step();
  if (!try_force()) return false;
  evaluate();
  return true;
}

// Tissue that stiffens exponentially, and is held back by what it touches, is torn from a boundary
// that goes on: forces of 1e7 N, from which a valve does not come back. So the boundary waits.
bool Newton::may_move_boundary() {
  const bool may = residual_ < torn * rest_force_ || boundary_wait_ == longest_wait;
  boundary_wait_ = may ? 0 : boundary_wait_ + 1;
  return may;
}

// Moves the prescribed nodes towards their targets and carries the sheet along: the free nodes
// follow as the linearised system says, dx_f = -H_ff^-1 H_fb dx_b.
void Newton::move_boundary() {
  boundary_.assign(x_.size(), Vec3::Zero());
  for (uint32_t i = 0; i < x_.size(); ++i) {
    if (model_->topology.fixed[i]) boundary_[i] = model_->target(i, fraction_) - x_[i];
  }
  const double farthest = largest(boundary_);
  const double share = farthest > boundary_step ? boundary_step / farthest : 1.0;
  for (Vec3 &b : boundary_) b *= share;
  system_.boundary_step = &boundary_;
  assemble(Curvature::projected);
  system_.boundary_step = nullptr;
  factorise();
  rows_ = system_.boundary_force;
  solve_system(rows_);
  full_ = boundary_;
  for (size_t r = 0; r < rows_.size(); ++r) full_[system_.node_of[r]] = rows_[r];
  limit_step();
  for (uint32_t i = 0; i < x_.size(); ++i) {
    const bool arrives = model_->topology.fixed[i] && share == 1.0 && step_[i] == boundary_[i];
    x_[i] = arrives ? model_->target(i, fraction_) : Vec3(x_[i] + step_[i]);
  }
  evaluate();
}

// Makes step_ from full_: no node goes farther than allowed, none through another sheet.
void Newton::limit_step() {
  far_ = 0;
  step_ = full_;
  total_energy_.instrument().bodies().shorten(step_, longest_step);
  for (Vec3 &d : step_) {
    const double length = d.norm();
    if (length > 1.5 * longest_step) far_ += 1 / static_cast<double>(step_.size());
    if (length > longest_step) d *= longest_step / length;
  }
  for (size_t i = 0; i < from_.size(); ++i) {
    if ((x_[i] + step_[i] - from_[i]).squaredNorm() <= leash_ * leash_) continue;
    step_[i].setZero();
    held_ = true;
  }
  total_energy_.limit_step(x_, slack_, step_, stats_.work);
}

bool Newton::try_force() {
  const PhaseTimer timer(stats_.work, MVS_PHASE_LINE_SEARCH);
  Profile inside{};
  const double before = free_norm();
  std::vector<Vec3> kept = g_;
  double share = 1;
  for (int trial = 0; trial < 5; ++trial) {
    for (size_t i = 0; i < x_.size(); ++i) trial_[i] = x_[i] + share * step_[i];
    total_energy_.gradient(trial_, g_, inside);
    ++stats_.work.passes;
    if (free_norm() <= (1 - 0.1 * share) * before) {
      x_.swap(trial_);
      return true;
    }
    share *= 0.5;
  }
  g_ = std::move(kept);
  // the free edge is to be frozen, and contact known, at x again
  evaluate();
  return false;
}

double Newton::free_norm() const {
  double sum = 0;
  for (size_t i = 0; i < g_.size(); ++i) {
    if (!model_->topology.fixed[i]) sum += g_[i].squaredNorm();
  }
  return std::sqrt(sum);
}

}  // namespace mvs::core
