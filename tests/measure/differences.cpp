// Measures as functions of the positions: central differences over six decades of the step agree.
// A yes-or-no test of a sample, or a count, would show as a jump in one of them.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "measure/annulus/annulus.h"
#include "measure/coaptation/coaptation.h"
#include "measure/tenting/tenting_billow.h"
#include "tests/measure/closed_valve.h"
#include "tests/measure/shapes.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

// Six decades; and those below the distance of about 1 um between kinks of a largest or smallest
// value (of 100 places, of 5 sections and their pieces) and of the ends of a line. Below 1e-12 m
// rounding begins.
const std::vector<double> six_decades = {1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11};
const std::vector<double> between_kinks = {1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12};
// Below the distance between kinks at which the ball of the atrial surface touches another cell:
// some are nearer than 3e-8.
const std::vector<double> between_touches = {1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13};

using Measured = std::vector<double>;

Measured coaptation_area(const Model &model, const std::vector<Vec3> &x) {
  return {measure_coaptation(model, x).area};
}

Measured lengths_of_coaptation(const Model &model, const std::vector<Vec3> &x) {
  const Coaptation c = measure_coaptation(model, x);
  return {c.length_mean, c.length_min, c.length_max, c.height, c.depth};
}

Measured annulus_of(const Model &model, const std::vector<Vec3> &x) {
  const AnnulusMeasures a = measure_annulus(model, x);
  return {a.ap, a.cc, a.perimeter, a.area, a.area_3d, a.saddle_height, a.nonplanar_angle};
}

Measured billow_of(const Model &model, const std::vector<Vec3> &x) {
  const TentingBillow t = measure_tenting_billow(model, x);
  return {t.billow_height};
}

Measured tenting_of(const Model &model, const std::vector<Vec3> &x) {
  const TentingBillow t = measure_tenting_billow(model, x);
  return {t.tenting_volume, t.billow_volume, t.tenting_area};
}

Measured tenting_height(const Model &model, const std::vector<Vec3> &x) {
  return {measure_tenting_billow(model, x).tenting_height};
}

// Slopes below this share of a measure over 10 mm are judged by it: they are sums that cancel.
constexpr double least_slope = 0.2;
constexpr double scale = 10e-3;

void check_differences(const Shape &shape, double wave, int number,
                       const std::vector<double> &steps,
                       const std::function<Measured(const Model &, const std::vector<Vec3> &)> &of,
                       double smallest_slope = 0) {
  const auto at = [&](double h) {
    return of(*shape.model, moved(shape.x, [&](const Vec3 &p) -> Vec3 {
      return p + h * smooth_field(p, wave, number);
    }));
  };
  const Measured still = at(0);
  Measured low(still.size(), HUGE_VAL), high(still.size(), -HUGE_VAL);
  for (const double h : steps) {
    const Measured ahead = at(h), behind = at(-h);
    for (size_t k = 0; k < still.size(); ++k) {
      const double slope = (ahead[k] - behind[k]) / (2 * h);
      low[k] = std::min(low[k], slope);
      high[k] = std::max(high[k], slope);
    }
  }
  for (size_t k = 0; k < still.size(); ++k) {
    const double slope = std::max({std::abs(low[k]), std::abs(high[k]),
                                   least_slope * std::abs(still[k]) / scale, smallest_slope});
    CAPTURE(number);
    CAPTURE(k);
    CAPTURE(low[k]);
    CAPTURE(high[k]);
    CHECK(high[k] - low[k] <= 0.01 * slope);
  }
}

}  // namespace

