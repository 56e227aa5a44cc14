/* The handler of fatal signals passes each signal on to the host's handler as the system would have
 * delivered it, and leaves the handlers that the host installs later. */
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/api/check.h"

static volatile sig_atomic_t calls, newer_calls;
static void (*before_newer)(int);

static void old_handler(int signal) {
  (void)signal;
  ++calls;
}

/* Calls the handler before it, as hosts do that watch signals beside others. */
static void newer_handler(int signal) {
  ++newer_calls;
  if (before_newer) before_newer(signal);
}

static void (*handler_of(int number))(int) {
  struct sigaction now;
  sigaction(number, NULL, &now);
  return now.sa_handler;
}

/* Writes to the stack below the caller: the C library copies bytes of a mask from there that the
 * system did not write. */
static void dirty_stack(int value) {
  volatile char room[1 << 14];
  for (size_t k = 0; k < sizeof room; ++k) room[k] = (char)value;
}

/* As signal() does where it is not of System V. */
static void set_handler(int number, void (*handler)(int)) {
  struct sigaction action;
  memset(&action, 0, sizeof action);
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigaction(number, &action, NULL);
}

/* Runs a case in a process of its own; returns its status, as waitpid does. */
static int status_of(void (*run)(void)) {
  int status = -1;
  fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    run();
    fflush(stdout);
    _exit(failures != 0);
  }
  return waitpid(child, &status, 0) == child ? status : -1;
}

static void survive_two(void) {
  set_handler(SIGTERM, old_handler);
  MUST(mvs_device_handle_signals(1));
  raise(SIGTERM);
  CHECK(handler_of(SIGTERM) != old_handler && handler_of(SIGTERM) != SIG_DFL);
  raise(SIGTERM);
  CHECK(calls == 2);
  MUST(mvs_device_handle_signals(0));
  CHECK(handler_of(SIGTERM) == old_handler);
}

static void keep_a_newer_one(void) {
  set_handler(SIGTERM, old_handler);
  MUST(mvs_device_handle_signals(1));
  before_newer = handler_of(SIGTERM);
  set_handler(SIGTERM, newer_handler);
  MUST(mvs_device_handle_signals(0));
  CHECK(handler_of(SIGTERM) == newer_handler);
  raise(SIGTERM);
  CHECK(newer_calls == 1 && calls == 1);
}

static void install_over_a_newer_one(void) {
  set_handler(SIGTERM, old_handler);
  MUST(mvs_device_handle_signals(1));
  before_newer = handler_of(SIGTERM);
  set_handler(SIGTERM, newer_handler);
  MUST(mvs_device_handle_signals(1));
  CHECK(handler_of(SIGTERM) != newer_handler);
  raise(SIGTERM);
  CHECK(newer_calls == 1 && calls == 1);
  MUST(mvs_device_handle_signals(1));
  MUST(mvs_device_handle_signals(0));
  CHECK(handler_of(SIGTERM) == newer_handler);
  for (int k = 0; k < 100; ++k) {
    dirty_stack(2 * k);
    MUST(mvs_device_handle_signals(1));
    dirty_stack(2 * k + 1);
    MUST(mvs_device_handle_signals(0));
  }
  raise(SIGTERM);
  CHECK(newer_calls == 2 && calls == 2);
}

/* Exits with 0 if it gets the fault of `touch_nothing` itself. */
static void crash_handler(int signal, siginfo_t *info, void *context) {
  _exit(signal == SIGSEGV && info->si_code == SEGV_MAPERR && info->si_addr == (void *)0x1234 &&
                context
            ? 0
            : 3);
}

static void take_crashes(int flags) {
  struct sigaction action;
  memset(&action, 0, sizeof action);
  action.sa_sigaction = crash_handler;
  action.sa_flags = SA_SIGINFO | flags;
  sigaction(SIGSEGV, &action, NULL);
}

static void touch_nothing(void) {
  take_crashes(0);
  MUST(mvs_device_handle_signals(1));
  /* its address is hidden from the compiler */
  int *volatile nowhere = (int *)0x1234;
  *nowhere = 1;
}

static void exit_well(int signal, siginfo_t *info, void *context) {
  (void)info;
  (void)context;
  _exit(signal == SIGSEGV ? 0 : 3);
}

