// Findings that say that an input is wrong.
#include "patient/doubtful.h"

#include <doctest/doctest.h>

using namespace mvs::core;

namespace {

bool doubtful(const char *name, FindingSource source, double confidence) {
  return is_doubtful({name, source, confidence, "", {}, ""});
}

}  // namespace

TEST_CASE("given_landmarks_are_doubtful_sooner_than_guessed_ones") {
  for (const char *name : {"annulus", "commissures", "anterior"}) {
    CHECK(doubtful(name, FindingSource::given, 0.5));
    CHECK_FALSE(doubtful(name, FindingSource::given, 0.51));
    CHECK(doubtful(name, FindingSource::guessed, 0.1));
    CHECK_FALSE(doubtful(name, FindingSource::guessed, 0.11));
  }
}

TEST_CASE("findings_of_faults_are_doubtful_and_assumptions_are_not") {
  CHECK(doubtful("tall_leaflets", FindingSource::measured, 1));
  CHECK(doubtful("closed_fit", FindingSource::measured, 0.33));
  CHECK_FALSE(doubtful("closed_fit", FindingSource::measured, 0.34));
  CHECK_FALSE(doubtful("thickness", FindingSource::assumed, 0));
}
