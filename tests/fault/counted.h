// Counts the allocations of a program by a malloc of its own, and forbids its system calls. To be
// included once in a program.
#pragma once

#include <cstddef>
#include <cstdio>
#include <cstdlib>

#if defined(__has_feature)  // clang has no __SANITIZE_ADDRESS__
#define IS_SANITIZED (__has_feature(address_sanitizer) || __has_feature(thread_sanitizer))
#elif defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define IS_SANITIZED 1
#else
#define IS_SANITIZED 0
#endif

#if IS_SANITIZED
#define HAS_OWN_MALLOC 0
#elif defined(__GLIBC__)
#define HAS_OWN_MALLOC 1
#else
#define HAS_OWN_MALLOC 0
#endif

#if HAS_OWN_MALLOC
// One file of a program includes this header, and glibc names its allocator so.
// NOLINTBEGIN(cert-dcl59-cpp, bugprone-reserved-identifier)
namespace {
thread_local long allocations = 0;
thread_local bool has_memory = true;  // of this thread, for operator new and malloc
}  // namespace

// Serves every library of this process; operator new calls it too.
extern "C" {
void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *old, size_t size);
void *__libc_memalign(size_t alignment, size_t size);

void *malloc(size_t size) {
  ++allocations;
  return has_memory ? __libc_malloc(size) : nullptr;
}
void *calloc(size_t count, size_t size) {
  ++allocations;
  return __libc_calloc(count, size);
}
void *realloc(void *old, size_t size) {
  ++allocations;
  return __libc_realloc(old, size);
}
void *aligned_alloc(size_t alignment, size_t size) {
  ++allocations;
  return __libc_memalign(alignment, size);
}
int posix_memalign(void **made, size_t alignment, size_t size) {
  ++allocations;
  *made = __libc_memalign(alignment, size);
  return *made ? 0 : 12;
}
}
// NOLINTEND(cert-dcl59-cpp, bugprone-reserved-identifier)
#endif

#if HAS_OWN_MALLOC && defined(__x86_64__)
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#define HAS_SECCOMP 1
#else
#define HAS_SECCOMP 0
#endif

#if HAS_SECCOMP
// From here on this process may write and end; any other system call kills it. Reading the clock is
// a system call only where the kernel provides no vDSO. False if the system has no such filter.
inline bool allow_nothing_more() {
#define ALLOW(call) \
  BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, (call), 0, 1), BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW)
  sock_filter rules[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      ALLOW(SYS_write),
      ALLOW(SYS_exit_group),
      ALLOW(SYS_clock_gettime),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS),
  };
#undef ALLOW
  const sock_fprog program = {sizeof rules / sizeof rules[0], rules};
  return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

// Runs work() in a child that may only compute. False if it fails there, or the child is killed.
template <typename Work>
bool computes_only(Work &&work) {
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    if (!allow_nothing_more()) _exit(77);
    _exit(work() ? 0 : 1);
  }
  int status = 0;
  if (waitpid(child, &status, 0) != child || !WIFEXITED(status)) return false;
  if (WEXITSTATUS(status) == 77) std::printf("no seccomp here: system calls not tested\n");
  return WEXITSTATUS(status) == 0 || WEXITSTATUS(status) == 77;
}
#endif
