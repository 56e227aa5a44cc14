// Constants of the sensitivities.
#pragma once

namespace mvs::core::settings::sensitivity {

// Share of the contact thickness: the slack of the broad phase around the equilibrium.
inline constexpr double broad_phase_slack = 0.1;

// Solutions. GMRES reduces the preconditioned residual by gmres_tolerance: two iterations more than
// 1e-10 takes, and in most cases no second round of refinement. Such a round reduces the rest to
// refined_share of solve_tolerance, below it since the true residual is not that which is
// preconditioned. solve_tolerance is seldom reached where folds are soft: they have displacements
// whose forces cancel to 1e-11. solve_limit is the error that is refused.
inline constexpr int gmres_iterations = 100, refinements = 4;
inline constexpr double gmres_tolerance = 1e-12, solve_tolerance = 1e-12, refined_share = 0.1,
                        solve_limit = 1e-6;

// Solutions from which a dense factor over the free edge may pay, and its rows at most: it takes
// one solution with Ks a row, and saves the ten to thirty iterations of GMRES of each solution.
inline constexpr unsigned many_solutions = 12, most_dense_rows = 900;

// Factor of an indefinite Ks: N/m on its diagonal.
inline constexpr double first_shift = 1e-4, shift_growth = 4, most_shift = 1e12;

// Smallest eigenvalue of Ks.
inline constexpr double eigenvalue_error = 0.1;
inline constexpr unsigned eigenvalue_iterations = 60;

// m, displacement of the fastest node in a difference of a measure: between the rounding of the
// measures and the distance of their kinks (libmvs/measure/DEFINITIONS.md).
inline constexpr double measure_step = 1e-8;

// Errors of a derivative at a distance `slack`, relative to the fastest node: the mean of both
// sides, which only a switch makes, and half of their difference, which curvature makes as well.
inline constexpr double mean_error = 3e-5, side_error = 1e-2;
// Share of `slack` at which a derivative has to hold where the difference alone is larger: six of
// 400 pairs of a valve and a parameter have 1 to 3 % at a slack of 1e-7 m, soft folds along
// constants.
inline constexpr double nearer = 0.1;
// Displacement of the fastest node, as a share of the change of a chord's length, below which a
// motion counts as this much: rounding of the forces makes 1e-8 of it.
inline constexpr double least_motion = 1e-3;

// Switches up to which one-sided derivatives are computed: each takes a solution. Changes of their
// states: of all that contradict at first, one by one later. And Newton's method for contact that
// begins, relative to the fastest switch.
inline constexpr size_t most_switches = 64;
inline constexpr int most_state_changes = 300, block_changes = 8, newton_iterations = 60;
inline constexpr double newton_tolerance = 1e-12;

// Share of the rest tolerance by which the out-of-balance force may exceed it: by rounding.
inline constexpr double rest_share = 1.01;

// N/m, a smallest eigenvalue of Ks below which a fold is about to snap. Closed valves have 0.05
// to 1.
inline constexpr double near_snap = 1e-3;
// 1/s, the same where Ks is indefinite: the rate at which the valve returns, of an eigenvalue of
// 1e-3 N/m on the mass of a node, about 1 mg, with the damping of 500 1/s.
inline constexpr double near_snap_rate = 2;

// Idle branch points: tension over the rest tolerance up to which a chord bears nothing, and m, the
// slack that they get.
inline constexpr double idle_share = 2, idle_margin = 1e-6;

}  // namespace mvs::core::settings::sensitivity
