#include "commands/commands.h"

#include <algorithm>
#include <cmath>

namespace cli {

CLI::App *add_command(CLI::App &app, Console &console, const std::string &name,
                      const std::string &help) {
  CLI::App *command = app.add_subcommand(name, help);
  command->add_flag("--json", console.json, "print one JSON object on stdout and nothing else");
  return command;
}

void add_progress_flag(CLI::App &command, Console &console) {
  command.add_flag("--progress", console.progress,
                   "show progress on stderr even if stderr is not a terminal");
}

void add_workers_option(CLI::App &command, Console &console, const char *help) {
  command.add_option("--workers", console.workers, help)->check(CLI::Range(1, MVS_MAX_WORKERS));
}

CLI::Validator one_of(const std::vector<std::string> &names) {
  const std::string list = CLI::detail::join(names, ", ");
  return CLI::Validator(
      [names, list](const std::string &given) {
        const bool known = std::find(names.begin(), names.end(), given) != names.end();
        return known ? std::string() : "'" + given + "' is unknown; choose from: " + list;
      },
      "{" + list + "}");
}

CLI::Validator positive() {
  return CLI::Validator(
      [](const std::string &given) {
        double value = 0;
        const bool good = CLI::detail::lexical_cast(given, value) && value > 0 && value < HUGE_VAL;
        return good ? std::string() : "a number above 0 is needed, not " + given;
      },
      "POSITIVE");
}

CLI::Validator between(double least, double most, const std::string &unit) {
  const std::string range =
      text("%g to %g", least, most) + (unit.empty() ? std::string() : " " + unit);
  return CLI::Validator(
      [least, most, range](const std::string &given) {
        double value = 0;
        const bool good =
            CLI::detail::lexical_cast(given, value) && value >= least && value <= most;
        return good ? std::string() : "a number from " + range + " is needed, not " + given;
      },
      "{" + range + "}");
}

}  // namespace cli