static volatile int sink, deepest = 1 << 30;
static int deep(int depth) {
  volatile char room[4096];
  room[0] = (char)depth;
  sink += room[0];
  return depth > deepest ? 0 : deep(depth + 1) + room[0];
}

static void overflow_the_stack(void) {
  static char room[1 << 16];
  struct sigaction action;
  stack_t other;
  memset(&other, 0, sizeof other);
  other.ss_sp = room;
  other.ss_size = sizeof room;
  sigaltstack(&other, NULL);
  memset(&action, 0, sizeof action);
  action.sa_sigaction = exit_well;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK;
  sigaction(SIGSEGV, &action, NULL);
  MUST(mvs_device_handle_signals(1));
  deep(0);
}

static volatile sig_atomic_t blocked_int, blocked_term, blocked_usr1;

static void look_at_mask(int signal) {
  sigset_t now;
  (void)signal;
  sigprocmask(SIG_SETMASK, NULL, &now);
  blocked_int = sigismember(&now, SIGINT);
  blocked_term = sigismember(&now, SIGTERM);
  blocked_usr1 = sigismember(&now, SIGUSR1);
}

static void respect_the_mask(void) {
  struct sigaction action;
  memset(&action, 0, sizeof action);
  action.sa_handler = look_at_mask;
  sigaddset(&action.sa_mask, SIGINT);
  sigaction(SIGTERM, &action, NULL);
  MUST(mvs_device_handle_signals(1));
  raise(SIGTERM);
  CHECK(blocked_int == 1 && blocked_term == 1 && blocked_usr1 == 0);
  MUST(mvs_device_handle_signals(0));
  action.sa_flags = SA_NODEFER;
  sigaction(SIGTERM, &action, NULL);
  MUST(mvs_device_handle_signals(1));
  raise(SIGTERM);
  CHECK(blocked_int == 1 && blocked_term == 0);
}

static void ignore_and_once(void) {
  struct sigaction once;
  memset(&once, 0, sizeof once);
  once.sa_handler = old_handler;
  once.sa_flags = (int)SA_RESETHAND;
  set_handler(SIGINT, SIG_IGN);
  sigaction(SIGTERM, &once, NULL);
  MUST(mvs_device_handle_signals(1));
  raise(SIGINT);
  raise(SIGINT);
  raise(SIGTERM);
  CHECK(calls == 1);
  if (!failures) raise(SIGTERM);
}

static void die_by_default(void) {
  set_handler(SIGTERM, SIG_DFL);
  MUST(mvs_device_handle_signals(1));
  raise(SIGTERM);
}

/* Nine handlers of the host, with different masks, one after the other. */
static void replace_often(void) {
  static const int masked[] = {SIGHUP,  SIGINT,  SIGQUIT, SIGUSR1,
                               SIGUSR2, SIGALRM, SIGCHLD, SIGTSTP};
  struct sigaction action;
  for (int k = 0; k < 8; ++k) {
    memset(&action, 0, sizeof action);
    action.sa_handler = old_handler;
    sigaddset(&action.sa_mask, masked[k]);
    sigaction(SIGTERM, &action, NULL);
    MUST(mvs_device_handle_signals(1));
  }
  set_handler(SIGTERM, old_handler);
  MUST_FAIL(mvs_device_handle_signals(1), MVS_E_STATE, "install one");
  CHECK(handler_of(SIGTERM) == old_handler);
}

int main(void) {
  CHECK(status_of(survive_two) == 0);
  CHECK(status_of(keep_a_newer_one) == 0);
  CHECK(status_of(install_over_a_newer_one) == 0);
  CHECK(status_of(touch_nothing) == 0);
  CHECK(status_of(overflow_the_stack) == 0);
  CHECK(status_of(respect_the_mask) == 0);
  CHECK(status_of(replace_often) == 0);
  const int once = status_of(ignore_and_once), standard = status_of(die_by_default);
  CHECK(WIFSIGNALED(once) && WTERMSIG(once) == SIGTERM);
  CHECK(WIFSIGNALED(standard) && WTERMSIG(standard) == SIGTERM);
  return finish("signals");
}
