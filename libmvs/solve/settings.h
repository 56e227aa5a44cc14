// Every tuning constant of the solvers: name, value, unit, meaning, evidence. "Rest force" is the
// force of the pressure on a node of mean area, N. A value without stated evidence is a round
// figure with which the tests of tests/solve pass; its sensitivity was not measured. Those of
// coarser meshes are in solve/hierarchy_settings.h, of steps in time in solve/step_settings.h.
#pragma once

#include <cstdint>
#include <iterator>

#include "energy/settings.h"

namespace mvs::core::settings {

// Defaults of the options in include/mvs/sim.h.
namespace defaults {

inline constexpr double residual = 1e-5;             // N, largest out-of-balance nodal force
inline constexpr double implicit_dt = 1e-3;          // s: one step of a 1 kHz haptic loop
inline constexpr double explicit_dt = 8e-6;          // s, at most: stable on the shipped valve
inline constexpr double explicit_damping = 500;      // 1/s
inline constexpr uint32_t budget = 64;               // passes and factorisations of a step
inline constexpr uint32_t settle_budget = 10000;     // of a step while settling: no limit
inline constexpr uint32_t newton_iterations = 1000;  // at most
inline constexpr uint32_t implicit_steps = 20000;    // at most, while settling
inline constexpr uint32_t explicit_steps = 2000000;  // at most, while settling

}  // namespace defaults

// Settling by steps in time.
namespace settle {

// Steps in a row below the residual. A valve that passes through balance in motion is not at rest.
inline constexpr int calm_steps = 10;
// m, distance of a prescribed node from its target that counts as rounding.
inline constexpr double boundary_arrival = 1e-9;
// Steps between two calls of the progress callback.
inline constexpr uint32_t steps_per_report = 64;
// Shares of the reported progress at the end of the boundary's way, and at the end of the last
// iteration; 1 is reported when the settle is over.
inline constexpr double boundary_progress = 0.5, settled_progress = 0.99;
// A leaflet with more than this multiple of its rest area yields without end. Closed valves have
// 1.1 to 1.6; tissue tears below 4.
inline constexpr double max_area_ratio = 10;
// Iterations between two looks at the areas, which take a hundredth of the time of an iteration.
inline constexpr uint32_t looks_per_area = 4;

}  // namespace settle

// Motion of the prescribed nodes (annulus and papillary heads).
namespace boundary {

// m, largest increment in one static iteration. The contact thickness is 1 mm by default.
inline constexpr double max_increment = 0.5e-3;
// m, distance from the target up to which a valve counts as near rest: a tenth of the default
// contact thickness. Over coarse meshes it may come to rest in another fold, with another leak.
inline constexpr double near_distance = 0.1e-3;
// m/s, largest speed in live steps.
inline constexpr double max_speed = 0.1;
// Rest forces above which the boundary waits in static iterations. Tissue with an exponential law
// that is held by contact reached 1e7 N when the boundary moved on, and did not recover.
inline constexpr double max_static_residual = 1e3;
// Iterations that the boundary waits at most: tissue that is stuck may need the boundary to get
// free.
inline constexpr uint32_t max_static_wait = 20;
// The same for live steps. Of nine moving annuli with exponential laws, in 40 steps each, six stay
// below 13 N, two have single steps of 2e3 and 3e3 N; with 100 in place of 10 one reaches 8e5 N.
inline constexpr double max_live_residual = 10;
inline constexpr uint64_t max_live_wait = 20;  // steps
// m, distance from the target within which a live step sets the node onto its target.
inline constexpr double snap_distance = 1e-12;

}  // namespace boundary

// Static closure by Newton iterations.
namespace newton {

// m, largest displacement of a node in one iteration: the default contact thickness.
inline constexpr double max_displacement = 1e-3;
// Multiples of max_displacement from which a node counts as much too far.
inline constexpr double far_factor = 1.5;
// Share of the contact thickness by which nodes may leave the path that the broad phase was built
// for. Steps far from rest need a new broad phase anyway, steps near rest are far smaller.
inline constexpr double broad_phase_slack = 0.02;
// The trust region uses the exact Hessian, and polish steps are tried, where all forces are below
// those of the pressure on these areas, m2, and below these multiples of the rest force. Meshes of
// one valve need about the same force, so that the areas count on coarse ones: on 425 vertices 4
// and 1 rest forces, where the exact Hessian is indefinite, take 15 to 25 % more time than these
// areas (springs and bilinear, each under five loads). On 6,800 vertices a quarter of the multiple
// takes 15 iterations for 11.
inline constexpr double exact_hessian_area = 0.65e-6, exact_hessian_residual = 4;
inline constexpr double polish_area = 0.25e-6, polish_residual = 1;
// Stiffness that lambda = 1 adds is pressure times element size. This least lambda keeps slack
// branch points and loose flaps solvable.
inline constexpr double min_lambda = 1e-4;
// Factor and least value of lambda after a factorisation failed, and the value at which the matrix
// counts as not finite. Against 3 and 0.05: S with May-Newman and Yin's law 77 factorisations for
// 124, iterations 60 for 90; springs 43 for 45; others alike.
inline constexpr double failed_lambda_growth = 5, failed_lambda = 0.2, max_failed_lambda = 1e12;
// Factorisations in single precision before double precision is tried as well. On the valves of
// `bench_closure`, 122 of 122 double ones failed that followed a failed single one at once.
inline constexpr uint32_t cheap_factorisations = 4;
// Contact asks for blocks outside the pattern in most iterations, and an elimination order is good
// for a few such patterns, until contact joins parts of the sheet that it had separated: 1,680
// vertices of membrane took 2.5 times the products of a new order. The next pattern has a new one
// once the products beyond those of the first factor in this order exceed the cost of an order,
// which is that of so many products a row (ski rental: at most twice the cost of the best moments,
// Karlin et al., Algorithmica 3, 1988), and at the latest after so many patterns.
inline constexpr double products_per_order = 1000;
inline constexpr uint32_t patterns_per_order = 6;
// GMRES with the factor for the skew part of the load at the free edge: iterations at most,
// relative residual.
inline constexpr int gmres_iterations = 30;
inline constexpr double gmres_tolerance = 1e-3;

// Polish steps near rest: lambda below which the step leaves lambda out of the solution, and the
// share of the lambda that the last one needed with which the next begins. A lambda that stays
// after the valve has left the place that needed it slows down all following steps.
inline constexpr double max_removed_lambda = 1, polish_lambda_share = 0.1;
// Share of the smallest residual so far that counts as progress towards rest, and the longest pause
// after a failed polish step, iterations.
inline constexpr double polish_progress = 0.5;
inline constexpr int max_polish_pause = 64;
// Iterations in a row without motion after which a settle ends: more than the longest pause, so
// that each kind of step was tried.
inline constexpr uint32_t most_still = max_polish_pause + 6;
// Backtracking on the norm of the force: trials, factor, sufficient decrease (Armijo). Shares below
// a half are left to the trust region: where the whole step crosses kinks of stiff springs, shares
// of 1/8 lowered the norm by a twentieth, ten times in a row. With 2 trials for 5, springs of
// 27,000 vertices take 26 iterations for 33; on up to 6,800 vertices they are as many.
inline constexpr int polish_trials = 2;
// The same after a return to an unstable equilibrium: in the cycle around it shares of 1/32 to a
// quarter lead back. Already after the first leaving, they led back at once from a place from which
// others lead to a stable equilibrium.
inline constexpr int patient_trials = 7;
inline constexpr double polish_backtracking = 0.5, polish_decrease = 0.1;

// Iterations without a lower energy or residual after which Newton's method wanders, and steps in
// time at most that lead out of it.
inline constexpr uint32_t wander_iterations = 150, wander_steps = 400;

}  // namespace newton

// Trust region on the energy (Conn, Gould, Toint, Trust-Region Methods, 2000).
namespace trust_region {

inline constexpr int trials = 8;  // of one iteration; every second one factorises
inline constexpr double max_lambda = 1e6;
// Gain ratio above which a step is accepted.
inline constexpr double accepted_gain = 0.01;
// Gain ratios between which lambda stays, and above which it falls faster.
inline constexpr double poor_gain = 0.2, good_gain = 0.6, very_good_gain = 0.9;
// Factors of lambda after a poor, a good and a very good step, and the least lambda after a poor
// one. Below zero_lambda a good step sets lambda to 0.
inline constexpr double poor_growth = 4, good_decay = 0.3, very_good_decay = 0.1;
inline constexpr double poor_lambda = 0.03, zero_lambda = 1e-3;
// Share of the nodes that may be much too far before lambda grows, its factor and least value.
// Fewer nodes are only shortened, so that a chord that pulls tight does not stiffen the whole
// valve.
inline constexpr double max_far_share = 0.03;
inline constexpr double far_growth = 2, far_lambda = 0.01;
// After an accepted step that raised the energy because the load at the free edge changed.
inline constexpr double raised_growth = 2, raised_lambda = 0.03;
// Share of the step before that every second trial tries, at most and at least. Eighteen closings
// of real and parametric valves took 3,400 to 3,600 iterations with a least share of 0.03 to 0.25,
// and 3,900 with 0.5.
inline constexpr double max_shortening = 0.5, min_shortening = 0.2;
// Share of its step below which a node counts as stopped by the step limiter, and the share of the
// nodes above which no node is held.
inline constexpr double stopped_share = 0.9, max_stopped_share = 0.03;
// Largest stiffness of a held node, as a multiple of its own.
inline constexpr double max_stiffening = 1e3;
// Lambda above which stopped nodes are held. Needles of a real mesh (Kaiser N64), which are always
// stopped, take fewer iterations when they are not held below it.
inline constexpr double min_stiffening_lambda = 100;

}  // namespace trust_region

// Stability of the equilibrium that a settle has found.
namespace stability {

// 1/s, mass-proportional: the damping of overdamped motion, as explicit_damping. The signs of rates
// do not depend on its size.
inline constexpr double damping = 500;
// 1/s, the largest rate that counts as stable: it takes 1,000 s, many heart beats, to grow by e.
// Rounding makes rates of about 1e-5 where a mode has no stiffness.
inline constexpr double max_rate = 1e-3;
// N/m, of a branch point: below it the point is left out. It is that of a chord of 10 mm under
// 1e-5 N, the default residual of a settle. Leaflets have 0.05 and more.
inline constexpr double loose_stiffness = 1e-3;
// Relative residual of eigenpairs, and their iterations at most. The error of a lone eigenvalue is
// of second order in it, of one among others as large as it: with 1e-2 a margin was 1.01 % off.
inline constexpr double error = 5e-3;
// The same of the rightmost eigenvalue where the factorisation has proved stability, so that it
// decides nothing: 0.2 % off at most in 68 closures with a removed chord (300 to 1,700 vertices,
// both shapes; measured once, by no command of the repository), 3.6 % with twice this residual.
inline constexpr double rate_error = 0.05;
inline constexpr uint32_t most_iterations = 60;
// N/m, added to an indefinite matrix: first, growing by, at most. A later check of the same settle
// begins with a growth below what the last one needed: S takes 49 factorisations for 54.
inline constexpr double min_shift = 0.01, shift_growth = 4, max_shift = 1e12;
// m, the longest displacement of a node by which a settle leaves an unstable equilibrium: at first;
// at most, while the energy falls. The next stable one was mostly 14 to 130 um away where one was
// found. After every second return a share of it: one of 500 random valves had it 2 um away
// (tests/solve/unstable.cpp), and one after a resection came to rest with the larger share only.
inline constexpr double leave_by = 1e-5, leave_at_most = 1e-3;
inline constexpr double leave_shares[] = {1, 0.25, 4};
// Returns to one unstable equilibrium after which a settle ends there, and the share of leave_by
// within which it is the same one. Around an equilibrium that flutters the valve moves in a cycle,
// of 80 um at the free edge of a valve on a real annulus, and no iteration leads away from it.
inline constexpr uint32_t most_returns = 2 * static_cast<uint32_t>(std::size(leave_shares));
inline constexpr double returned_share = 0.5;
// Rest forces below which the stability is that of the equilibrium nearby.
inline constexpr double early_residual = 0.03;
// How often a settle leaves an unstable equilibrium before it has converged to it. Where the stable
// one is nearer than leave_by each of these passes it, in a cycle without end; 1,700 vertices with
// Prot's law need more than 8.
inline constexpr uint32_t most_early_leaves = 32;

}  // namespace stability

// The local subproblem around a disturbance that is settled before the whole valve. An operation
// disturbs a few nodes, a load all of them; share and radius are where subproblem and whole valve
// together cost least.
namespace local_subproblem {

inline constexpr double disturbed_residual = 0.25;  // rest forces: above it a node is disturbed
inline constexpr double max_disturbed_share = 0.1;  // of the nodes: above it no subproblem
// Averages over neighbours before a valve counts as far from rest as a whole. Noise of 1 um in all
// positions has forces of up to two rest forces at nodes, of which these leave a twentieth.
inline constexpr int averaging_passes = 4;
inline constexpr double max_free_share = 0.2;     // of the nodes that are free in it
inline constexpr double radius = 10e-3;           // m, around the disturbed nodes
inline constexpr double max_displacement = 4e-3;  // m, of a node from its start
inline constexpr uint32_t max_iterations = 12;
inline constexpr double residual = 0.2;  // rest forces: its rim is as far from rest

}  // namespace local_subproblem

// Nonlinear elimination: the local subproblem around the nodes with the largest forces that is
// settled after an iteration of the whole valve. Springs of 27,000 vertices (finest mesh, load x
// 0.996; measured once, by no command of the repository) take 30 iterations without it and 10 with
// these values; 13 with a force share of 0.1, 12 with 0.05 of the nodes. On 1,700 vertices the same
// are 12, 9, 10 and 8.
namespace elimination {

inline constexpr double force_share = 0.03;  // of the residual: above it a node is disturbed
inline constexpr double max_disturbed_share = 0.02;  // of the nodes: above it no subproblem
inline constexpr double radius = 3;                 // around the disturbed nodes, mean edge lengths
inline constexpr double max_displacement = 0.2e-3;  // m, of a node from its start
inline constexpr double max_lambda = 0.01;          // with which it starts
inline constexpr uint32_t max_iterations = 6;
inline constexpr double residual = 0.1;  // of the force above which nodes are disturbed
// Share of the norm of all forces below which it was worth its cost; if it was not, iterations
// until the next one, doubled each time, at most.
inline constexpr double worth_share = 0.5;
inline constexpr int max_pause = 64;

}  // namespace elimination

}  // namespace mvs::core::settings
