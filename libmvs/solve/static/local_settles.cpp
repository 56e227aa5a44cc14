// Local subproblems of Newton's method: the neighbourhood of the nodes with the largest forces is
// settled alone, held by the remaining valve, before the first iteration (presolve) and after each
// one (nonlinear elimination).
//
// Near rest the error of the linear model of an iteration lies at few places: springs that pass the
// kink of their law, and hinges of tight folds (tests/bench/results/floors.md). On 27,000 vertices
// at most 330 nodes have more than 3 % of the residual, mostly 4 to 100, and each further iteration
// of the whole valve moved them by micrometres. Settled alone they take 0.05 to 0.8 s where an
// iteration takes 0.8 s, and the next linear model is true for a longer step (Lanzkron, Rose &
// Wilkes, SIAM J. Sci. Comput. 17, 1996; Cai & Li, SIAM J. Sci. Comput. 33, 2011).
//
// Passes and times of a local settle are counted. Its iterations, factorisations and linear
// iterations are not: they are of a small matrix.
#include <algorithm>
#include <cmath>

#include "energy/forces.h"
#include "solve/nodes.h"
#include "solve/settings.h"
#include "solve/static/local_subproblem.h"
#include "solve/static/newton.h"
#include "solve/static/newton_settling.h"

namespace mvs::core {
namespace {

// Free nodes with more than this force, N.
std::vector<uint32_t> disturbed_nodes(const Model &model, const std::vector<Vec3> &g,
                                      double force) {
  std::vector<uint32_t> nodes;
  for (uint32_t i = 0; i < g.size(); ++i) {
    if (g[i].squaredNorm() > force * force && !model.topology.fixed[i]) nodes.push_back(i);
  }
  return nodes;
}

bool are_many(const std::vector<uint32_t> &disturbed, size_t nodes, double max_share) {
  return static_cast<double>(disturbed.size()) > max_share * static_cast<double>(nodes);
}

// Forces averaged over the free leaflet nodes around each, several times: those of a load stay, as
// they point the same way all around, and those of noise in single positions cancel.
std::vector<Vec3> averaged(const Model &model, std::vector<Vec3> g) {
  const auto &edges = model.topology.edges.get();
  const auto &fixed = model.topology.fixed.get();
  std::vector<Vec3> sum;
  std::vector<double> count;
  for (int pass = 0; pass < settings::local_subproblem::averaging_passes; ++pass) {
    sum = g;
    count.assign(g.size(), 1);
    for (const Edge &e : edges) {
      if (fixed[e[0]] || fixed[e[1]]) continue;
      sum[e[0]] += g[e[1]];
      sum[e[1]] += g[e[0]];
      ++count[e[0]];
      ++count[e[1]];
    }
    for (size_t i = 0; i < g.size(); ++i) g[i] = sum[i] / count[i];
  }
  return g;
}

}  // namespace

bool far_from_rest(const Model &model, const State &state) {
  namespace set = settings::local_subproblem;
  if (!boundary_is_there(model, state.x, state.load.boundary_fraction, 0)) return true;
  const std::vector<Vec3> force = evaluate_forces(model, state).total;
  const double rest_force = scale_of(state.load) * mean_area(model);
  return are_many(disturbed_nodes(model, force, set::disturbed_residual * rest_force),
                  state.x.size(), set::max_disturbed_share);
}

bool Newton::has_many_disturbed() const {
  namespace set = settings::local_subproblem;
  const double force = set::disturbed_residual * rest_force();
  const auto are_disturbed = [&](const std::vector<Vec3> &g) {
    return are_many(disturbed_nodes(*model_, g, force), at_.x.size(), set::max_disturbed_share);
  };
  // Positions that are rounded to a micrometre have forces of noise. Over coarser meshes such a
  // valve would close into another fold.
  return are_disturbed(at_.gradient) && are_disturbed(averaged(*model_, at_.gradient));
}

void Newton::presolve_locally(const Load &load) {
  namespace set = settings::local_subproblem;
  const std::vector<uint32_t> disturbed =
      disturbed_nodes(*model_, at_.gradient, set::disturbed_residual * rest_force());
  if (disturbed.empty() || are_many(disturbed, at_.x.size(), set::max_disturbed_share)) return;
  settle_around(
      disturbed, load,
      {set::radius, {set::max_displacement}, set::residual * rest_force(), set::max_iterations});
}

// A local rest that leaves larger forces at its rim than it removed is given up. Where it lowers
// the forces little it pauses: far from rest nodes reach their limit of displacement at once.
void Newton::eliminate(const Load &load, double tolerance) {
  namespace set = settings::elimination;
  // this near to the equilibrium iterations converge quadratically and end more exactly
  const double near_rest = settings::stability::early_residual * rest_force();
  if (at_.residual <= std::max(tolerance, near_rest)) return;
  if (elimination_.waits()) return;
  const double force = std::max(set::force_share * at_.residual, tolerance);
  const std::vector<uint32_t> disturbed = disturbed_nodes(*model_, at_.gradient, force);
  if (are_many(disturbed, at_.x.size(), set::max_disturbed_share)) return;
  const double before = free_norm();
  const std::vector<Vec3> kept = at_.x;
  settle_around(disturbed, load,
                {set::radius * std::sqrt(mean_area(*model_)),
                 {set::max_displacement, std::min(lambda_, set::max_lambda)},
                 set::residual * force,
                 set::max_iterations});
  const double after = free_norm();
  if (after < set::worth_share * before) {
    elimination_.succeeded();
  } else {
    elimination_.failed(set::max_pause);
  }
  if (after <= before) return;
  at_.x = kept;
  evaluate();
}

void Newton::settle_around(const std::vector<uint32_t> &disturbed, const Load &load,
                           const LocalSettle &how) {
  const auto most = static_cast<size_t>(settings::local_subproblem::max_free_share *
                                        static_cast<double>(at_.x.size()));
  const LocalSubproblem region = make_local_subproblem(
      *model_, at_.x, disturbed, {how.radius, most, how.start.max_displacement});
  State state;
  for (const uint32_t i : region.node) state.x.push_back(at_.x[i]);
  state.load = load;
  SolveOptions options;
  options.max_iterations = how.max_iterations;
  options.residual = how.residual;
  options.checks_stability = false;
  const Progress poll = [this](double, double) {
    system_.poll();
    return true;
  };
  NewtonSettling settling(region.model, system_.lend_factor(), state, options, poll, how.start);
  const SolveStats done = run(settling, state);
  const auto &x = state.x.get();
  for (size_t k = 0; k < x.size(); ++k) at_.x[region.node[k]] = x[k];
  Profile counted = done.work;
  counted.linear_iterations = 0;
  stats_.work.add(counted);
  evaluate();
}

}  // namespace mvs::core
