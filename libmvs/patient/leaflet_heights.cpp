// Means and morphology around a loop of samples.
#include "patient/leaflet_heights.h"

#include <algorithm>
#include <array>

namespace mvs::core {

std::vector<double> smoothed(const std::vector<double> &values, size_t half) {
  const size_t n = values.size();
  std::vector<double> mean(n, 0);
  for (size_t k = 0; k < n; ++k) {
    for (size_t j = 0; j <= 2 * half; ++j) mean[k] += values[(k + n + j - half) % n];
    mean[k] /= static_cast<double>(2 * half + 1);
  }
  return mean;
}

std::vector<double> without_notches(const std::vector<double> &values, size_t half) {
  const size_t n = values.size();
  std::vector<double> greatest(n), least(n);
  for (size_t k = 0; k < n; ++k) {
    greatest[k] = values[k];
    for (size_t j = 0; j <= 2 * half; ++j) {
      greatest[k] = std::max(greatest[k], values[(k + n + j - half) % n]);
    }
  }
  for (size_t k = 0; k < n; ++k) {
    least[k] = greatest[k];
    for (size_t j = 0; j <= 2 * half; ++j) {
      least[k] = std::min(least[k], greatest[(k + n + j - half) % n]);
    }
  }
  return least;
}

size_t lowest_near(const std::vector<double> &profile, size_t at) {
  constexpr size_t reach = 2;
  const size_t n = profile.size();
  size_t best = at;
  for (size_t k = 0; k <= 2 * reach; ++k) {
    const size_t there = (at + n + k - reach) % n;
    if (profile[there] < profile[best]) best = there;
  }
  return best;
}

size_t other_low_places(const std::vector<double> &height, size_t i, size_t j) {
  constexpr size_t beside = 8, around = 3;  // samples of about 1 mm
  constexpr double as_low = 1.15, much_lower = 0.65;
  const size_t n = height.size();
  const auto apart = [n](size_t a, size_t b) {
    const size_t d = a > b ? a - b : b - a;
    return std::min(d, n - d);
  };
  const double low = as_low * std::max(height[i], height[j]);
  size_t count = 0;
  for (size_t k = 0; k < n; ++k) {
    if (height[k] > low || apart(k, i) < beside || apart(k, j) < beside) continue;
    bool is_lowest = true;
    for (size_t d = 1; d <= around; ++d) {
      is_lowest =
          is_lowest && height[k] < height[(k + n - d) % n] && height[k] <= height[(k + d) % n];
    }
    if (!is_lowest) continue;
    std::array<double, 2> highest{};
    for (size_t side = 0; side < 2; ++side) {
      for (size_t at = k; at != i && at != j; at = (at + (side == 0 ? 1 : n - 1)) % n) {
        highest[side] = std::max(highest[side], height[at]);
      }
    }
    count += height[k] < much_lower * std::min(highest[0], highest[1]);
  }
  return count;
}

}  // namespace mvs::core
