// libmvs for C++17, header only: owning handles, failures as exceptions.
//
// A thin wrapper of the C interface, whose headers are the manual. Structs are those of C;
// functions set struct_size themselves. mvs/experimental.hpp wraps mvs/experimental.h.
#ifndef MVS_MVS_HPP
#define MVS_MVS_HPP

#include <mvs/mvs.h>
#include <mvs/base.hpp>
#include <mvs/device.hpp>
#include <mvs/op.hpp>
#include <mvs/snapshot.hpp>
#include <mvs/tool.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <utility>

namespace mvs {

// A simulator, owned.
class Simulator {
 public:
  explicit Simulator(mvs_sim_desc desc = {}) {
    desc.struct_size = sizeof desc;
    must(mvs_create(&desc, &sim_));
  }
  Simulator(Simulator &&other) noexcept : sim_(std::exchange(other.sim_, nullptr)) {}
  Simulator &operator=(Simulator &&other) noexcept {
    std::swap(sim_, other.sim_);
    return *this;
  }
  Simulator(const Simulator &) = delete;
  Simulator &operator=(const Simulator &) = delete;
  ~Simulator() { mvs_destroy(sim_); }

  mvs_sim *get() const { return sim_; }

  // Sets the strides of the arrays of structs as well.
  void set_valve(mvs_valve_desc valve) {
    valve.struct_size = sizeof valve;
    valve.leaflet_stride = sizeof(mvs_leaflet_desc);
    valve.chord_stride = sizeof(mvs_chord_desc);
    valve.head_stride = sizeof(mvs_head_desc);
    valve.ring_stride = sizeof(mvs_ring_desc);
    valve.curve_stride = sizeof(mvs_curve_desc);
    must(mvs_set_valve(sim_, &valve));
  }

  // leaflet 0: all leaflets
  void set_leaflet(const mvs_leaflet_desc &tissue, mvs_id leaflet = 0) {
    must(mvs_set_leaflet(sim_, leaflet, &tissue));
  }
  void generate(mvs_parametric_desc desc = {}) {
    desc.struct_size = sizeof desc;
    must(mvs_generate_valve(sim_, &desc));
  }

  void load_file(const std::string &path, mvs_format format = MVS_FORMAT_AUTO) {
    must(mvs_load_file(sim_, path.c_str(), format));
  }

  void load_memory(const std::string &bytes, mvs_format format = MVS_FORMAT_AUTO) {
    must(mvs_load_memory(sim_, bytes.data(), bytes.size(), format));
  }

  void set_load(double pressure, double boundary_fraction = 1) {
    mvs_load_case load = sized<mvs_load_case>();
    load.pressure = pressure;
    load.boundary_fraction = boundary_fraction;
    must(mvs_set_load(sim_, &load));
  }

  mvs_load_case load() const { return filled<mvs_load_case>(mvs_get_load, sim_); }

  // Does not throw without convergence: check `converged` of the result.
  mvs_stats settle(mvs_settle_options options = {}) {
    options.struct_size = sizeof options;
    mvs_stats stats = sized<mvs_stats>();
    must(mvs_settle(sim_, &options, &stats));
    return stats;
  }

  // A settle in slices. advance_settle returns the completed share; 1: the end.
  void begin_settle(mvs_settle_options options = {}) {
    options.struct_size = sizeof options;
    must(mvs_begin_settle(sim_, &options));
  }

  double advance_settle(double seconds) {
    double share = 0;
    must(mvs_advance_settle(sim_, seconds, &share, nullptr));
    return share;
  }

  void cancel_settle() { must(mvs_cancel_settle(sim_)); }

  void step(mvs_step_options options = {}) {
    options.struct_size = sizeof options;
    must(mvs_step(sim_, &options));
  }

  void prepare_step(mvs_step_options options = {}) {
    options.struct_size = sizeof options;
    must(mvs_prepare_step(sim_, &options));
  }

