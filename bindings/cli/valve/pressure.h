// Options with a pressure, all in mmHg, and the pressure under which a command closes a valve.
#pragma once

#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>

#include "commands/commands.h"
#include "text/console.h"

namespace cli {

// An error sentence for a pressure above the limit of the library, such as one given in Pa, or for
// no number; else "".
inline std::string wrong_pressure(const std::string &given) {
  constexpr double limit_mmhg = 3000;  // of mvs_set_load
  // strtod takes numbers out of range as infinite; the option has refused other words before
  const double pressure = std::strtod(given.c_str(), nullptr);
  if (std::isnan(pressure)) return given + " is no number: pressures are in mmHg, 120 in systole";
  if (std::abs(pressure) <= limit_mmhg) return "";
  return given + " mmHg is above 3000: pressures are in mmHg, 120 in systole";
}

// `help` is completed by the unit and the default.
inline CLI::Option *add_pressure_option(CLI::App &command, std::optional<double> &asked_mmhg,
                                        const char *option = "--pressure",
                                        const char *help = "transvalvular pressure") {
  return command
      .add_option(option, asked_mmhg,
                  std::string(help) + ", mmHg [that of the load in the file, else 120]")
      ->type_name("MMHG")
      ->check(CLI::Validator(CLI::Number).description(""))
      ->check(wrong_pressure, "");
}

// The given pressure, else that of the load in the file, else 120 mmHg. The load in the file
// matters: a tricuspid valve closes at a fifth of the mitral pressure.
inline double pressure_mmhg_of(const std::optional<double> &asked_mmhg, const mvs::Simulator &sim) {
  if (asked_mmhg) return *asked_mmhg;
  const double of_file = sim.load().pressure / pa_per_mmhg;
  return of_file != 0 ? of_file : 120;
}

}  // namespace cli
