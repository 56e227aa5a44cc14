// mvs.Simulator: one simulator of the C library, safe to use from any Python thread.
#pragma once

#include <mvs/levels.h>
#include <mvs/op.h>
#include <mvs/plan.h>
#include <mvs/profile.h>
#include <mvs/tool.h>

#include <atomic>
#include <exception>
#include <mutex>
#include <optional>
#include <shared_mutex>
#include <thread>
#include <utility>

#include "snapshot.h"

namespace mvs_python {

// Calls release the interpreter and run one at a time; a second thread waits for its turn, and a
// callback that calls its own simulator is refused. A snapshot can be taken at any time.
class Simulator {
 public:
  Simulator(const std::string &backend, uint32_t workers, py::object log);
  ~Simulator() { free_now(); }
  Simulator(const Simulator &) = delete;
  Simulator &operator=(const Simulator &) = delete;

  void close();
  std::unique_ptr<Snapshot> snapshot();

  // Runs work(mvs_sim *) when no other call is at work; raises its error or that of a callback.
  template <typename Call>
  void call(Call &&work);
  // The same for long work, during which the library calls `progress`.
  template <typename Call>
  void call_with(py::object progress, Call &&work);
  // The same for a settle.
  template <typename Call>
  void settle(py::object progress, Call &&work);
  // Runs a short work(mvs_sim *) `count` times in one turn; Ctrl-C stops between two of them.
  template <typename Call>
  void repeat(uint64_t count, Call &&work);
  // Runs a work(mvs_sim *) that is allowed in any thread at any time.
  template <typename Look>
  void look(Look &&work);

  // The Python functions that it holds, for the garbage collector: visits them, as tp_traverse
  // does, and drops them.
  int visit_functions(visitproc visit, void *arg) const;
  void drop_functions();

 private:
  [[noreturn]] static void refuse_closed();
  void must_not_be_called_back() const;
  void free_now();
  static int32_t on_progress(void *user, double share, double residual);
  static void on_log(void *user, mvs_log_level level, const char *text);

  mvs_sim *sim_ = nullptr;
  py::object log_, progress_;
  bool settling_ = false;      // then its warning of convergence is dropped: the stats hold it
  std::exception_ptr raised_;  // by a callback; raised again after the call
  std::mutex turn_;
  std::shared_mutex open_;  // shared by `look`, exclusive for freeing
  std::atomic<std::thread::id> caller_{};
};

template <typename Call>
void Simulator::call(Call &&work) {
  must_not_be_called_back();
  Outcome outcome;
  std::exception_ptr raised;
  bool closed = false;
  {
    py::gil_scoped_release released;
    const std::lock_guard<std::mutex> turn(turn_);
    closed = sim_ == nullptr;
    caller_ = std::this_thread::get_id();
    if (!closed) outcome = outcome_of(work(sim_));
    caller_ = std::thread::id();
    raised = std::exchange(raised_, nullptr);
  }
  if (closed) refuse_closed();
  if (raised) std::rethrow_exception(raised);
  must(outcome);
}

template <typename Call>
void Simulator::call_with(py::object progress, Call &&work) {
  refuse_no_function(progress, "progress");
  call([&](mvs_sim *sim) {
    {
      py::gil_scoped_acquire held;
      progress_ = std::move(progress);
    }
    const mvs_result result = work(sim);
    py::gil_scoped_acquire held;
    progress_ = py::none();
    return result;
  });
}

template <typename Call>
void Simulator::settle(py::object progress, Call &&work) {
  call_with(std::move(progress), [&](mvs_sim *sim) {
    settling_ = true;
    const mvs_result result = work(sim);
    settling_ = false;
    return result;
  });
}

template <typename Call>
void Simulator::repeat(uint64_t count, Call &&work) {
  call([&](mvs_sim *sim) {
    SignalWatch watch;
    mvs_result result = MVS_OK;
    for (uint64_t k = 0; k < count && result == MVS_OK; ++k) {
      if (watch.interrupted(raised_)) break;
      result = work(sim);
    }
    return result;
  });
}

template <typename Look>
void Simulator::look(Look &&work) {
  bool closed = false;
  release_and([&] {
    const std::shared_lock<std::shared_mutex> looking(open_);
    closed = sim_ == nullptr;
    return closed ? MVS_OK : work(sim_);
  });
  if (closed) refuse_closed();
}

// Methods for functions of the C library that take the simulator, or the simulator and a text.
template <auto function>
void plain_call(Simulator &self) {
  self.call(function);
}
template <auto function>
void text_call(Simulator &self, const std::string &text) {
  const char *name = c_text(text, "name");
  self.call([&](mvs_sim *sim) { return function(sim, name); });
}

// A struct that a function of the C library fills.
template <typename Struct, typename Get>
Struct filled(Simulator &self, Get &&get) {
  auto found = sized<Struct>();
  self.call([&](mvs_sim *sim) { return get(sim, &found); });
  return found;
}

// The names of the sparse factorisations of this build, quoted, for a sentence.
std::string backend_words();

// Makes Simulator a class whose objects the garbage collector frees in a cycle, as of an object
// that owns a simulator with a method of its own as `log`.
py::custom_type_setup collected_with_functions();

void bind_simulator(py::module_ &module);
void bind_valve(py::module_ &module, py::class_<Simulator> &type);
void bind_operations(py::module_ &module, py::class_<Simulator> &type);
void bind_plans(py::module_ &module, py::class_<Simulator> &type);
void bind_tools(py::class_<Simulator> &type);

}  // namespace mvs_python
