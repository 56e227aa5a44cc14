#include "simulator.h"

#include <string_view>

namespace mvs_python {
namespace {

struct Backend {
  const char *name;
  uint32_t number;
};
constexpr Backend backends[] = {{"default", MVS_BACKEND_DEFAULT},
                                {"block", MVS_BACKEND_BLOCK},
                                {"cholmod", MVS_BACKEND_CHOLMOD},
                                {"eigen", MVS_BACKEND_EIGEN}};

// The returned stats hold the convergence of a settle.
bool is_known(const char *text, bool settles) {
  return settles && std::string_view(text).starts_with("settle: ");
}

// Whether this build of the library has a backend.
bool has(const Backend &backend) {
  const std::string features = std::string(" ") + mvs_features() + " ";
  return backend.number == MVS_BACKEND_DEFAULT ||
         features.find(std::string(" ") + backend.name + " ") != std::string::npos;
}

// A backend that this build lacks is refused by mvs_create, with the sentence of the library.
uint32_t backend_of(const std::string &name) {
  for (const Backend &backend : backends) {
    if (name == backend.name) return backend.number;
  }
  refuse(MVS_E_ARGUMENT, "backend",
         "backend: one of " + backend_words() + " is needed, not \"" + name + "\"");
}

}  // namespace

std::string backend_words() {
  std::string words;
  for (const Backend &backend : backends) {
    if (has(backend)) words += (words.empty() ? "\"" : ", \"") + std::string(backend.name) + "\"";
  }
  return words;
}

Simulator::Simulator(const std::string &backend, uint32_t workers, py::object log)
    : log_(std::move(log)) {
  refuse_no_function(log_, "log");
  auto desc = sized<mvs_sim_desc>();
  desc.backend = backend_of(backend);
  desc.workers = workers;
  desc.log = &Simulator::on_log;
  desc.progress = &Simulator::on_progress;
  desc.user = this;
  must(mvs_create(&desc, &sim_));
}

void Simulator::refuse_closed() {
  refuse(MVS_E_STATE, "", "the simulator is closed; make a new one");
}

// The library calls this in the calling thread, many times during long work.
int32_t Simulator::on_progress(void *user, double share, double residual) {
  auto &self = *static_cast<Simulator *>(user);
  py::gil_scoped_acquire held;
  return report_progress(self.progress_, share, residual, self.raised_);
}

// Messages go to the log; without one, warnings become Python warnings.
void Simulator::on_log(void *user, mvs_log_level level, const char *text) {
  auto &self = *static_cast<Simulator *>(user);
  const bool has_log = !self.log_.is_none();
  // a dropped message must not wait for the interpreter
  if (!has_log && (level > MVS_LOG_WARNING || is_known(text, self.settling_))) return;
  py::gil_scoped_acquire held;
  try {
    if (has_log) {
      self.log_(level, text);
    } else {
      warn(text);
    }
  } catch (...) {
    self.raised_ = std::current_exception();
  }
}

void Simulator::must_not_be_called_back() const {
  if (caller_ != std::this_thread::get_id()) return;
  refuse(MVS_E_STATE, "", "a callback may not use the simulator that called it");
}

void Simulator::close() {
  must_not_be_called_back();
  free_now();
}

void Simulator::free_now() {
  mvs_sim *closing = nullptr;
  {
    py::gil_scoped_release released;
    const std::lock_guard<std::mutex> turn(turn_);
    const std::unique_lock<std::shared_mutex> alone(open_);
    closing = std::exchange(sim_, nullptr);
  }
  mvs_destroy(closing);
}

std::unique_ptr<Snapshot> Simulator::snapshot() {
  const mvs_snapshot *taken = nullptr;
  look([&](mvs_sim *sim) { return mvs_get_snapshot(sim, &taken); });
  return std::make_unique<Snapshot>(taken);
}

}  // namespace mvs_python
