// Under which pressure a command closes a valve.
#pragma once

#include <cmath>
#include <optional>
#include <string>

#include "commands.h"
#include "console.h"

namespace cli {

// A sentence for a pressure that is none in mmHg, as one in Pa is; "" for any other.
inline std::string wrong_pressure(const std::string &given) {
  constexpr double most_mmhg = 3000;  // what mvs_set_load takes
  if (std::abs(std::stod(given)) <= most_mmhg) return "";
  return given + " mmHg is over 3000: pressures are in mmHg here, 120 in systole";
}

inline void add_pressure_option(CLI::App &command, std::optional<double> &asked_mmhg) {
  command
      .add_option(
          "--pressure", asked_mmhg,
          "transvalvular pressure, mmHg [that of the load in the file; 120 if there is none]")
      ->check(CLI::Number)
      ->check(wrong_pressure, "");
}

// What was asked for, else that of the load in the file, else systole: a tricuspid valve, say, is
// not to be closed under five times its pressure.
inline double pressure_mmhg_of(const std::optional<double> &asked_mmhg, const mvs::Sim &sim) {
  if (asked_mmhg) return *asked_mmhg;
  const double of_file = sim.load().pressure / pa_per_mmhg;
  return of_file != 0 ? of_file : 120;
}

}  // namespace cli
