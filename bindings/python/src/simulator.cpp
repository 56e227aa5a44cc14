#include "simulator.h"

#include <mvs/file.h>

namespace mvs_python {
namespace {

uint32_t backend_of(const std::string &name) {
  if (name == "default") return MVS_BACKEND_DEFAULT;
  if (name == "cholmod") return MVS_BACKEND_CHOLMOD;
  if (name == "eigen") return MVS_BACKEND_EIGEN;
  refuse(MVS_E_ARGUMENT, "backend",
         "backend: \"default\", \"cholmod\" or \"eigen\" is needed, not \"" + name + "\"");
}

[[noreturn]] void refuse_closed() {
  refuse(MVS_E_STATE, "", "the simulator is closed; make a new one");
}

}  // namespace

Simulator::Simulator(const std::string &backend, py::object log) : log_(std::move(log)) {
  mvs_sim_desc desc{};
  desc.struct_size = sizeof desc;
  desc.backend = backend_of(backend);
  desc.log = &Simulator::on_log;
  desc.progress = &Simulator::on_progress;
  desc.user = this;
  must(mvs_create(&desc, &sim_));
}

// Runs a call when no other thread does, and raises what it or a callback failed with.
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
    if (!closed) outcome = outcome_of(work());
    caller_ = std::thread::id();
    raised = std::exchange(raised_, nullptr);
  }
  if (closed) refuse_closed();
  if (raised) std::rethrow_exception(raised);
  must(outcome);
}

// The same for long work; `progress` is called while this call has its turn.
template <typename Call>
void Simulator::call_with(py::object progress, Call &&work) {
  call([&] {
    {
      py::gil_scoped_acquire held;
      progress_ = std::move(progress);
    }
    const mvs_result result = work();
    py::gil_scoped_acquire held;
    progress_ = py::none();
    return result;
  });
}

// The library calls this in the thread that called it, many times during long work.
int32_t Simulator::on_progress(void *user, double share, double residual) {
  auto &self = *static_cast<Simulator *>(user);
  py::gil_scoped_acquire held;
  try {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!self.progress_ || self.progress_.is_none()) return 0;
    return py::bool_(self.progress_(share, residual)) ? 1 : 0;
  } catch (...) {
    self.raised_ = std::current_exception();
    return 1;
  }
}

