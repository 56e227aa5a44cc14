// Given errors, and a guess from filled notches.
#include "patient/fit/edge_range.h"

#include "base/error.h"
#include "patient/findings.h"

namespace mvs::core {
namespace {

constexpr double exact_edge = 10e-6;  // m: a free edge with a smaller error is exact
// Share of the mean depth of filled notches that counts as uncertain: notches are filled to the
// straight line over their mouth, so tissue missing beyond that line or in a wide dip is not
// detected.
constexpr double lost_share = 0.5;

}  // namespace

EdgeRange find_edge_range(double error, double known_lost, const PatientGeometry &g,
                          Findings &findings) {
  const Finding *notches = find_finding(findings, "free_edge");
  const bool given = known_lost > 0;
  const double lost = given ? known_lost : (notches ? lost_share * notches->value[2] : 0);
  if (error > 0) {
    findings.push_back({"edge_error",
                        FindingSource::given,
                        1,
                        format("the free edge may lie %.2f mm farther out or in, as given; the "
                               "interval of leaks allows for it",
                               error * 1e3),
                        {error},
                        "m"});
  }
  if (lost > 0) {
    findings.push_back(
        {"edge_lost",
         given ? FindingSource::given : FindingSource::guessed,
         given ? 1 : 0.4,
         format("up to %.2f mm of tissue may be missing at the free edge, %s; the "
                "interval of leaks allows for it",
                lost * 1e3, given ? "as given" : "half of the mean depth of its filled notches"),
         {lost},
         "m"});
  }
  const double out = error + lost;
  return out < exact_edge ? EdgeRange{} : EdgeRange{out, error, &g};
}

}  // namespace mvs::core
