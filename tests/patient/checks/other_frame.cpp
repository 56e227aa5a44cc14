// Annulus points of the other frame of LPS and RAS, near the origin, where they lie near the rim.
#include <doctest/doctest.h>

#include "patient/doubtful.h"
#include "patient/surface/mirrored.h"
#include "patient/surface/rims.h"
#include "tests/patient/cleaned.h"
#include "tests/patient/parametric_sheet.h"

using namespace mvs::core;
using namespace mvs::core::test;

TEST_CASE("annulus_points_that_fit_the_rim_only_if_they_are_mirrored_are_doubted") {
  const ParametricSheet p = parametric_sheet(430);
  const Surface s = surface_of(p.sheet);
  RimLandmarks right, turned;
  for (const uint32_t i : p.rims.annulus) right.annulus.push_back(s.x[i]);
  turned.annulus = mirrored(right.annulus);
  Findings found, doubted;
  rims_of(s, right, found);
  CHECK(find(found, "annulus")->confidence > 0.9);
  CHECK_FALSE(is_doubtful(*find(found, "annulus")));
  rims_of(s, turned, doubted);
  const Finding &annulus = *find(doubted, "annulus");
  CHECK(is_doubtful(annulus));
  CHECK(annulus.sentence.find("With x and y mirrored they lie") != std::string::npos);
}

TEST_CASE("the_atrium_is_no_surer_than_the_annulus_that_it_follows_from") {
  const ParametricSheet p = parametric_sheet(430);
  Findings found;
  rims_of(surface_of(p.sheet), {}, found);
  CHECK(find(found, "annulus")->confidence < 1);
  CHECK(find(found, "atrium")->confidence <= find(found, "annulus")->confidence);
}
