// Handler for fatal signals: sends zero force to all started devices, then calls the previous
// handler with the arguments of the signal, or raises it again for the default action. All that a
// handler calls is async-signal-safe.
#include "haptics/signal_handler.h"

#include <signal.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <mutex>
#include <utility>

#include "base/error.h"
#include "haptics/library_reference.h"

namespace mvs::core {
namespace {

constexpr std::array<int, 7> fatal = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTERM, SIGINT};
constexpr size_t most_replaced = 8;

// Lock-free atomics, because a signal handler may read nothing else.
struct Started {
  std::atomic<mvs_driver_device *> device{nullptr};
  std::atomic<void (*)(mvs_driver_device *)> panic{nullptr};
};
std::array<Started, 32> started;
std::mutex registering;

// A handler of the host that one of ours replaced. Each has a handler of its own, so that a host's
// handler that calls the one before it ends at an older one, never at itself. It is written before
// ours is installed and does not change: a handler may read it at any time.
struct Replaced {
  struct sigaction action = {};
  std::atomic<bool> is_spent{false};  // SA_RESETHAND, and called once
};

struct Watched {
  std::array<Replaced, most_replaced> replaced;
  size_t count = 0;
};
std::array<Watched, fatal.size()> watched;
std::atomic<bool> watching{false};
bool may_be_called_by_host = false;  // its newer handler may keep the address of ours
void *own_library = nullptr;         // reference while a handler is, or may be, called

void zero_all() {
  for (Started &one : started) {
    mvs_driver_device *const device = one.device.load();
    const auto panic = one.panic.load();
    if (device && panic) panic(device);
  }
}

// Whether a thread's own fault raised a signal, which the system does not let a process ignore.
bool is_fault(int signal, const siginfo_t *info) {
  return signal != SIGABRT && signal != SIGTERM && signal != SIGINT && info && info->si_code > 0;
}

// The signal is blocked meanwhile, and ends the process when its handler returns.
void die_of(int signal) {
  struct sigaction standard = {};
  standard.sa_handler = SIG_DFL;
  sigaction(signal, &standard, nullptr);
  raise(signal);
}

void pass_on(Replaced &before, int signal, siginfo_t *info, void *context) {
  const struct sigaction &action = before.action;
  const bool is_ignored = action.sa_handler == SIG_IGN;
  const bool ends = !is_ignored || is_fault(signal, info);
  if (watching && (ends || signal == SIGABRT))
    zero_all();  // abort() ends a process that ignores it
  if (!ends) return;
  const bool is_once = (action.sa_flags & SA_RESETHAND) != 0;
  if (is_ignored || action.sa_handler == SIG_DFL || (is_once && before.is_spent.exchange(true))) {
    die_of(signal);
  } else if (action.sa_flags & SA_SIGINFO) {
    action.sa_sigaction(signal, info, context);
  } else {
    action.sa_handler(signal);
  }
}

// The handler in front of replaced[number].
template <size_t number>
void on_signal(int signal, siginfo_t *info, void *context) {
  const int error = errno;
  for (size_t k = 0; k < fatal.size(); ++k) {
    if (fatal[k] == signal) pass_on(watched[k].replaced[number], signal, info, context);
  }
  errno = error;
}

using Handler = void (*)(int, siginfo_t *, void *);
template <size_t... numbers>
constexpr std::array<Handler, sizeof...(numbers)> handlers_of(std::index_sequence<numbers...>) {
  return {&on_signal<numbers>...};
}
constexpr auto handlers = handlers_of(std::make_index_sequence<most_replaced>());

struct sigaction present_action(int signal) {
  struct sigaction now = {};
  sigaction(signal, nullptr, &now);
  return now;
}

// The number of our handler in an action; most_replaced: it is a handler of the host.
size_t number_of(const struct sigaction &action) {
  size_t k = 0;
  while (k < most_replaced && action.sa_sigaction != handlers[k]) ++k;
  return k;
}

// Signal by signal: glibc leaves the bytes of a mask that the system does not write undefined.
bool is_same(const struct sigaction &a, const struct sigaction &b) {
  bool same = a.sa_sigaction == b.sa_sigaction && a.sa_flags == b.sa_flags;
  for (int k = 1; k < NSIG; ++k) {
    same = same && sigismember(&a.sa_mask, k) == sigismember(&b.sa_mask, k);
  }
  return same;
}

// The place of an action among those replaced, the next free one if it is new.
size_t place_of(const Watched &one, const struct sigaction &action) {
  size_t k = 0;
  while (k < one.count && !is_same(one.replaced[k].action, action)) ++k;
  return k;
}

// The system applies the mask of the host's handler, and continues interrupted calls, as it would
// for that handler.
void install(Watched &one, int signal, const struct sigaction &now) {
  const size_t number = place_of(one, now);
  Replaced &before = one.replaced[number];
  if (number == one.count) {
    before.action = now;
    ++one.count;
  }
  before.is_spent = false;
  struct sigaction action = {};
  action.sa_sigaction = handlers[number];
  action.sa_mask = now.sa_mask;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK | (now.sa_flags & (SA_RESTART | SA_NODEFER));
  if (now.sa_handler == SIG_IGN) action.sa_flags |= SA_RESTART;
  sigaction(signal, &action, nullptr);
}

void install_all() {
  for (size_t k = 0; k < fatal.size(); ++k) {
    const struct sigaction now = present_action(fatal[k]);
    MVS_MUST(number_of(now) < most_replaced || place_of(watched[k], now) < most_replaced,
             MVS_E_STATE, "signals",
             "the handler of signal %d was replaced by %zu different ones: install one, then call "
             "mvs_device_handle_signals(1)",
             fatal[k], most_replaced);
  }
  if (!own_library) own_library = hold_library();
  for (size_t k = 0; k < fatal.size(); ++k) {
    const struct sigaction now = present_action(fatal[k]);
    if (number_of(now) < most_replaced) continue;
    if (watching) may_be_called_by_host = true;
    install(watched[k], fatal[k], now);
  }
  watching = true;
}

void restore_all() {
  for (size_t k = 0; k < fatal.size(); ++k) {
    const size_t number = number_of(present_action(fatal[k]));
    if (number == most_replaced) {
      may_be_called_by_host = true;
      continue;
    }
    const Replaced &before = watched[k].replaced[number];
    struct sigaction action = before.action;
    if (before.is_spent) action.sa_handler = SIG_DFL;
    sigaction(fatal[k], &action, nullptr);
  }
  watching = false;
  if (may_be_called_by_host) return;
  release_library(own_library);
  own_library = nullptr;
}

}  // namespace

void register_device(const mvs_driver_api &api, mvs_driver_device *device) {
  if (!api.panic) return;
  const std::lock_guard<std::mutex> lock(registering);
  for (Started &one : started) {
    if (one.device.load()) continue;
    one.panic = api.panic;
    one.device = device;
    return;
  }
  fail(MVS_E_MEMORY, "device", "more than %zu devices are started at a time", started.size());
}

void unregister_device(mvs_driver_device *device) {
  const std::lock_guard<std::mutex> lock(registering);
  for (Started &one : started) {
    if (one.device.load() == device) one.device = nullptr;
  }
}

void install_signal_handler(bool on) {
  const std::lock_guard<std::mutex> lock(registering);
  if (on) {
    install_all();
  } else if (watching) {
    restore_all();
  }
}

}  // namespace mvs::core
