// What the commands share on the command line.
#include "commands.h"

#include <algorithm>

namespace cli {

CLI::App *add_command(CLI::App &app, Console &console, const std::string &name,
                      const std::string &what) {
  CLI::App *command = app.add_subcommand(name, what);
  command->add_flag("--json", console.json, "print one JSON object on stdout and nothing else");
  return command;
}

CLI::Validator one_of(const std::vector<std::string> &names) {
  const std::string list = CLI::detail::join(names, ", ");
  return CLI::Validator(
      [names, list](const std::string &given) {
        const bool known = std::find(names.begin(), names.end(), given) != names.end();
        return known ? std::string() : "'" + given + "' is not known here; there is: " + list;
      },
      "{" + list + "}");
}

}  // namespace cli
