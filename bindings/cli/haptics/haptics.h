// The subcommands of `mvs haptics`.
#pragma once

#include "commands/commands.h"

namespace cli {

void add_haptics_list(CLI::App &haptics, Console &console);
void add_haptics_doctor(CLI::App &haptics, Console &console);
void add_haptics_test(CLI::App &haptics, Console &console);
void add_haptics_record(CLI::App &haptics, Console &console);

}  // namespace cli
