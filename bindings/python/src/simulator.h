// mvs.Simulator: one simulator of the C library, safe to use from any Python thread.
#pragma once

#include <mvs/levels.h>
#include <mvs/op.h>
#include <mvs/plan.h>
#include <mvs/profile.h>
#include <mvs/tool.h>

#include <atomic>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <shared_mutex>
#include <thread>

#include "snapshot.h"

namespace mvs_python {

// Calls run with the interpreter released and one at a time; a second thread waits its turn, and a
// callback that calls its own simulator is refused. A snapshot may be taken at any time.
class Simulator {
 public:
  Simulator(const std::string &backend, py::object log);
  ~Simulator() { free_now(); }
  Simulator(const Simulator &) = delete;
  Simulator &operator=(const Simulator &) = delete;

  void close();
  void load(const std::string &path, uint32_t format);
  void load_bytes(const std::string &bytes, uint32_t format);
  void set_valve(const mvs_valve_desc &valve);
  void generate(const mvs_parametric_desc &dimensions);
  void set_leaflet(const std::optional<std::string> &name, const mvs_leaflet_desc &tissue);
  void refine();
  mvs_coarsening coarsen(const mvs_coarsen_options &options);
  void transfer_state(const Snapshot &from);
  void set_load(double pressure, double boundary_fraction);
  mvs_load_case load_case();
  mvs_stats settle(const mvs_settle_options &options, py::object progress);
  mvs_stats step(const mvs_step_options &options, uint64_t count);
  mvs_stats stats();
  mvs_profile profile();
  std::unique_ptr<Snapshot> snapshot();
  void restore(const Snapshot &snapshot);
  void check(const mvs_op *op);
  mvs_id apply(const mvs_op *op);  // 0: it made nothing
  mvs_id add_tool(const mvs_tool_desc &desc);
  void move_tool(mvs_id tool, const double position[3], const double *axis);  // waits for nothing
  void remove_tool(mvs_id tool);
  mvs_tool_state tool(mvs_id tool);  // waits for nothing
  void undo();
  void redo();
  void begin_group(const std::string &name);
  void end_group();
  void set_checkpoint(const std::string &name);
  void restore_checkpoint(const std::string &name);
  mvs_replay replay_plan(const std::string &text, py::object progress);
  mvs_replay check_plan(const std::string &text);
  void open_journal(const std::string &path);
  void close_journal();
  mvs_replay recover_journal(const std::string &path, py::object progress);
  // A call that has something else to lock as well, on the simulator in its turn.
  void use(const std::function<mvs_result(mvs_sim *)> &work);

 private:
  template <typename Call>
  void call(Call &&work);
  template <typename Look>
  void look(Look &&work);
  template <typename Call>
  void call_with(py::object progress, Call &&work);
  void must_not_be_called_back() const;
  void free_now();
  static int32_t on_progress(void *user, double share, double residual);
  static void on_log(void *user, mvs_log_level level, const char *text);

  mvs_sim *sim_ = nullptr;
  py::object log_, progress_;
  bool settling_ = false;      // whether it came to rest is in what settle returns
  std::exception_ptr raised_;  // by a callback, to be raised again when the call is back
  std::mutex turn_;
  std::shared_mutex open_;  // held by those who look while another thread's call is at work
  std::atomic<std::thread::id> caller_{};
};

void bind_simulator(py::module_ &module);
void bind_operations(py::module_ &module, py::class_<Simulator> &type);
void bind_plans(py::module_ &module, py::class_<Simulator> &type);
void bind_tools(py::class_<Simulator> &type);

}  // namespace mvs_python
