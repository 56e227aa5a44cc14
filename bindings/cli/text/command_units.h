// Sentences of the library in the units of the command.
#pragma once

#include <mvs/mvs.hpp>
#include <string>

#include "valve/host.h"

namespace cli {

// A sentence of the library, in m and Pa, about values that the command took in mm, MPa and mmHg.
// Lengths become mm; hints to other units become hints to those of the command.
std::string in_command_units(const std::string &sentence);

// While one exists, log_to_stderr prints sentences in the units of the command.
class CommandUnits {
 public:
  CommandUnits();
  ~CommandUnits();
  CommandUnits(const CommandUnits &) = delete;
  CommandUnits &operator=(const CommandUnits &) = delete;
  static bool apply();
};

// Does work with values of the command line; warnings and errors are in their units. Not for files
// of valves and plans, whose units are those of the library.
template <typename Work>
auto with_command_units(Work &&work) {
  const CommandUnits units;
  try {
    return work();
  } catch (const mvs::Error &error) {
    fail(error.code(), error.part(), in_command_units(error.what()), error.line());
  }
}

}  // namespace cli
