// Coaptation lines of leaking valves: continuous where parts of a line begin, end and lie apart.
#include <doctest/doctest.h>

#include <cmath>

#include "measure/coaptation/coaptation_line.h"
#include "tests/measure/continuity.h"
#include "tests/measure/shapes.h"

namespace mvs::core::test {
namespace {

constexpr double radius = 15e-3, spacing = 2e-3;

// Part of a line: pieces at angles around the pole, 2 mrad apart, in a band of 1 mm. `weight`
// scales their area.
struct Part {
  double from, to, weight = 1;
};

CoaptationLine line_of(const std::vector<Part> &parts) {
  std::vector<CoaptedPiece> pieces;
  for (const Part &part : parts) {
    const int count = static_cast<int>(std::ceil((part.to - part.from) / 2e-3));
    for (int k = 0; k < count; ++k) {
      const double angle = part.from + 2e-3 * k;
      for (const double z : {-0.5e-3, 0.0, 0.5e-3}) {
        const Vec3 out(std::cos(angle), std::sin(angle), 0);
        pieces.push_back({radius * out + Vec3(0, 0, z), out, 1e-8 * part.weight});
      }
    }
  }
  return find_coaptation_line(pieces, Vec3::Zero(), Vec3(0, 0, 1), spacing);
}

double mean_length(const CoaptationLine &line) {
  return line.area / line.length;
}

}  // namespace

// The area of the part beyond the gap passes the share that is left out at the end of a line.
TEST_CASE("a_line_grows_steadily_over_a_gap_to_a_part_that_appears") {
  for (const double gap : {0.05, 0.3, 0.6}) {
    CAPTURE(gap);
    const auto line = [&](double share) {
      // up to 2 % of the area
      return line_of({{-0.8, 0.7, 1}, {0.7 + gap, 0.8 + gap, 0.3 * share}});
    };
    check_continuous([&](double share) { return line(share).length; });
    check_continuous([&](double share) { return mean_length(line(share)); });
    // all but 0.5 % of the area at either end; arcs are smoothed by a few percent
    CHECK(line(0).length == about(radius * 1.5, 0.02));
    CHECK(line(1).length == about(radius * (1.5 + gap), 0.05));
  }
}

// Points of the line amid the gap lose their last pieces when the part in between vanishes.
TEST_CASE("a_line_is_straight_over_a_gap_where_a_part_vanished") {
  const auto line = [](double share) {
    return line_of({{-1, -0.6, 1}, {-0.05, 0.05, 1 - share}, {0.6, 1, 1}});
  };
  check_continuous([&](double share) { return line(share).length; });
  check_continuous([&](double share) { return mean_length(line(share)); });
  // two arcs and the chord between them; arcs are smoothed by a few percent
  CHECK(line(1).length == about(radius * (0.8 + 2 * std::sin(0.6)), 0.05));
}

// A part that shrinks from its end leaves the windows of points in the gap one piece at a time. Its
// pieces are spread over 0.01 rad at an end of the line only: here it shrinks by their area.
TEST_CASE("points_in_a_gap_let_go_of_the_last_piece_near_them") {
  const auto line = [](double share) {
    return line_of({{-1, -0.5, 1}, {-0.5, -0.498, 1 - share}, {0.5, 1, 1}});
  };
  check_continuous([&](double share) { return line(share).length; });
}

// Whatever the number of stations, which is rounded.
TEST_CASE("the_profile_of_a_line_is_continuous_in_its_length") {
  const auto profile = [](double share) {
    const double turn = 0.9 + 0.2 * share;  // 27 to 33 mm
    std::vector<CoaptedPiece> pieces;
    for (int k = 0; k <= 1000; ++k) {
      const double angle = turn * (k * 2e-3 - 1);
      const Vec3 out(std::cos(angle), std::sin(angle), 0);
      pieces.push_back({radius * out, out, 1e-8 * (1.5 + std::sin(3 * angle))});
    }
    return find_coaptation_line(pieces, Vec3::Zero(), Vec3(0, 0, 1), spacing).profile;
  };
  CHECK(profile(0).size() == profile(1).size());
  const size_t middle = profile(0).size() / 3;
  check_continuous([&](double share) { return profile(share)[middle].length; });
  check_continuous([&](double share) { return profile(share)[middle].point[1]; });
}

}  // namespace mvs::core::test
