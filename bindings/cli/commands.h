// The commands of `mvs`: each adds itself to the command line and runs when it was chosen.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "console.h"

namespace cli {

void add_generate(CLI::App &app, Console &console);
void add_info(CLI::App &app, Console &console);
void add_op(CLI::App &app, Console &console);
void add_close(CLI::App &app, Console &console);
void add_measure(CLI::App &app, Console &console);
void add_compare(CLI::App &app, Console &console);
void add_convert(CLI::App &app, Console &console);
void add_plan(CLI::App &app, Console &console);
void add_remesh(CLI::App &app, Console &console);
void add_repair(CLI::App &app, Console &console);
void add_haptics(CLI::App &app, Console &console);

// A command with the options that all have: --json.
CLI::App *add_command(CLI::App &app, Console &console, const std::string &name,
                      const std::string &what);

// Accepts one of `names`; says which ones there are otherwise.
CLI::Validator one_of(const std::vector<std::string> &names);

}  // namespace cli
