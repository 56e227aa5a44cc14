// Tenting height of regions: continuous where a crevice lies between two of them.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "measure/regions/regions.h"
#include "measure/tenting/tenting_billow.h"
#include "tests/measure/closed_valve.h"
#include "tests/measure/continuity.h"
#include "tests/measure/shapes.h"

namespace mvs::core::test {
namespace {

std::vector<RegionMeasures> regions_of(const Model &model, const RegionMap &map,
                                       const std::vector<Vec3> &x) {
  Coaptation coaptation;  // no figure of these tests depends on it
  coaptation.share.assign(model.valve.triangles.size(), 0.0);
  OrificeParts sealed;
  sealed.gap_of_region.assign(map.size(), 0.0);
  return measure_regions(model, x, map, coaptation, sealed, atrial_surface(model, x));
}

// Two walls with a crevice in the middle that is 3 mm deeper at one end, and as near to one leaflet
// as to the other all along: which is the nearest is rounding.
Sheet crevice() {
  ClosedShape closed;
  closed.wall = [](double along, double down, double side) -> Vec3 {
    return {0.5 * walls_gap * side, along, -down - 100 * along * std::max(along, 0.0) * 0.15};
  };
  return sheet_of(closed);
}

}  // namespace

TEST_CASE("both_leaflets_are_as_deep_as_the_crevice_between_them") {
  const ModelPtr model = model_of(crevice());
  const RegionMap map(*model);
  const std::vector<Vec3> &x = model->valve.rest;
  const double whole = measure_tenting_billow(*model, x).tenting_height;
  const std::vector<RegionMeasures> regions = regions_of(*model, map, x);
  REQUIRE(map.scallops() == 2);
  CHECK(regions[0].tenting_height == whole);
  CHECK(regions[1].tenting_height == whole);
}

// The crevice passes over cells of the raster.
TEST_CASE("tenting_heights_of_regions_are_continuous") {
  const ModelPtr model = model_of(crevice());
  const RegionMap map(*model);
  const auto heights = [&](double share) {
    const auto regions =
        regions_of(*model, map, moved(model->valve.rest, [&](const Vec3 &p) -> Vec3 {
          const double inside =
              std::max(0.0, 1 - std::pow(p[0] / 14e-3, 2) - std::pow(p[1] / 18e-3, 2));
          return p + 0.5e-3 * share * inside * Vec3(1, 0, 0);
        }));
    return std::array<double, 2>{regions[0].tenting_height, regions[1].tenting_height};
  };
  for (const size_t region : {0u, 1u}) {
    CAPTURE(region);
    check_continuous([&](double share) { return heights(share)[region]; }, 40);
  }
}

// Both halves of a dilated parametric valve leak alike, and whatever the order of the free edge is.
TEST_CASE("tenting_heights_of_regions_beside_openings_do_not_depend_on_the_numbering") {
  const Shape shape = closed_valve(1.4);
  const auto heights = [](const Model &model, const std::vector<Vec3> &x) {
    std::vector<double> found;
    for (const RegionMeasures &m : regions_of(model, RegionMap(model), x)) {
      found.push_back(m.tenting_height);
    }
    return found;
  };
  const std::vector<double> still = heights(*shape.model, shape.x);
  Valve valve = shape.model->valve;
  const Renumbered other = renumbered(valve);
  const std::vector<double> again = heights(*other.model, other(shape.x));
  REQUIRE(still.size() == again.size());
  for (size_t r = 0; r < still.size(); ++r) CHECK(again[r] == about(still[r], 1e-9));
}

}  // namespace mvs::core::test
