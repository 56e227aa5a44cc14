#include "text/console.h"

#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <string_view>

namespace cli {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void on_interrupt(int) {
  interrupted = 1;
}

double now_s() {
  using Clock = std::chrono::steady_clock;
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

// Names in files may hold any bytes; JSON must be UTF-8.
std::string dump(const Json &object) {
  return object.dump(2, ' ', false, Json::error_handler_t::replace);
}

// Throws if the disk is full or the pipe is closed.
void write_out(const std::string &line) {
  std::fputs(line.c_str(), stdout);
  std::fputc('\n', stdout);
  if (std::fflush(stdout) != 0) throw std::runtime_error("could not write to standard output");
}

// The progress callback of the command cancels the work on Ctrl-C alone.
std::string sentence_of(const mvs::Error &failure) {
  constexpr std::string_view of_library = "cancelled by the progress callback";
  std::string sentence = failure.what();
  const size_t at = sentence.find(of_library);
  if (failure.code() == MVS_E_CANCELLED && at != std::string::npos) {
    sentence.replace(at, of_library.size(), "stopped by Ctrl-C");
  }
  return sentence;
}

}  // namespace

std::string text(const char *pattern, ...) {
  va_list arguments, again;
  va_start(arguments, pattern);
  va_copy(again, arguments);
  std::string out(static_cast<size_t>(std::vsnprintf(nullptr, 0, pattern, arguments)), ' ');
  std::vsnprintf(out.data(), out.size() + 1, pattern, again);
  va_end(again);
  va_end(arguments);
  return out;
}

Json number_json(double value, double scale) {
  return std::isfinite(value) ? Json(value * scale) : Json();
}

void print(const Console &console, const Json &object, const std::string &human) {
  write_out(console.json ? dump(object) : human);
}

void print_error_object(const Console &console, const mvs::Error &failure) {
  if (!console.json) return;
  write_out(dump({{"error",
                   {{"code", mvs_result_name(failure.code())},
                    {"message", sentence_of(failure)},
                    {"part", failure.part()},
                    {"line", failure.line()}}}}));
}

void print_failure(const Console &console, const mvs::Error &failure) {
  std::fprintf(stderr, "mvs: %s\n", sentence_of(failure).c_str());
  print_error_object(console, failure);
}

InterruptFlag::InterruptFlag() : old_handler_(std::signal(SIGINT, on_interrupt)) {
  interrupted = 0;
}

InterruptFlag::~InterruptFlag() {
  std::signal(SIGINT, old_handler_);
}

bool InterruptFlag::is_set() {
  return interrupted != 0;
}

Progress::Progress(const Console &console)
    : shown_(console.progress || isatty(STDERR_FILENO)), terminal_(isatty(STDERR_FILENO)) {}

Progress::~Progress() {
  if (line_open_) std::fputc('\n', stderr);
}

int32_t Progress::callback(void *user, double share, double residual) {
  static_cast<Progress *>(user)->show(share, residual);
  return InterruptFlag::is_set();
}

void Progress::show(double share, double residual) {
  if (!shown_) return;
  // at most ten lines per second
  const double now = now_s();
  if (now - last_s_ < 0.1) return;
  last_s_ = now;
  std::fprintf(stderr, "%s%3.0f %%, largest out-of-balance force %.2e N%s", terminal_ ? "\r" : "",
               100 * share, residual, terminal_ ? "" : "\n");
  std::fflush(stderr);
  line_open_ = terminal_;
}

mvs_sim_desc with_workers(const Console &console) {
  mvs_sim_desc desc = {};
  desc.workers = console.workers;
  return desc;
}

mvs::Simulator load_sim(const std::string &path, Progress &progress, mvs_sim_desc desc) {
  desc.progress = Progress::callback;
  desc.user = &progress;
  mvs::Simulator sim = make_sim(desc);
  sim.load_file(path);
  return sim;
}

}  // namespace cli
