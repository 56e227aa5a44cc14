// `mvs`: generates, closes, operates on, measures and compares valves from the command line.
// Exit code 0: done; 1: failed, with the reason on stderr; 2: wrong usage.
#include <cstdio>
#include <exception>

#include "commands/commands.h"

namespace {

std::string version_text() {
  const uint32_t version = mvs_version();
  return cli::text("libmvs %u.%u.%u (%s)", version / 10000, version / 100 % 100, version % 100,
                   mvs_features());
}

void add_commands(CLI::App &app, cli::Console &console) {
  app.require_subcommand(1);
  app.set_version_flag("--version", version_text);
  app.footer(
      "Lengths are in mm, pressures in mmHg. A research simulator, not a medical device.\n"
      "Exit code 0: done; 1: failed or not at rest, with the reason on stderr; 2: wrong usage.");
  cli::add_generate(app, console);
  cli::add_import(app, console);
  cli::add_info(app, console);
  cli::add_chords(app, console);
  cli::add_leak(app, console);
  cli::add_cost(app, console);
  cli::add_op(app, console);
  cli::add_close(app, console);
  cli::add_measure(app, console);
  cli::add_compare(app, console);
  cli::add_convert(app, console);
  cli::add_plan(app, console);
  cli::add_remesh(app, console);
  cli::add_repair(app, console);
  cli::add_sensitivity(app, console);
  cli::add_sweep(app, console);
  cli::add_haptics(app, console);
}

int run_command(int argc, char **argv) {
  CLI::App app("Mitral valve repair, simulated for one patient.", "mvs");
  cli::Console console;
  add_commands(app, console);
  try {
    app.parse(argc, argv);
    return console.exit_code;
  } catch (const CLI::ParseError &error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const mvs::Error &failure) {
    cli::print_failure(console, failure);
    return 1;
  }
}

}  // namespace

int main(int argc, char **argv) {
  try {
    return run_command(argc, argv);
  } catch (const std::exception &error) {
    std::fprintf(stderr, "mvs: %s\n", error.what());
    return 1;
  }
}
