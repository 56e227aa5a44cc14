// The findings of a leak: what closures at rest give, and what the others must not give.
#include "patient/fit/leak_interval.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "patient/findings.h"
#include "patient/fit/leak_report.h"
#include "tests/patient/patient_valve.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

// Three closures, of which `closed` came to rest and the last diverged if `diverged`.
LeakInterval three_closures(uint32_t closed, bool diverged) {
  LeakInterval interval;
  interval.factor = {0.9, 1, 1.1};
  interval.leak = {0, 4e-6, diverged ? NAN : 9e-6};
  interval.closures = 3;
  interval.rests = closed;
  if (closed > 0) interval.least = 0, interval.most = 5e-6;
  return interval;
}

}  // namespace

TEST_CASE("a_closure_that_diverged_has_no_leak") {
  Findings findings;
  report_leaks(three_closures(2, true), {}, 0, findings);
  const Finding *leak = find_finding(findings, "leak");
  REQUIRE(leak != nullptr);
  CHECK(leak->value == std::vector<double>{0, 4e-6});
  CHECK(leak->sentence.find("(diverged)") != std::string::npos);
  const Finding *range = find_finding(findings, "leak_interval");
  REQUIRE(range != nullptr);
  CHECK(range->value == std::vector<double>{0, 5e-6});
  CHECK(range->sentence.find("1 of 3 closures did not come to rest") != std::string::npos);
  // a leak is less sure where not all closures are at rest
  Findings sure;
  report_leaks(three_closures(3, false), {}, 0, sure);
  CHECK(range->confidence < find_finding(sure, "leak_interval")->confidence);
}

// The interval of a valve with guessed heads was narrower than with given ones, and nothing said
// why.
TEST_CASE("landmarks_that_were_not_given_are_named_as_left_out_of_the_interval") {
  const auto said = [](FindingSource tips, FindingSource commissures) {
    Findings findings{{"papillary_tips", tips, 0.3, "", {}, "m"},
                      {"commissures", commissures, 0.5, "", {}, "m"}};
    report_leaks(three_closures(3, false), {}, 0, findings);
    return find_finding(findings, "leak_interval")->sentence + "\n" +
           find_finding(findings, "leak_limits")->sentence;
  };
  const std::string both = said(FindingSource::assumed, FindingSource::guessed);
  CHECK(both.find("errors of the papillary heads and commissures, which were not given") !=
        std::string::npos);
  CHECK(both.find("errors of the guessed papillary heads and commissures, are not in it: give") !=
        std::string::npos);
  const std::string heads = said(FindingSource::assumed, FindingSource::given);
  CHECK(heads.find("errors of the papillary heads, which") != std::string::npos);
  CHECK(heads.find("commissures") == std::string::npos);
  const std::string given = said(FindingSource::given, FindingSource::given);
  CHECK(given.find("errors of") == std::string::npos);
  CHECK(given.find("not given") == std::string::npos);
}

TEST_CASE("without_a_closure_at_rest_the_leak_is_not_determined") {
  Findings findings;
  report_leaks(three_closures(0, true), {}, 0, findings);
  const Finding *range = find_finding(findings, "leak_interval");
  REQUIRE(range != nullptr);
  CHECK(range->value.empty());
  CHECK(range->confidence == 0);
  CHECK(range->sentence.find("not determined: none of 3 closures") != std::string::npos);
}

TEST_CASE("closures_that_creep_count_where_only_the_valve_as_it_is_comes_to_rest") {
  LeakInterval interval = three_closures(1, false);
  interval.creeps = true;
  Findings findings;
  report_leaks(interval, {}, 0, findings);
  const Finding *range = find_finding(findings, "leak_interval");
  REQUIRE(range != nullptr);
  CHECK(range->value == std::vector<double>{0, 5e-6});
  CHECK(range->sentence.find("2 of 3 closures did not come to rest and count") !=
        std::string::npos);
  CHECK(range->sentence.find("each of these") == std::string::npos);
}

// Tissue of a hundredth of the stiffness of a leaflet's cannot carry the pressure: closures end at
// their last iteration, and what earlier fits leaked decides nothing.
TEST_CASE("leaks_of_a_fit_do_not_stand_for_closures_that_do_not_come_to_rest") {
  Valve valve = patient_valve(200);
  for (Leaflet &leaflet : valve.leaflets) {
    leaflet.law = LeafletLawId::neo_hookean;
    leaflet.constants = {{2e3}};
  }
  Findings findings;
  const LeakInterval interval = leak_interval(make_model(valve), {}, {4e-6}, findings);
  CHECK(interval.rests == 0);
  CHECK(interval.draws == 0);  // random lengths would not come to rest either
  for (const uint32_t iterations : interval.iterations) CHECK(iterations <= 400);
  CHECK_FALSE(interval.creeps);
  CHECK(std::isnan(interval.most));
  CHECK(find_finding(findings, "leak_interval")->value.empty());
}

// A search prefers a valve at rest to one that lies nearer to the surface and is not.
TEST_CASE("a_fit_that_is_not_at_rest_is_the_last_choice") {
  CHECK(loss_of(2e-3, true) < loss_of(0.5e-3, false));
  CHECK(loss_of(1e-3, true) < loss_of(2e-3, true));
  CHECK(loss_of(1e-3, false) < loss_of(2e-3, false));
}

TEST_CASE("a_valve_seals_if_no_closure_leaks_more_than_meshes_differ_by") {
  CHECK(all_seal({0, 0.4e-6}));
  CHECK(!all_seal({0, 0.6e-6}));
  CHECK(!all_seal({NAN, 0}));
}