// Nobody would see what the library warns of if it went only to a log that nobody set.
void Simulator::on_log(void *user, mvs_log_level level, const char *text) {
  auto &self = *static_cast<Simulator *>(user);
  const bool is_heard = !self.log_.is_none();
  // who has nothing to say does not wait for the interpreter
  if (!is_heard && (level > MVS_LOG_WARNING || self.settling_)) return;
  py::gil_scoped_acquire held;
  try {
    if (is_heard) {
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

void Simulator::load(const std::string &path, uint32_t format) {
  call([&] { return mvs_load_file(sim_, path.c_str(), format); });
}

void Simulator::load_bytes(const std::string &bytes, uint32_t format) {
  call([&] { return mvs_load_memory(sim_, bytes.data(), bytes.size(), format); });
}

void Simulator::set_valve(const mvs_valve_desc &valve) {
  call([&] { return mvs_set_valve(sim_, &valve); });
}

void Simulator::generate(const mvs_parametric_desc &dimensions) {
  call([&] { return mvs_generate_valve(sim_, &dimensions); });
}

void Simulator::set_leaflet(const std::optional<std::string> &name,
                            const mvs_leaflet_desc &tissue) {
  mvs_part part{};
  if (name) must(mvs_snapshot_find_part(snapshot()->get(), MVS_PART_LEAFLET, name->c_str(), &part));
  call([&] { return mvs_set_leaflet(sim_, part.id, &tissue); });
}

void Simulator::refine() {
  call([&] { return mvs_refine_valve(sim_); });
}

mvs_coarsening Simulator::coarsen(const mvs_coarsen_options &options) {
  mvs_coarsening made{};
  made.struct_size = sizeof made;
  call([&] { return mvs_coarsen_valve(sim_, &options, &made); });
  return made;
}

void Simulator::transfer_state(const Snapshot &from) {
  call([&] { return mvs_transfer_state(sim_, from.get()); });
}

void Simulator::set_load(double pressure, double boundary_fraction) {
  mvs_load_case load{};
  load.struct_size = sizeof load;
  load.pressure = pressure;
  load.boundary_fraction = boundary_fraction;
  call([&] { return mvs_set_load(sim_, &load); });
}

mvs_load_case Simulator::load_case() {
  mvs_load_case load{};
  load.struct_size = sizeof load;
  call([&] { return mvs_get_load(sim_, &load); });
  return load;
}

mvs_stats Simulator::settle(const mvs_settle_options &options, py::object progress) {
  mvs_stats stats{};
  stats.struct_size = sizeof stats;
  call_with(std::move(progress), [&] {
    settling_ = true;
    const mvs_result result = mvs_settle(sim_, &options, &stats);
    settling_ = false;
    return result;
  });
  return stats;
}

mvs_stats Simulator::step(const mvs_step_options &options, uint64_t count) {
  call([&] {
    mvs_result result = MVS_OK;
    for (uint64_t i = 0; i < count && result == MVS_OK; ++i) result = mvs_step(sim_, &options);
    return result;
  });
  return stats();
}

mvs_stats Simulator::stats() {
  mvs_stats stats{};
  stats.struct_size = sizeof stats;
  call([&] { return mvs_get_stats(sim_, &stats); });
  return stats;
}

mvs_profile Simulator::profile() {
  mvs_profile profile{};
  profile.struct_size = sizeof profile;
  call([&] { return mvs_get_profile(sim_, &profile); });
  return profile;
}

// Runs a call that any thread may make at any time.
template <typename Look>
void Simulator::look(Look &&work) {
  bool closed = false;
  release_and([&] {
    const std::shared_lock<std::shared_mutex> looking(open_);
    closed = sim_ == nullptr;
    return closed ? MVS_OK : work();
  });
  if (closed) refuse_closed();
}

std::unique_ptr<Snapshot> Simulator::snapshot() {
  const mvs_snapshot *taken = nullptr;
  look([&] { return mvs_get_snapshot(sim_, &taken); });
  return std::make_unique<Snapshot>(taken);
}

mvs_id Simulator::add_tool(const mvs_tool_desc &desc) {
  mvs_id tool = 0;
  call([&] { return mvs_add_tool(sim_, &desc, &tool); });
  return tool;
}

void Simulator::move_tool(mvs_id tool, const double position[3], const double *axis) {
  look([&] { return mvs_move_tool(sim_, tool, position, axis); });
}

void Simulator::remove_tool(mvs_id tool) {
  call([&] { return mvs_remove_tool(sim_, tool); });
}

mvs_tool_state Simulator::tool(mvs_id tool) {
  mvs_tool_state state{};
  state.struct_size = sizeof state;
  look([&] { return mvs_get_tool(sim_, tool, &state); });
  return state;
}

void Simulator::restore(const Snapshot &snapshot) {
  call([&] { return mvs_restore(sim_, snapshot.get()); });
}

void Simulator::check(const mvs_op *op) {
  call([&] { return mvs_check_op(sim_, op); });
}

mvs_id Simulator::apply(const mvs_op *op) {
  mvs_id made = 0;
  call([&] { return mvs_apply_op(sim_, op, &made); });
  return made;
}

void Simulator::undo() {
  call([&] { return mvs_undo(sim_); });
}

void Simulator::redo() {
  call([&] { return mvs_redo(sim_); });
}

void Simulator::begin_group(const std::string &name) {
  call([&] { return mvs_begin_group(sim_, name.c_str()); });
}

void Simulator::end_group() {
  call([&] { return mvs_end_group(sim_); });
}

void Simulator::set_checkpoint(const std::string &name) {
  call([&] { return mvs_set_checkpoint(sim_, name.c_str()); });
}

void Simulator::restore_checkpoint(const std::string &name) {
  call([&] { return mvs_restore_checkpoint(sim_, name.c_str()); });
}

mvs_replay Simulator::replay_plan(const std::string &text, py::object progress) {
  mvs_replay replay{};
  replay.struct_size = sizeof replay;
  call_with(std::move(progress),
            [&] { return mvs_replay_plan(sim_, text.data(), text.size(), &replay); });
  return replay;
}

mvs_replay Simulator::check_plan(const std::string &text) {
  mvs_replay replay{};
  replay.struct_size = sizeof replay;
  call([&] { return mvs_check_plan(sim_, text.data(), text.size(), &replay); });
  return replay;
}

void Simulator::open_journal(const std::string &path) {
  call([&] { return mvs_open_journal(sim_, path.c_str()); });
}

void Simulator::close_journal() {
  call([&] { return mvs_close_journal(sim_); });
}

mvs_replay Simulator::recover_journal(const std::string &path, py::object progress) {
  mvs_replay replay{};
  replay.struct_size = sizeof replay;
  call_with(std::move(progress), [&] { return mvs_recover_journal(sim_, path.c_str(), &replay); });
  return replay;
}

void Simulator::use(const std::function<mvs_result(mvs_sim *)> &work) {
  call([&] { return work(sim_); });
}

}  // namespace mvs_python
