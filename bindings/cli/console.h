// How the command talks: one JSON object or text on stdout, progress and warnings on stderr.
#pragma once

#include <csignal>
#include <nlohmann/json.hpp>
#include <string>

#include "host.h"

namespace cli {

using Json = nlohmann::ordered_json;

inline constexpr double pa_per_mmhg = 133.322;

struct Console {
  bool json = false;      // --json: stdout holds one object and nothing else
  bool progress = false;  // --progress: show it although stderr is no terminal
  int exit_code = 0;      // of a command that did its work and found something wrong
};

// printf into a string.
[[gnu::format(printf, 1, 2)]] std::string text(const char *pattern, ...);

// Prints the result of a command, the last thing it does: the object with --json, else the text.
void print(const Console &console, const Json &object, const std::string &human);

// Tells a failure: the sentence on stderr, and with --json {"error": {...}} on stdout.
void print_failure(const Console &console, const mvs::Error &failure);

// Shows how far long work is on one line of stderr, and ends it when the user presses Ctrl-C.
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

  bool shown_;
  bool terminal_;
  bool line_open_ = false;
  double last_s_ = -1;
  void (*old_handler_)(int);
};

// A simulator that holds the valve of a file and tells `progress`, which has to outlive it. `desc`
// may set all but the log and the progress.
mvs::Sim load_sim(const std::string &path, Progress &progress, mvs_sim_desc desc = {});

}  // namespace cli
