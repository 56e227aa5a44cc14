// A process that dies of a signal sets the forces of its devices to zero, and still dies of it.
#include "haptics/signal_handler.h"

#include <doctest/doctest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <string>

#include "haptics/device.h"

using namespace mvs::core;

namespace {

struct End {
  int status;
  std::string told;  // written by the driver's panic on file 9
};

// Runs a child that starts a device and raises a signal, twice if the host survives it.
End die_of(int signal, bool with_handler, bool stopped, void (*host)(int) = SIG_DFL) {
  int ends[2];
  REQUIRE_EQ(pipe(ends), 0);
  const pid_t child = fork();
  if (child == 0) {
    dup2(ends[1], 9);
    // doctest's own signal handlers would hide the ones under test
    for (const int s : {SIGSEGV, SIGABRT, SIGTERM, SIGFPE})
      ::signal(s, s == signal ? host : SIG_DFL);
    const std::string path = std::string(MVS_LIARS_DIR) + "/panics.so";
    mvs_device_desc desc = {};
    desc.struct_size = sizeof desc;
    desc.clock = MVS_CLOCK_VIRTUAL;
    desc.driver = path.c_str();
    Device device(desc, {});
    device.start();
    if (with_handler) install_signal_handler(true);
    if (stopped) device.stop();
    raise(signal);
    raise(signal);
    _exit(0);
  }
  close(ends[1]);
  End end = {};
  char text[16];
  for (ssize_t n = 0; (n = read(ends[0], text, sizeof text)) > 0;) end.told.append(text, size_t(n));
  close(ends[0]);
  REQUIRE_EQ(waitpid(child, &end.status, 0), child);
  return end;
}

}  // namespace

TEST_CASE("a fatal signal sets forces to zero, then ends the process as it would have") {
  for (const int signal : {SIGSEGV, SIGABRT, SIGTERM, SIGFPE}) {
    CAPTURE(signal);
    const End end = die_of(signal, true, false);
    CHECK_EQ(end.told, "zero");
    CHECK(WIFSIGNALED(end.status));
    CHECK_EQ(WTERMSIG(end.status), signal);
  }
}

TEST_CASE("unless it is requested, or after a device was stopped, panic is not called") {
  CHECK_EQ(die_of(SIGSEGV, false, false).told, "");
  CHECK_EQ(die_of(SIGSEGV, true, true).told, "");
}

TEST_CASE("each_signal_that_the_host_survives_sets_forces_to_zero") {
  CHECK_EQ(die_of(SIGTERM, true, false, [](int) {}).told, "zerozero");
}

TEST_CASE("the signal handler restores the previous handlers") {
  struct sigaction before = {}, now = {};
  REQUIRE_EQ(sigaction(SIGBUS, nullptr, &before), 0);
  install_signal_handler(true);
  install_signal_handler(true);
  REQUIRE_EQ(sigaction(SIGBUS, nullptr, &now), 0);
  const bool taken = now.sa_handler != before.sa_handler;
  CHECK(taken);
  install_signal_handler(false);
  REQUIRE_EQ(sigaction(SIGBUS, nullptr, &now), 0);
  const bool given_back = now.sa_handler == before.sa_handler;
  CHECK(given_back);
}
