// Pieces of a surface that are not connected, and its size.
#include "patient/mesh/surface_pieces.h"

#include <doctest/doctest.h>

#include <cmath>

#include "base/error.h"
#include "patient/findings.h"
#include "patient/surface/boundary.h"
#include "patient/surface/clean_surface.h"
#include "tests/patient/cleaned.h"
#include "tests/patient/surfaces.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

// A strip of 40 by 6 mm in squares of 1 mm, cut in the middle, with its halves `gap` apart.
Surface cut_strip(double gap) {
  Surface s;
  for (const uint32_t half : {0u, 1u}) {
    const uint32_t first = static_cast<uint32_t>(s.x.size());
    for (uint32_t i = 0; i <= 20; ++i) {
      for (uint32_t j = 0; j <= 6; ++j) {
        s.x.push_back(Vec3(1e-3 * (i + 20 * half) + gap * half, 1e-3 * j, 0));
      }
    }
    for (uint32_t i = 0; i < 20; ++i) {
      for (uint32_t j = 0; j < 6; ++j) {
        const uint32_t a = first + 7 * i + j;
        s.triangles.push_back({a, a + 7, a + 8});
        s.triangles.push_back({a, a + 8, a + 1});
      }
    }
  }
  return s;
}

}  // namespace

TEST_CASE("clean_surface_joins_pieces_whose_rims_meet_within_a_tenth_of_an_edge") {
  Findings findings;
  const Surface near = cut_strip(0.03e-3);
  const LeafletSheet sheet = clean_surface(near.x, near.triangles, {}, {}, findings);
  CHECK(sheet.triangles.size() == near.triangles.size());
  CHECK(sheet.x.size() == near.x.size() - 7);
  const Finding *joined = find_finding(findings, "joined_pieces");
  REQUIRE(joined);
  CHECK(joined->value == std::vector<double>{7});
  CHECK(boundary_loops(sheet).size() == 1);
  // the sentence says how far apart the pieces are, and where
  CHECK_THROWS_WITH_AS(
      cleaned(cut_strip(0.4e-3)),
      doctest::Contains("2 pieces that are not connected, of 120, 120 mm2; the second "
                        "is nearest to the first at (20.0, 0.0, 0.0) mm, 0.40 mm"),
      Error);
}

TEST_CASE("the_size_of_a_surface_is_said_alike_however_it_is_turned") {
  std::string sentence;
  for (const double angle : {0.0, 0.4, 1.0}) {
    Surface s = cut_strip(0.0);
    for (Vec3 &x : s.x) {
      const double c = std::cos(angle), n = std::sin(angle);
      x = Vec3(c * x.x() - n * x.y(), n * c * x.x() + c * c * x.y() - n * x.z(),
               n * n * x.x() + c * n * x.y() + c * x.z());
    }
    Findings findings;
    clean_surface(s.x, s.triangles, {}, {}, findings);
    const Finding *found = find_finding(findings, "surface");
    REQUIRE(found);
    if (sentence.empty()) sentence = found->sentence;
    CHECK(found->sentence == sentence);
  }
  CHECK(sentence.find("40.4 mm across") != std::string::npos);  // sqrt(40^2 + 6^2)
}
