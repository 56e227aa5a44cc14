// The option --pressure, and the pressure under which a command closes a valve.
#pragma once

#include <cmath>
#include <optional>
#include <string>

#include "commands/commands.h"
#include "text/console.h"

namespace cli {

// An error sentence for a pressure above the limit of the library, such as one given in Pa; else
// "".
inline std::string wrong_pressure(const std::string &given) {
  constexpr double limit_mmhg = 3000;  // of mvs_set_load
  if (std::abs(std::stod(given)) <= limit_mmhg) return "";
  return given + " mmHg is above 3000: pressures are in mmHg, 120 in systole";
}

inline void add_pressure_option(CLI::App &command, std::optional<double> &asked_mmhg) {
  command
      .add_option("--pressure", asked_mmhg,
                  "transvalvular pressure, mmHg [that of the load in the file, else 120]")
      ->check(CLI::Number)
      ->check(wrong_pressure, "");
}

// The given pressure, else that of the load in the file, else 120 mmHg. The load in the file
// matters: a tricuspid valve closes at a fifth of the mitral pressure.
inline double pressure_mmhg_of(const std::optional<double> &asked_mmhg, const mvs::Sim &sim) {
  if (asked_mmhg) return *asked_mmhg;
  const double of_file = sim.load().pressure / pa_per_mmhg;
  return of_file != 0 ? of_file : 120;
}

}  // namespace cli
