// Tissue of the commissures.
#include "measure/regions/region_map.h"

#include <doctest/doctest.h>

#include <cmath>

#include "anatomy/parametric.h"
#include "model/model.h"
#include "tests/measure/shapes.h"

namespace mvs::core::test {
namespace {

constexpr double mm = 1e-3;

}  // namespace

TEST_CASE("a_commissure_is_where_attachments_of_leaflets_meet") {
  Valve three = valve_of(disc(16 * mm, 4 * mm, [](double, double) { return 0; }));
  three.leaflets.resize(3);
  three.leaflets[2].name = "S";
  for (size_t t = 0; t < three.triangles.size(); ++t) {
    // the half of P with y < 0 becomes a leaflet of its own
    const Tri &c = three.triangles[t];
    const Vec3 middle = (three.rest[c[0]] + three.rest[c[1]] + three.rest[c[2]]) / 3;
    if (three.triangle_leaflet[t] == 1 && middle[1] < 0) three.triangle_leaflet[t] = 2;
  }
  const RegionMap map(*make_model(three));
  REQUIRE(map.size() == 6);
  CHECK(map.name(3) == "A-P");
  CHECK(map.name(4) == "A-S");
  CHECK(map.name(5) == "P-S");
  // 10 % of the annulus each
  std::vector<size_t> triangles(map.size());
  for (uint32_t t = 0; t < three.triangles.size(); ++t) {
    map.for_each(t, [&](uint32_t region) { ++triangles[region]; });
  }
  const double tenth = 0.1 * static_cast<double>(three.triangles.size());
  for (size_t k = 3; k < 6; ++k) {
    // 48 edges around: up to a half of one at either end
    CHECK(std::abs(static_cast<double>(triangles[k]) - tenth) <= tenth / 4.8 + 1);
  }
  // one leaflet along the whole annulus has none
  Valve one = valve_of(disc(16 * mm, 4 * mm, [](double, double) { return 0; }));
  one.leaflets.resize(1);
  for (size_t t = 0; t < one.triangles.size(); ++t) one.triangle_leaflet[t] = 0;
  CHECK(RegionMap(*make_model(one)).size() == 1);
}

TEST_CASE("commissures_of_leaflets_without_scallops_are_named_by_their_side") {
  // the parametric valve, whose A1 and P1 are anterolateral, with one scallop for each leaflet
  const ModelPtr scalloped = make_model(make_parametric_valve({}));
  Valve plain = scalloped->valve;
  plain.scallops.clear();
  for (uint32_t l = 0; l < plain.leaflets.size(); ++l) {
    plain.scallops.push_back({.id = plain.next_id++, .name = plain.leaflets[l].name, .leaflet = l});
  }
  plain.triangle_scallop = plain.triangle_leaflet;
  const RegionMap before(*scalloped), map(*make_model(plain));
  REQUIRE(before.size() == 8);
  REQUIRE(map.size() == 4);
  const auto named = [](const RegionMap &of, uint32_t triangle) {
    std::string name;
    of.for_each(triangle, [&](uint32_t region) {
      if (region >= of.scallops()) name = of.name(region);
    });
    return name;
  };
  size_t found = 0;
  for (uint32_t t = 0; t < plain.triangles.size(); ++t) {
    const std::string name = named(before, t);
    if (name.empty()) continue;
    ++found;
    CHECK(named(map, t) == (name == "A1-P1" ? "A-P anterolateral" : "A-P posteromedial"));
  }
  CHECK(found > 20);
}

TEST_CASE("commissures_of_one_name_that_are_more_than_two_have_numbers") {
  // leaflets of two opposite quarters each: four places where they meet
  Valve valve = valve_of(disc(16 * mm, 4 * mm, [](double, double) { return 0; }));
  for (size_t t = 0; t < valve.triangles.size(); ++t) {
    const Tri &c = valve.triangles[t];
    const Vec3 middle = (valve.rest[c[0]] + valve.rest[c[1]] + valve.rest[c[2]]) / 3;
    valve.triangle_leaflet[t] = middle[0] * middle[1] > 0 ? 0 : 1;
  }
  const RegionMap map(*make_model(valve));
  REQUIRE(map.size() == 6);
  for (size_t k = 0; k < 4; ++k) CHECK(map.name(2 + k) == "A-P " + std::to_string(k + 1));
}

TEST_CASE("a_commissure_has_tissue_of_the_scallops_that_meet_there_alone") {
  // triangles of A away from the annulus are those of a scallop that meets no other leaflet there
  const auto whole = make_model(valve_of(disc(16 * mm, 4 * mm, [](double, double) { return 0; })));
  Valve tall = whole->valve;
  tall.scallops.push_back({.id = tall.next_id++, .name = "A2", .leaflet = 0});
  std::vector<uint8_t> at_annulus(tall.rest.size(), 0);
  for (const uint32_t node : tall.annulus) at_annulus[node] = 1;
  const auto added = static_cast<uint32_t>(tall.scallops.size() - 1);
  for (size_t t = 0; t < tall.triangles.size(); ++t) {
    const Tri &c = tall.triangles[t];
    const bool free = at_annulus[c[0]] + at_annulus[c[1]] + at_annulus[c[2]] == 0;
    if (free && tall.triangle_leaflet[t] == 0) tall.triangle_scallop[t] = added;
  }
  const RegionMap before(*whole), map(*make_model(tall));
  REQUIRE(map.size() == before.size() + 1);
  size_t left = 0, kept = 0;
  for (uint32_t t = 0; t < tall.triangles.size(); ++t) {
    bool was = false, is = false;
    before.for_each(t, [&](uint32_t region) { was = was || region >= before.scallops(); });
    map.for_each(t, [&](uint32_t region) { is = is || region >= map.scallops(); });
    CHECK(is == (was && tall.triangle_scallop[t] != added));
    left += was && !is;
    kept += is;
  }
  CHECK(left > 0);
  CHECK(kept > 0);
}

}  // namespace mvs::core::test
