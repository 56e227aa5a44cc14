// Every tuning constant of steps in time and of the tools in them, as in solve/settings.h.
#pragma once

#include <cstddef>
#include <cstdint>

namespace mvs::core::settings {

// One implicit Euler step.
namespace implicit {

// m, of a node of tissue in one step, and of a point of an instrument: a hand at 0.5 m/s with steps
// of 40 ms. An instrument that follows its hand by less in a step lags behind, and its spring pulls
// the hand back to where it was: into tissue that it has left, with net energy on the hand.
inline constexpr double max_displacement = 1e-3, max_instrument_displacement = 20e-3;
// Residual of a valve at rest, N: rest_residual at systolic pressure, less in proportion to the
// pressure, plus min_rest_residual; never above max_rest_residual.
inline constexpr double rest_residual = 1e-5, min_rest_residual = 1e-9;
inline constexpr double max_rest_residual = 1.0001e-5;
// Share of the contact thickness: the slack of the broad phase of a step without motion.
inline constexpr double broad_phase_slack = 0.1;
// Share of the contact thickness. Where no node moves farther, pairs outside the broad phase cannot
// be limited, and a broad phase of an earlier step serves.
inline constexpr double slow_displacement = 0.02;
// Energy line search: trials of a share of the limited step, the least and most share of the share
// before, and how often the whole step is quartered before it is limited again.
inline constexpr int trials = 8;
inline constexpr double min_share = 0.1, max_share = 0.5;
inline constexpr int quarterings = 12;
// Energy that rounding makes, as a share of the energy of the step's start.
inline constexpr double energy_rounding = 1e-12;
// Passes that the budget keeps for after the linear solve: one trial, and the forces where the
// valve stays.
inline constexpr uint32_t reserved_passes = 2;

}  // namespace implicit

// The linear system of an implicit step: conjugate gradients with the factor of an earlier step as
// preconditioner. One iteration costs about a tenth of a factorisation with its ordering.
namespace linear {

// Parts of about equal work in which a factorisation is spread over steps: pattern, numbers,
// numbers.
inline constexpr uint32_t factor_parts = 3;
// The same for sheets of at least so many triangles, whose factorisation takes as long as `worth`
// iterations or more. Nested dissection fills a factor of 20,000 vertices less than minimum degree
// over patches (1.79 against 2.35 million blocks, half the products, 23 ms against 80; with 6,800
// vertices 0.44 against 0.54 million; with 1,700 0.071 against 0.082, but it allocates memory).
inline constexpr size_t large_sheet = 8000;
inline constexpr uint32_t large_factor_parts = 6;
// Residual in the norm of the preconditioner, relative. The rest is small beside the error of
// linearising the step, and the forces of the next step contain it again.
inline constexpr double tolerance = 1e-3;
// After max_iterations a residual of max_residual is accepted and a new factor begun; above it a
// factor is made at once. That happens a few steps after a chord was cut or leaflets met: each step
// leads downhill, only less far.
inline constexpr uint32_t max_iterations = 10;
inline constexpr double max_residual = 0.3;
// More iterations or an older factor than this, and the next factor is begun. A factor in parts
// costs as much as ten iterations.
inline constexpr uint32_t many_iterations = 3;
inline constexpr uint32_t max_age = 20;  // steps
// Large sheets: the next factor is begun where the iterations beyond `few_iterations`, times the
// age of the factor in steps, exceed `worth`. If iterations grow in proportion to the age, the sum
// of iterations and factors is smallest at twice the cost of a factor in iterations.
inline constexpr uint32_t few_iterations = 2, worth = 20, max_large_age = 200;
// Residual that is accepted after many_iterations: a slow step does no more iterations for what
// linearising it leaves out anyway.
inline constexpr double late_tolerance = 1e-2;
// Factor by which the mass on the diagonal grows until an indefinite matrix can be factorised, and
// the multiple at which the budget of attempts ends.
inline constexpr double mass_growth = 4, max_mass = 1e18;

}  // namespace linear

// One explicit Euler step.
namespace explicit_euler {

inline constexpr double max_displacement = 1;  // m: a larger one is a diverged step
// Share of the contact thickness: the slack of the broad phase.
inline constexpr double broad_phase_slack = 0.1;
// Share of the largest stable step that is taken by default. The estimate is 9.2 us on the shipped
// valve, which is stable at 8 us (tests/solve/steps.cpp).
inline constexpr double stable_share = 0.9;
// Pa and 1: tangents of leaflets are taken up to this stress or stretch. Closed valves have up to
// 0.7 MPa, leaflets that hit each other ten times that.
inline constexpr double largest_stress = 10e6, largest_stretch = 4;

}  // namespace explicit_euler

// Instruments and their stiffness.
namespace tools {

// kg, mass of a point of an instrument, without which an implicit step could not move a point that
// no spring holds. At 1 kHz it adds a twentieth of the default spring of a hand; an instrument
// without inertia follows the hand at once.
inline constexpr double point_mass = 1e-5;
// s, time over which mass replaces the stiffness that slack tissue lacks: a hand stands still for
// that long.
inline constexpr double quasi_static_time = 0.1;
// Patterns that one elimination order serves; calls without the exact Hessian after it was
// indefinite, which it then stays for a while.
inline constexpr uint32_t patterns_per_order = 20, pause_after_indefinite = 8;
inline constexpr double mass_growth = 4, max_mass = 1e18;  // as in `linear`

}  // namespace tools

}  // namespace mvs::core::settings
