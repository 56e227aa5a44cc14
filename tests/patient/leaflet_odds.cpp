// Guesses of the commissures from heights along an annulus and its shape.
#include "patient/leaflet_odds.h"
#include "tests/about.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace mvs::core;
using mvs::core::test::about;

namespace {

constexpr double pi = 3.141592653589793;
constexpr double end = 0.95;                   // of the anterior leaflet, rad
constexpr double cleft = 2.182, depth = 0.53;  // beside P2

// An annulus flat on its anterior side, in mm: 34.6 mm from A to P, 43 mm across.
Vec3 annulus_at(double t) {
  const double c = std::cos(t), r = c > 0 ? 1 - 0.1 * c * c : 1;
  return {17.29 * c * r, 21.48 * std::sin(t), 3.05 * std::cos(2 * t) - 1.03 * std::sin(t)};
}

// An anterior leaflet of 29 mm between both ends, a posterior one of 18 mm with indentations, both
// 10 mm high at the commissures; one cleft or both, `width` rad wide on either side.
double height_at(double t, double width, bool both) {
  const double away = std::abs(t), from_p2 = pi - away;
  if (away < end) return 9.88 + 19.35 * std::pow(std::cos(away / end * pi / 2), 0.8);
  const double dip = (from_p2 - 0.4 * (pi - end)) / 0.1;
  double h = 9.88 + 7.69 * std::sqrt(std::max(0.0, std::cos(from_p2 / (pi - end) * pi / 2))) -
             1.77 * std::exp(-dip * dip);
  const double off = std::abs((both ? std::abs(t) : t) - cleft) / width;
  if (off < 1) h = std::min(h, h * (1 - depth) + h * depth * off);
  return h;
}

// Heights without clefts narrower than 7 samples, averaged over 5, as the odds are asked for.
std::vector<double> smoothed(const std::vector<double> &height) {
  const auto around = [](const std::vector<double> &values, int half, auto take) {
    const int n = static_cast<int>(values.size());
    std::vector<double> made;
    for (int k = 0; k < n; ++k) {
      double value = values[k];
      for (int j = -half; j <= half; ++j) value = take(value, values[(k + j + n) % n]);
      made.push_back(value);
    }
    return made;
  };
  const auto most = [](double a, double b) { return std::max(a, b); };
  const auto least = [](double a, double b) { return std::min(a, b); };
  const std::vector<double> closed = around(around(height, 3, most), 3, least);
  std::vector<double> sum = around(closed, 2, [](double a, double b) { return a + b; });
  for (size_t k = 0; k < sum.size(); ++k) sum[k] = (sum[k] - closed[k]) / 5;
  return sum;
}

// The guessed arc: the angles of its ends, and the odds of the side.
struct Guess {
  double from, to, orientation;
};

Guess guess_with(double width, bool both) {
  constexpr int dense = 4000;
  constexpr size_t samples = 120;
  std::vector<double> way = {0};
  const auto angle = [](double k) { return -pi + 2 * pi * k / dense; };
  for (int k = 0; k < dense; ++k) {
    way.push_back(way.back() + (annulus_at(angle(k + 1)) - annulus_at(angle(k))).norm());
  }
  AnnulusSamples annulus;
  std::vector<double> at;
  for (size_t k = 0; k < samples; ++k) {
    const double s = (static_cast<double>(k) + 0.5) / samples * way.back();
    at.push_back(
        angle(static_cast<double>(std::lower_bound(way.begin(), way.end(), s) - way.begin())));
    annulus.points.push_back(annulus_at(at.back()) * 1e-3);
    annulus.height.push_back(height_at(at.back(), width, both) * 1e-3);
  }
  annulus.height = smoothed(annulus.height);
  const ArcGuess guess = ArcOdds(annulus).best(0.28);
  return {at[guess.from], at[guess.to % samples], guess.orientation};
}

// 25 degrees are 8 samples; the lowest place near a guess is looked for afterwards (leaflets.cpp).
void check_ends(const Guess &guess) {
  CHECK(std::abs(guess.from + end) < 25 * pi / 180);
  CHECK(std::abs(guess.to - end) < 25 * pi / 180);
  CHECK(guess.orientation > 0.5);
}

}  // namespace

TEST_CASE("commissures_at_a_third_of_the_annulus_are_found_beside_a_wide_cleft") {
  // The textbook share: the line between the commissures passes nearer to the aorta than in
  // parametric valves, and with cues made for those one foot was put into the cleft, 70 degrees
  // off.
  check_ends(guess_with(0.278, false));
}

TEST_CASE("indentations_on_both_sides_of_p2_are_no_commissures") {
  // As low as the commissures and wider than clefts: one foot was put into one of them, 62 degrees
  // off, when only the heights at the ends of an arc and its greatest height counted.
  check_ends(guess_with(0.35, true));
}

TEST_CASE("one_of_three_leaflets_alike_is_the_anterior_one_with_a_third_of_the_probability") {
  constexpr size_t samples = 120;
  AnnulusSamples annulus;
  for (size_t k = 0; k < samples; ++k) {
    const double t = 2 * pi * (static_cast<double>(k) + 0.5) / samples;
    annulus.points.emplace_back(18e-3 * std::cos(t), 18e-3 * std::sin(t), 0);
    annulus.height.push_back(8e-3 + 10e-3 * std::abs(std::sin(1.5 * t)));
  }
  const ArcOdds odds(annulus);
  const ArcGuess guess = odds.best(0.28);
  // each of three arcs, a third of the way apart, is as likely; together they cover the annulus
  // once, and overlap by the share of each above a third
  const double share = static_cast<double>(guess.to - guess.from) / samples;
  CHECK(share == about(1.0 / 3, 0.12));
  CHECK(guess.orientation == about(1.0 / 3, 0.12));
  // of these two ends alone, the smaller side is far likelier
  CHECK(odds.is_anterior(guess.from, guess.to) > 0.9);
}
