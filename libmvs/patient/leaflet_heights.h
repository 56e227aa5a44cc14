// Heights of the leaflets in samples around the annulus, about 1 mm apart.
#pragma once

#include <cstddef>
#include <vector>

namespace mvs::core {

// Mean over `half` neighbours on either side.
std::vector<double> smoothed(const std::vector<double> &values, size_t half);

// The greatest value over `half` neighbours on either side, then the least of those (morphological
// closing): notches narrower than 2 half + 1 samples are filled, everything wider stays.
std::vector<double> without_notches(const std::vector<double> &values, size_t half);

// The lowest sample within 2 mm: ends of the best fit are that exact, and indentations near.
size_t lowest_near(const std::vector<double> &profile, size_t at);

// Places beside both commissures, i and j, that are as low, and much lower than the leaflet on
// either side: clefts, or commissures of another leaflet.
size_t other_low_places(const std::vector<double> &height, size_t i, size_t j);

}  // namespace mvs::core
