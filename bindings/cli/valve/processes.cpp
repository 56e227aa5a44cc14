#include "valve/processes.h"

#include <sched.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <vector>

#include "text/console.h"

namespace cli {
namespace {

// A number that all processes share.
class SharedCounter {
 public:
  SharedCounter()
      : memory_(mmap(nullptr, sizeof(std::atomic<size_t>), PROT_READ | PROT_WRITE,
                     MAP_SHARED | MAP_ANONYMOUS, -1, 0)) {
    if (memory_ == MAP_FAILED) throw std::bad_alloc();
    next_ = new (memory_) std::atomic<size_t>(0);
  }
  ~SharedCounter() { munmap(memory_, sizeof(std::atomic<size_t>)); }
  SharedCounter(const SharedCounter &) = delete;
  SharedCounter &operator=(const SharedCounter &) = delete;

  size_t take() { return next_->fetch_add(1); }

 private:
  void *memory_;
  std::atomic<size_t> *next_;
};

// One write of at most PIPE_BUF bytes: lines of several processes do not mix.
bool send_line(int pipe, const std::string &line) {
  ssize_t written = 0;
  while ((written = ::write(pipe, line.data(), line.size())) < 0 && errno == EINTR) {
  }
  return written == static_cast<ssize_t>(line.size());
}

// The body of a process; returns its exit code.
int work_off(size_t jobs, SharedCounter &next, int pipe,
             const std::function<std::string(size_t)> &work) {
  try {
    for (size_t k = next.take(); k < jobs && !InterruptFlag::is_set(); k = next.take()) {
      const std::string result = work(k);
      if (InterruptFlag::is_set()) break;
      const std::string line = text("%zu %s\n", k, result.c_str());
      if (line.size() > PIPE_BUF || !send_line(pipe, line)) return 1;
    }
    return 0;
  } catch (const std::exception &error) {
    std::fprintf(stderr, "mvs: %s\n", error.what());
    return 1;
  }
}

// Waits for the processes; returns whether all ended well.
bool join_all(const std::vector<pid_t> &children) {
  bool good = true;
  for (const pid_t child : children) {
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    good = good && WIFEXITED(status) && WEXITSTATUS(status) == 0;
  }
  return good;
}

void take_lines(int pipe, const std::function<void(size_t, const std::string &)> &take) {
  const std::unique_ptr<FILE, int (*)(FILE *)> lines(fdopen(pipe, "r"), &std::fclose);
  if (!lines) throw std::bad_alloc();
  std::vector<char> line(PIPE_BUF + 1);
  while (std::fgets(line.data(), static_cast<int>(line.size()), lines.get())) {
    char *end = nullptr;
    const size_t k = std::strtoull(line.data(), &end, 10);
    std::string result = *end == ' ' ? end + 1 : "";
    if (!result.empty() && result.back() == '\n') result.pop_back();
    take(k, result);
  }
}

}  // namespace

unsigned core_count() {
  cpu_set_t cores;
  CPU_ZERO(&cores);
  if (sched_getaffinity(0, sizeof cores, &cores) != 0) return 1;
  return static_cast<unsigned>(std::max(1, CPU_COUNT(&cores)));
}

void run_in_processes(size_t jobs, unsigned processes,
                      const std::function<std::string(size_t)> &work,
                      const std::function<void(size_t, const std::string &)> &take) {
  SharedCounter next;
  int ends[2];
  if (::pipe(ends) != 0) fail(MVS_E_IO, "jobs", std::string("no pipe: ") + std::strerror(errno));
  std::fflush(nullptr);  // or each process would write the text that is still in the buffers
  std::vector<pid_t> children;
  const size_t count = std::min<size_t>(jobs, std::max(1u, processes));
  for (size_t p = 0; p < count; ++p) {
    const pid_t child = ::fork();
    if (child == 0) {
      ::close(ends[0]);
      const int code = work_off(jobs, next, ends[1], work);
      std::fflush(stderr);
      ::_exit(code);
    }
    if (child > 0) children.push_back(child);
  }
  ::close(ends[1]);
  std::exception_ptr failure;  // of `take`; the next write then ends each process (SIGPIPE)
  try {
    take_lines(ends[0], take);
  } catch (...) {
    failure = std::current_exception();
  }
  const bool good = join_all(children) && !children.empty();
  if (failure) std::rethrow_exception(failure);
  if (good || InterruptFlag::is_set()) return;
  fail(MVS_E_INTERNAL, "jobs",
       "a process ended before its work was done: run the same command again to continue");
}

}  // namespace cli
