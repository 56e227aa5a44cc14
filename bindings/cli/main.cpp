// `mvs`: generates, closes, operates on, measures and compares valves from the command line.
// Exit code 0: done; 1: failed, with the reason on stderr; 2: wrong usage, a word, option or value
// of the command line is refused.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <string_view>

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
      "Exit code 0: done; 1: failed or not at rest, with the reason on stderr; 2: wrong usage.\n"
      "With --json a failure prints {\"error\": {code, message, part, line}} on stdout as well.");
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

// The parser sets flags after it has accepted the whole line.
bool asks_for_json(int argc, char **argv) {
  return std::any_of(argv, argv + argc, [](std::string_view word) { return word == "--json"; });
}

int run_command(int argc, char **argv) {
  CLI::App app("Mitral valve repair, simulated for one patient.", "mvs");
  cli::Console console;
  add_commands(app, console);
  try {
    app.parse(argc, argv);
    return console.exit_code;
  } catch (const CLI::ParseError &error) {
    if (app.exit(error) == 0) return 0;
    console.json = asks_for_json(argc, argv);
    cli::print_error_object(console, cli::error_of(MVS_E_ARGUMENT, "command line", error.what()));
    return 2;
  } catch (const mvs::Error &failure) {
    cli::print_failure(console, failure);
    return failure.code() == MVS_E_ARGUMENT ? 2 : 1;
  } catch (const std::bad_alloc &) {
    cli::print_failure(console, cli::error_of(MVS_E_MEMORY, "",
                                              "out of memory: free some, or use a coarser valve"));
    return 1;
  } catch (const std::exception &error) {
    cli::print_failure(console, cli::error_of(MVS_E_INTERNAL, "", error.what()));
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
