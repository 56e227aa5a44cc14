// Signal mask of the library's threads.
#pragma once

#if defined(__unix__) && !defined(__EMSCRIPTEN__)
#include <pthread.h>

#include <csignal>
#endif

namespace mvs::core {

// Blocks signals of the calling thread while it starts others, which inherit the mask: signals stay
// with the threads of the host, except for those that a fault raises on the thread itself, whose
// handlers have to run there.
class OwnFaultsOnly {
 public:
#if defined(__unix__) && !defined(__EMSCRIPTEN__)
  OwnFaultsOnly() {
    sigset_t others;
    sigfillset(&others);
    for (const int fault : {SIGSEGV, SIGBUS, SIGFPE, SIGILL}) sigdelset(&others, fault);
    pthread_sigmask(SIG_BLOCK, &others, &before_);
  }
  ~OwnFaultsOnly() {
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  OwnFaultsOnly(const OwnFaultsOnly &) = delete;
  OwnFaultsOnly &operator=(const OwnFaultsOnly &) = delete;

 private:
  sigset_t before_;
#else
  OwnFaultsOnly() {}
  ~OwnFaultsOnly() {}
#endif
};

}  // namespace mvs::core
