// Under which pressure a command closes a valve.
#pragma once

#include <optional>

#include "commands.h"
#include "console.h"

namespace cli {

inline void add_pressure_option(CLI::App &command, std::optional<double> &asked_mmhg) {
  command
      .add_option(
          "--pressure", asked_mmhg,
          "transvalvular pressure, mmHg [that of the load in the file; 120 if there is none]")
      ->check(CLI::Number);
}

// What was asked for, else that of the load in the file, else systole: a tricuspid valve, say, is
// not to be closed under five times its pressure.
inline double pressure_mmhg_of(const std::optional<double> &asked_mmhg, const mvs::Sim &sim) {
  if (asked_mmhg) return *asked_mmhg;
  const double of_file = sim.load().pressure / pa_per_mmhg;
  return of_file != 0 ? of_file : 120;
}

}  // namespace cli
