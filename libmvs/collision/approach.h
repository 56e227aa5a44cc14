// Shares and distances that a limited step keeps.
#pragma once

namespace mvs::core {

// Share of a distance that one step may use up. The rest is far more than rounding errors.
inline constexpr double usable_share = 0.9;
// m, the least distance of an instrument from the sheet: large enough that a pair that was pressed
// together parts again soon. A Newton step on a logarithm doubles its distance, and from 1e-10 m a
// ball that a hand drew back stuck in the tissue for twenty steps.
inline constexpr double least_tool_distance = 1e-6;

}  // namespace mvs::core