  mvs_stats stats() const { return filled<mvs_stats>(mvs_get_stats, sim_); }

  Snapshot snapshot() const {
    const mvs_snapshot *held = nullptr;
    must(mvs_get_snapshot(sim_, &held));
    return Snapshot(held);
  }

  // The text of a plan's file.
  mvs_replay replay_plan(const std::string &text) {
    return filled<mvs_replay>(mvs_replay_plan, sim_, text.data(), text.size());
  }

  mvs_replay check_plan(const std::string &text) const {
    return filled<mvs_replay>(mvs_check_plan, sim_, text.data(), text.size());
  }

  void open_journal(const std::string &path) { must(mvs_open_journal(sim_, path.c_str())); }
  void close_journal() { must(mvs_close_journal(sim_)); }

  mvs_replay recover_journal(const std::string &path) {
    return filled<mvs_replay>(mvs_recover_journal, sim_, path.c_str());
  }

  void restore(const Snapshot &snapshot) { must(mvs_restore(sim_, snapshot.get())); }

  // Throws the error that apply would throw; changes nothing.
  void check(const mvs_op *op) const { must(mvs_check_op(sim_, op)); }

  // Applies an operation; returns the id of the part that it made, 0: it made no part.
  mvs_id apply(const mvs_op *op) {
    mvs_id made = 0;
    must(mvs_apply_op(sim_, op, &made));
    return made;
  }

  // The same for a struct mvs_op_*; sets its size and kind.
  template <typename Op, std::uint32_t kind = KindOf<Op>::value>
  void check(Op op) const {
    op.op = {sizeof(Op), kind};
    check(&op.op);
  }
  template <typename Op, std::uint32_t kind = KindOf<Op>::value>
  mvs_id apply(Op op) {
    op.op = {sizeof(Op), kind};
    return apply(&op.op);
  }

  // Sets the stride of the bodies of a convex tool as well.
  mvs_id add_tool(mvs_tool_desc desc) {
    desc.struct_size = sizeof desc;
    desc.body_stride = sizeof(mvs_body_desc);
    mvs_id tool = 0;
    must(mvs_add_tool(sim_, &desc, &tool));
    return tool;
  }
  // From any thread.
  void move_tool(mvs_id tool, const std::array<double, 3> &position) {
    must(mvs_move_tool(sim_, tool, position.data(), nullptr));
  }
  void move_tool(mvs_id tool, const std::array<double, 3> &position,
                 const std::array<double, 3> &axis) {
    must(mvs_move_tool(sim_, tool, position.data(), axis.data()));
  }
  // The same with an orientation, w x y z of a quaternion.
  void move_tool_pose(mvs_id tool, const std::array<double, 3> &position,
                      const std::array<double, 4> &orientation) {
    must(mvs_move_tool_pose(sim_, tool, position.data(), orientation.data()));
  }
  void remove_tool(mvs_id tool) { must(mvs_remove_tool(sim_, tool)); }
  mvs_tool_state tool(mvs_id tool) const {
    return filled<mvs_tool_state>(mvs_get_tool, sim_, tool);
  }

  void undo() { must(mvs_undo(sim_)); }
  void redo() { must(mvs_redo(sim_)); }
  void begin_group(const std::string &name) { must(mvs_begin_group(sim_, name.c_str())); }
  void end_group() { must(mvs_end_group(sim_)); }
  void set_checkpoint(const std::string &name) { must(mvs_set_checkpoint(sim_, name.c_str())); }
  void restore_checkpoint(const std::string &name) {
    must(mvs_restore_checkpoint(sim_, name.c_str()));
  }

 private:
  mvs_sim *sim_ = nullptr;
};

// Checks the text of a plan without a valve.
inline mvs_replay check_plan(const std::string &text) {
  const mvs_sim *no_valve = nullptr;
  return filled<mvs_replay>(mvs_check_plan, no_valve, text.data(), text.size());
}

}  // namespace mvs

#endif
