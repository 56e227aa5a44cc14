// Output of the command: one JSON object or text on stdout; progress, warnings and errors on
// stderr.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "valve/host.h"

namespace cli {

using Json = nlohmann::ordered_json;

inline constexpr double pa_per_mmhg = 133.322;

struct Console {
  bool json = false;      // --json: stdout holds one object and nothing else
  bool progress = false;  // --progress: show progress even if stderr is not a terminal
  uint32_t workers = 0;   // --workers: threads that share a closure
  int exit_code = 0;      // of a command that ran and found a fault
};

// printf into a string.
[[gnu::format(printf, 1, 2)]] std::string text(const char *pattern, ...);

// A number times `scale`; null if it is not finite.
Json number_json(double value, double scale = 1);

// Prints the result of a command: the object with --json, else the text.
void print(const Console &console, const Json &object, const std::string &human);

// With --json, prints {"error": {...}} on stdout.
void print_error_object(const Console &console, const mvs::Error &failure);

// The same, and the sentence on stderr.
void print_failure(const Console &console, const mvs::Error &failure);

// Records Ctrl-C while it exists instead of ending the process; then restores the old handler.
class InterruptFlag {
 public:
  InterruptFlag();
  ~InterruptFlag();
  InterruptFlag(const InterruptFlag &) = delete;
  InterruptFlag &operator=(const InterruptFlag &) = delete;

  static bool is_set();

 private:
  void (*old_handler_)(int);
};

// Shows the progress of long work on one line of stderr, and cancels the work on Ctrl-C.
class Progress {
 public:
  explicit Progress(const Console &console);
  ~Progress();
  Progress(const Progress &) = delete;
  Progress &operator=(const Progress &) = delete;

  // For mvs_sim_desc: `user` is the Progress.
  static int32_t callback(void *user, double share, double residual);

 private:
  void show(double share, double residual);

  InterruptFlag interrupt_;
  bool shown_;
  bool terminal_;
  bool line_open_ = false;
  double last_s_ = -1;
};

// A simulator that holds the valve of a file and reports to `progress`, which must outlive it.
// `desc` may set all fields except log and progress.
mvs::Simulator load_sim(const std::string &path, Progress &progress, mvs_sim_desc desc = {});

// The description of a simulator with the workers that the user asked for.
mvs_sim_desc with_workers(const Console &console);

}  // namespace cli
