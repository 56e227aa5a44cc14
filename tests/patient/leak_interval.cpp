// The findings of a leak: what closures at rest give, and what the others must not give.
#include "patient/fit/leak_interval.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "patient/doubtful.h"
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

// A valve of neo-Hookean leaflets; mu: Pa.
Valve soft_valve(double mu) {
  Valve valve = patient_valve(200);
  for (Leaflet &leaflet : valve.leaflets) {
    leaflet.law = LeafletLawId::neo_hookean;
    leaflet.constants = {{mu}};
  }
  return valve;
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

// Of 13 closures, one came to rest, and the interval was said as sure as if all had.
TEST_CASE("an_interval_of_few_closures_at_rest_is_doubted_and_less_sure") {
  LeakInterval interval = three_closures(3, false);
  interval.closures = 13;
  const auto said = [&](uint32_t rests) {
    interval.rests = rests;
    Findings findings;
    report_leaks(interval, {}, 0, findings);
    return findings;
  };
  const Findings few = said(1), most = said(12), all = said(13);
  const Finding *doubt = find_finding(few, "leak_at_rest");
  REQUIRE(doubt != nullptr);
  CHECK(is_doubtful(*doubt));
  CHECK(doubt->sentence.find("1 of 13 closures") == 0);
  CHECK(find_finding(most, "leak_at_rest") == nullptr);
  CHECK(find_finding(few, "leak_interval")->confidence < 0.05);
  CHECK(find_finding(few, "leak")->confidence < 0.05);
  CHECK(find_finding(most, "leak_interval")->confidence <
        find_finding(all, "leak_interval")->confidence);
  // an interval of no more than half of them that is not known
  interval.least = interval.most = NAN;
  const Findings unknown = said(3);
  CHECK(find_finding(unknown, "leak_interval")->value.empty());
  CHECK(find_finding(unknown, "leak_interval")
            ->sentence.find("not determined: only 3 of 13 closures") == 0);
}

TEST_CASE("an_interval_is_no_surer_than_the_fit_to_the_closed_surface") {
  Findings findings{{"closed_fit", FindingSource::measured, 0.1, "", {}, "m"}};
  report_leaks(three_closures(3, false), {}, 0, findings);
  CHECK(find_finding(findings, "leak_interval")->confidence == 0.1);
  CHECK(find_finding(findings, "leak")->confidence == 0.1);
}

// "0.0 to 131.4 mm2 ...: each of these closures leaks less than 0.5 mm2".
TEST_CASE("an_interval_says_where_each_of_its_ends_comes_from") {
  LeakInterval interval = three_closures(3, false);
  interval.of_closures = {0, 0.5e-6};
  interval.with_shape = {0, 1.2e-6};
  interval.shape.distance = 1e-3;
  interval.shown = {21.8e-6, 131.4e-6};
  interval.least = 0, interval.most = 131.4e-6;
  const auto said = [&] {
    Findings findings;
    report_leaks(interval, {}, 0, findings);
    return find_finding(findings, "leak_interval")->sentence;
  };
  const auto has = [](const std::string &text, const char *words) {
    return text.find(words) != std::string::npos;
  };
  const std::string upper = said();
  CHECK(upper.find("0.0 to 131.4 mm2; by closures alone 0.0 to 0.5 mm2 for") == 0);
  CHECK(has(upper, "each of these closures leaks less than 0.5 mm2"));
  CHECK(has(upper, "this widens the interval to 0.0 to 1.2 mm2"));
  CHECK(has(upper, "has gaps of 21.8 to 131.4 mm2: the upper end of the interval is theirs"));
  interval.of_closures = interval.with_shape = {40e-6, 60e-6};
  interval.shown = {21.8e-6, 30e-6};
  interval.least = 21.8e-6, interval.most = 60e-6;
  const std::string lower = said();
  CHECK(has(lower, "the lower end of the interval is theirs"));
  CHECK(!has(lower, "this widens"));
  interval.shown = {}, interval.shape = {};
  interval.least = 40e-6;
  const std::string alone = said();
  CHECK(alone.find("40.0 to 60.0 mm2 for lengths") == 0);
  CHECK(!has(alone, "theirs"));
}

// Tissue of a hundredth of the stiffness of a leaflet's cannot carry the pressure: closures end at
// their last iteration, and what earlier fits leaked decides nothing.
TEST_CASE("leaks_of_a_fit_do_not_stand_for_closures_that_do_not_come_to_rest") {
  Findings findings;
  const LeakInterval interval = leak_interval(make_model(soft_valve(2e3)), {}, {4e-6}, findings);
  CHECK(interval.rests == 0);
  CHECK(interval.draws == 0);  // random lengths would not come to rest either
  for (const uint32_t iterations : interval.iterations) CHECK(iterations <= 400);
  CHECK_FALSE(interval.creeps);
  CHECK(std::isnan(interval.most));
  CHECK(find_finding(findings, "leak_interval")->value.empty());
}

// Of the closures of a soft valve only that with thicker leaflets comes to rest; those at rest made
// an interval of 0.0 to 0.5 mm2, though the valve as it is has no shape.
TEST_CASE("a_valve_that_does_not_come_to_rest_has_no_interval_by_others_that_do") {
  LeakUnknowns unknowns;
  unknowns.thickness_error = 0.3e-3;
  Findings findings;
  const LeakInterval interval = leak_interval(make_model(soft_valve(50e3)), unknowns, {}, findings);
  CHECK(interval.rests == 1);
  CHECK(interval.closures == 5);
  CHECK(interval.draws == 0);
  CHECK(std::isnan(interval.most));
  CHECK(find_finding(findings, "leak_interval")->value.empty());
  CHECK(is_doubtful(*find_finding(findings, "leak_at_rest")));
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
