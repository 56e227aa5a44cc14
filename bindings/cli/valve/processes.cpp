#include "valve/processes.h"

#include <poll.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <vector>

#include "text/console.h"
#include "text/replace_file.h"

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

// The body of a process; returns its exit code.
int work_off(size_t jobs, SharedCounter &next, int pipe,
             const std::function<std::string(size_t)> &work) {
  try {
    for (size_t k = next.take(); k < jobs && !InterruptFlag::is_set(); k = next.take()) {
      const std::string result = work(k);
      if (InterruptFlag::is_set()) break;
      if (write_bytes(pipe, text("%zu %s\n", k, result.c_str())) != 0) return 1;
    }
    return 0;
  } catch (const std::exception &error) {
    std::fprintf(stderr, "mvs: %s\n", error.what());
    return 1;
  }
}

// A process and the read end of its own pipe, so that lines of several processes do not mix.
struct Child {
  pid_t process;
  int pipe;           // -1 after its end
  std::string begun;  // a line whose end has not come yet; without it, no result
};
using Take = std::function<void(size_t, const std::string &)>;

void close_pipes(std::vector<Child> &children) {
  for (Child &child : children) {
    if (child.pipe >= 0) ::close(child.pipe);
    child.pipe = -1;
  }
}

// Ends this process with its parent, whose lock on the table it shares.
void end_with(pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);
}

// Waits for the processes; returns whether all ended well.
bool join_all(const std::vector<Child> &children) {
  bool good = true;
  for (const Child &child : children) {
    int status = 0;
    while (waitpid(child.process, &status, 0) < 0 && errno == EINTR) {
    }
    good = good && WIFEXITED(status) && WEXITSTATUS(status) == 0;
  }
  return good;
}

// Reads the bytes that a process has sent, and takes the complete lines.
void take_lines(Child &child, const Take &take) {
  char bytes[4096];
  const ssize_t got = ::read(child.pipe, bytes, sizeof bytes);
  if (got < 0 && errno == EINTR) return;
  if (got <= 0) {
    ::close(child.pipe);
    child.pipe = -1;
    return;
  }
  child.begun.append(bytes, static_cast<size_t>(got));
  for (size_t end = 0; (end = child.begun.find('\n')) != std::string::npos;) {
    const std::string line = child.begun.substr(0, end);
    child.begun.erase(0, end + 1);
    take(std::strtoull(line.c_str(), nullptr, 10), line.substr(line.find(' ') + 1));
  }
}

// A terminal sends Ctrl-C to all processes, `kill -INT` only to this one.
void interrupt(const std::vector<Child> &children) {
  for (const Child &child : children) {
    if (child.pipe >= 0) ::kill(child.process, SIGINT);
  }
}

// Takes the lines of all processes until each has closed its pipe.
void take_all(std::vector<Child> &children, const Take &take) {
  constexpr int pause_ms = 100;  // a signal just before poll() does not end it
  bool is_interrupted = false;
  std::vector<pollfd> pipes;
  pipes.reserve(children.size());
  for (const Child &child : children) pipes.push_back({child.pipe, POLLIN, 0});
  for (size_t open = pipes.size(); open > 0;) {
    if (InterruptFlag::is_set() && !is_interrupted) {
      interrupt(children);
      is_interrupted = true;
    }
    if (::poll(pipes.data(), pipes.size(), pause_ms) < 0) {
      if (errno != EINTR) throw std::bad_alloc();
      continue;
    }
    for (size_t p = 0; p < pipes.size(); ++p) {
      if (pipes[p].fd < 0 || pipes[p].revents == 0) continue;
      take_lines(children[p], take);
      pipes[p].fd = children[p].pipe;  // poll() leaves out -1
      if (pipes[p].fd < 0) --open;
    }
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
                      const std::function<std::string(size_t)> &work, const Take &take) {
  SharedCounter next;
  std::fflush(nullptr);  // or each process would write the text that is still in the buffers
  std::vector<Child> children;
  const size_t count = std::min<size_t>(jobs, std::max(1u, processes));
  const pid_t parent = ::getpid();
  children.reserve(count);
  int ends[2];
  for (size_t p = 0; p < count && ::pipe(ends) == 0; ++p) {
    const pid_t process = ::fork();
    if (process == 0) {
      end_with(parent);
      ::close(ends[0]);
      close_pipes(children);  // of the others, whose writes fail once this program has ended
      const int code = work_off(jobs, next, ends[1], work);
      std::fflush(stderr);
      ::_exit(code);
    }
    ::close(ends[1]);
    if (process < 0) ::close(ends[0]);
    if (process > 0) children.push_back({process, ends[0], ""});
  }
  if (children.empty() && jobs > 0) {
    fail(MVS_E_IO, "jobs", std::string("no process can be started: ") + std::strerror(errno));
  }
  std::exception_ptr failure;  // of `take`; the next write then ends each process (SIGPIPE)
  try {
    take_all(children, take);
  } catch (...) {
    failure = std::current_exception();
  }
  close_pipes(children);
  const bool good = join_all(children);
  if (failure) std::rethrow_exception(failure);
  if (good || InterruptFlag::is_set()) return;
  fail(MVS_E_INTERNAL, "jobs",
       "a process ended before its work was done: run the same command again to continue");
}

}  // namespace cli
