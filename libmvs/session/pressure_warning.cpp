// Unit checks of pressures by their size and their digits.
#include <mvs/sim.h>

#include <cmath>

#include "base/chars.h"
#include "base/error.h"
#include "session/unit_warnings.h"

namespace mvs::core {
namespace {

// Whether a number has no more than this number of significant digits.
bool has_few_digits(double value, int most) {
  double rounded = 0;
  return double_from_chars(format("%.*g", most, value), rounded) &&
         std::abs(rounded - value) < 1e-12 * value;
}

}  // namespace

// Warns about pressures below 1.5 mmHg, which are systolic ones as numbers in MPa, kPa or mmHg
// (that of a hypertensive patient: a whole number up to 300), and about those above 100 kPa. A ramp
// begins with pressures as small, in longer fractions, which pass: a number in mmHg has at most
// five digits (122.3; the first of 100 steps to 120 mmHg is 159.9864 Pa), one in kPa at most eight
// (15.99864 is 120 mmHg). In MPa no ramp of less than 500,000 steps has one. Below 1e-3 Pa they are
// rounding errors of zero.
void log_pressure(const mvs_sim &sim, double pressure) {
  constexpr double mmhg = MVS_SYSTOLE_PA / 120, most = 100e3;
  constexpr double least = 1e-3, most_mpa = 0.03, most_kpa = 30, most_mmhg = 200,
                   most_whole_mmhg = 300;
  struct Unit {
    const char *name;
    double pa;
  };
  constexpr Unit in_mpa{"MPa", 1e6}, in_kpa{"kPa", 1e3}, in_mmhg{"mmHg", mmhg};
  const double size = std::abs(pressure);
  const bool is_small = size <= most_mmhg || (size <= most_whole_mmhg && size == std::floor(size));
  if (size >= least && is_small &&
      (size <= most_mpa || has_few_digits(size, size <= most_kpa ? 8 : 5))) {
    const Unit &unit = size <= most_mpa ? in_mpa : size <= most_kpa ? in_kpa : in_mmhg;
    sim.log(MVS_LOG_WARNING,
            "a pressure of %.8g Pa is %.2g mmHg: looks like %s given as Pa; %.8g %s are %.8g Pa",
            pressure, pressure / mmhg, unit.name, pressure, unit.name, pressure * unit.pa);
  } else if (size > most) {
    sim.log(MVS_LOG_WARNING,
            "a pressure of %g Pa is %.4g mmHg: looks like Pa taken for mmHg; pressures are in Pa",
            pressure, pressure / mmhg);
  }
}

}  // namespace mvs::core