TEST_CASE("differences_of_measures_agree_over_decades_of_the_step") {
  for (const double annulus_scale : {1.0, 1.15}) {  // sealed, leaking
    const Shape shape = closed_valve(annulus_scale);
    CHECK(measure_coaptation(*shape.model, shape.x).area > 10e-6);
    for (int k = 0; k < 3; ++k) {
      check_differences(shape, 60 + 30 * k, k, six_decades, coaptation_area);
      check_differences(shape, 60 + 30 * k, k, between_kinks, tenting_height);
      check_differences(shape, 60 + 30 * k, k, between_kinks, lengths_of_coaptation);
    }
    for (int k = 0; k < 3; ++k) {
      // the dilated valve does not billow: 0.1 mm3 over 1 mm is nothing
      check_differences(shape, 60 + 30 * k, k, between_touches, tenting_of, 1e-7);
    }
    check_differences(shape, 70, 3, {1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12}, annulus_of);
    check_differences(shape, 70, 3, between_kinks, billow_of);
  }
}

// Largest and smallest values have kinks, but no jumps: differences fall with the step.
TEST_CASE("extremes_of_coaptation_are_continuous") {
  for (const double annulus_scale : {1.0, 1.15}) {
    const Shape shape = closed_valve(annulus_scale);
    Measured last = lengths_of_coaptation(*shape.model, shape.x);
    for (int k = 1; k <= 60; ++k) {
      const Measured next =
          lengths_of_coaptation(*shape.model, moved(shape.x, [&](const Vec3 &p) -> Vec3 {
            return p + 1e-6 * k * smooth_field(p, 100, 5);
          }));
      for (size_t m = 0; m < next.size(); ++m) {
        CAPTURE(m);
        CHECK(std::abs(next[m] - last[m]) < 40e-6);  // nodes move by up to 2 um
      }
      last = next;
    }
  }
}

// The part of the slope that contact adds: the border of the contact zone moves as leaflets close
// in. Yes or no per sample has the slope of the sample's area alone, and jumps.
TEST_CASE("coaptation_area_has_the_slope_of_its_secants") {
  const Shape shape = closed_valve(1);
  const auto area = [&](double h) {
    return measure_coaptation(*shape.model, moved(shape.x,
                                                  [&](const Vec3 &p) -> Vec3 {
                                                    return p +
                                                           h * Vec3(p[0] > 0 ? 1 : -1, 0, 0) *
                                                               std::min(1.0, std::abs(p[0]) / 4e-3);
                                                  }))
        .area;
  };
  const double slope = (area(1e-8) - area(-1e-8)) / 2e-8;
  CHECK(std::abs(slope) > 1e-3);
  CHECK((area(5e-5) - area(-5e-5)) / 1e-4 == about(slope, 0.05));
}

// A closed valve settled again under slightly different pressures: three decades of the difference.
TEST_CASE("differences_of_measures_agree_through_settles") {
  const Shape shape = closed_valve(1);
  SolveOptions options;
  options.residual = 1e-8;
  options.max_iterations = 1000;
  State rest = initial_state(*shape.model);
  rest.x = shape.x;
  rest.load = {120 * 133.322, 1};
  CHECK(Solver(Backend::fastest).settle(*shape.model, rest, options, nullptr).converged);
  const auto at = [&](double share) {
    State state = rest;
    state.load.pressure *= 1 + share;
    CHECK(Solver(Backend::fastest).settle(*shape.model, state, options, nullptr).converged);
    const TentingBillow t = measure_tenting_billow(*shape.model, state.x);
    return Measured{t.tenting_volume, t.tenting_area, t.billow_volume,
                    measure_coaptation(*shape.model, state.x).area};
  };
  Measured low(4, HUGE_VAL), high(4, -HUGE_VAL);
  for (const double h : {1e-3, 1e-4, 1e-5, 1e-6}) {
    const Measured ahead = at(h), behind = at(-h);
    for (size_t k = 0; k < low.size(); ++k) {
      const double slope = (ahead[k] - behind[k]) / (2 * h);
      low[k] = std::min(low[k], slope);
      high[k] = std::max(high[k], slope);
    }
  }
  for (size_t k = 0; k < low.size(); ++k) {
    CAPTURE(k);
    CAPTURE(low[k]);
    CAPTURE(high[k]);
    CHECK(high[k] - low[k] <= 0.01 * std::max(std::abs(low[k]), std::abs(high[k])));
  }
}
