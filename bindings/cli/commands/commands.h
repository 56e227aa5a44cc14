// The subcommands of `mvs`, and the options that several of them share.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "text/console.h"

namespace cli {

// Each adds its subcommand to the parser; the parser's callback runs it.
void add_generate(CLI::App &app, Console &console);
void add_import(CLI::App &app, Console &console);
void add_info(CLI::App &app, Console &console);
void add_chords(CLI::App &app, Console &console);
void add_cost(CLI::App &app, Console &console);
void add_leak(CLI::App &app, Console &console);
void add_op(CLI::App &app, Console &console);
void add_close(CLI::App &app, Console &console);
void add_measure(CLI::App &app, Console &console);
void add_compare(CLI::App &app, Console &console);
void add_convert(CLI::App &app, Console &console);
void add_plan(CLI::App &app, Console &console);
void add_remesh(CLI::App &app, Console &console);
void add_repair(CLI::App &app, Console &console);
void add_sensitivity(CLI::App &app, Console &console);
void add_sweep(CLI::App &app, Console &console);
void add_haptics(CLI::App &app, Console &console);

// A subcommand with the option of all subcommands, --json.
CLI::App *add_command(CLI::App &app, Console &console, const std::string &name,
                      const std::string &help);

// The same with a struct of options; the parser calls `run(options, console)`. The pointer is valid
// as long as the subcommand.
template <typename Options, typename Run>
std::pair<CLI::App *, Options *> add_command(CLI::App &app, Console &console,
                                             const std::string &name, const std::string &help,
                                             Run run) {
  auto options = std::make_shared<Options>();
  CLI::App *command = add_command(app, console, name, help);
  command->callback([options, run, &console] { run(*options, console); });
  return {command, options.get()};
}

// --progress
void add_progress_flag(CLI::App &command, Console &console);

// --workers, by default of commands that close one valve.
void add_workers_option(CLI::App &command, Console &console,
                        const char *help =
                            "threads that share the closure of a valve of more than about 1,000 "
                            "vertices; the result is the same for any number [1]");

// Accepts one of `names`; the error message lists them.
CLI::Validator one_of(const std::vector<std::string> &names);

// Accepts a finite number above 0.
CLI::Validator positive();

// A number from one to another one, in a unit that the sentence names.
CLI::Validator between(double least, double most, const std::string &unit = "");

}  // namespace cli
