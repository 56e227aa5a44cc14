// libmvs for C++17, header only: handles that free themselves, failures as exceptions.
//
// Everything here is a thin cover of the C interface, whose headers are the manual. Structs are
// those of C; functions fill in struct_size themselves.
#ifndef MVS_MVS_HPP
#define MVS_MVS_HPP

#include <mvs/mvs.h>
#include <mvs/base.hpp>
#include <mvs/op.hpp>

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace mvs {
inline namespace cpp17 {

// The element type of a view, as MVS_F64 ...
template <typename Value>
struct TypeOf;
template <>
struct TypeOf<double> {
  static constexpr std::uint32_t value = MVS_F64;
};
template <>
struct TypeOf<std::uint32_t> {
  static constexpr std::uint32_t value = MVS_U32;
};
template <>
struct TypeOf<std::uint64_t> {
  static constexpr std::uint32_t value = MVS_U64;
};
template <>
struct TypeOf<std::uint8_t> {
  static constexpr std::uint32_t value = MVS_U8;
};

// Rows of one array of a snapshot; valid while the snapshot is held.
template <typename Value>
class View {
 public:
  explicit View(const mvs_view &view) : view_(view) {}

  std::size_t rows() const { return static_cast<std::size_t>(view_.count); }
  std::size_t components() const { return view_.components; }
  const Value *data() const { return static_cast<const Value *>(view_.data); }
  const Value *row(std::size_t r) const { return data() + r * components(); }
  const Value *begin() const { return data(); }
  const Value *end() const { return data() + rows() * components(); }

 private:
  mvs_view view_;
};

// The history of a snapshot.
struct History {
  std::vector<mvs_history_entry> done;    // from the first to the last
  std::vector<mvs_history_entry> undone;  // in the order in which they would be redone
  std::vector<std::string> checkpoints;
};

// A reference to a snapshot; copies share it.
class Snapshot {
 public:
  // Takes over the caller's reference.
  explicit Snapshot(const mvs_snapshot *held) : held_(held) {}
  Snapshot(const Snapshot &other) : held_(other.held_) { mvs_snapshot_retain(held_); }
  Snapshot(Snapshot &&other) noexcept : held_(std::exchange(other.held_, nullptr)) {}
  Snapshot &operator=(Snapshot other) noexcept {
    std::swap(held_, other.held_);
    return *this;
  }
  ~Snapshot() { mvs_snapshot_release(held_); }

  const mvs_snapshot *get() const { return held_; }
  std::string name() const { return mvs_snapshot_name(held_); }

  std::array<std::uint64_t, 2> hash() const {
    std::array<std::uint64_t, 2> value = {};
    must(mvs_snapshot_hash(held_, value.data()));
    return value;
  }

  // The array MVS_NODE_POSITION ...; throws std::invalid_argument if it is not of `Value`.
  template <typename Value>
  View<Value> view(std::uint32_t which) const {
    mvs_view found = {};
    must(mvs_snapshot_view(held_, which, &found));
    if (found.type != TypeOf<Value>::value) {
      throw std::invalid_argument("this array of the snapshot has another element type");
    }
    return View<Value>(found);
  }

  std::vector<mvs_part> parts(std::uint32_t kind) const {
    std::uint32_t count = 0;
    must(mvs_snapshot_part_count(held_, kind, &count));
    std::vector<mvs_part> found(count);
    for (std::uint32_t k = 0; k < count; ++k) must(mvs_snapshot_part(held_, kind, k, &found[k]));
    return found;
  }

  mvs_part find(std::uint32_t kind, const std::string &name) const {
    mvs_part part = {};
    must(mvs_snapshot_find(held_, kind, name.c_str(), &part));
    return part;
  }

  mvs_load_case load() const {
    mvs_load_case load = sized<mvs_load_case>();
    must(mvs_snapshot_load(held_, &load));
    return load;
  }

  History history() const {
    mvs_history size = sized<mvs_history>();
    must(mvs_snapshot_history(held_, &size));
    History found;
    for (std::uint32_t k = 0; k < size.done + size.undone; ++k) {
      mvs_history_entry entry = sized<mvs_history_entry>();
      must(mvs_snapshot_history_entry(held_, k, &entry));
      (k < size.done ? found.done : found.undone).push_back(entry);
    }
    for (std::uint32_t k = 0; k < size.checkpoints; ++k) {
      found.checkpoints.emplace_back(mvs_snapshot_checkpoint(held_, k));
    }
    return found;
  }

  mvs_measures measure() const {
    mvs_measures measures = sized<mvs_measures>();
    must(mvs_snapshot_measure(held_, &measures));
    return measures;
  }

  mvs_comparison compare(const Snapshot &other) const {
    mvs_comparison comparison = sized<mvs_comparison>();
    must(mvs_snapshot_compare(held_, other.held_, &comparison));
    return comparison;
  }

  // Segments as pairs of points.
  std::vector<std::array<double, 3>> section(const std::array<double, 3> &point,
                                             const std::array<double, 3> &normal) const {
    std::uint64_t count = 0;
    must(mvs_snapshot_section(held_, point.data(), normal.data(), nullptr, 0, &count));
    std::vector<std::array<double, 3>> points(count);
    double *to = count > 0 ? points[0].data() : nullptr;
    must(mvs_snapshot_section(held_, point.data(), normal.data(), to, count, &count));
    return points;
  }

  std::array<double, 12> frame() const {
    std::array<double, 12> value = {};
    must(mvs_snapshot_frame(held_, value.data()));
    return value;
  }

  void save(const std::string &path, std::uint32_t format = MVS_FORMAT_AUTO) const {
    must(mvs_save_file(held_, path.c_str(), format));
  }

  // The plan that led to this snapshot, as the text of its file.
  std::string plan(mvs_plan_options options = {}) const {
    options.struct_size = sizeof options;
    std::uint64_t size = 0;
    must(mvs_write_plan(held_, &options, nullptr, 0, &size));
    std::string text(size, '\0');
    must(mvs_write_plan(held_, &options, text.data(), size, &size));
    return text;
  }

  void save_plan(const std::string &path, mvs_plan_options options = {}) const {
    options.struct_size = sizeof options;
    must(mvs_save_plan(held_, &options, path.c_str()));
  }

  std::string save_memory(std::uint32_t format = MVS_FORMAT_AUTO) const {
    std::uint64_t size = 0;
    must(mvs_save_memory(held_, format, nullptr, 0, &size));
    std::string bytes(size, '\0');
    must(mvs_save_memory(held_, format, bytes.data(), size, &size));
    return bytes;
  }

 private:
  const mvs_snapshot *held_;
};

// A simulator, owned.
class Sim {
 public:
  explicit Sim(mvs_sim_desc desc = {}) {
    desc.struct_size = sizeof desc;
    must(mvs_create(&desc, &sim_));
  }
  Sim(Sim &&other) noexcept : sim_(std::exchange(other.sim_, nullptr)) {}
  Sim &operator=(Sim &&other) noexcept {
    std::swap(sim_, other.sim_);
    return *this;
  }
  Sim(const Sim &) = delete;
  Sim &operator=(const Sim &) = delete;
  ~Sim() { mvs_destroy(sim_); }

  mvs_sim *get() const { return sim_; }

  void set_valve(mvs_valve_desc valve) {
    valve.struct_size = sizeof valve;
    must(mvs_set_valve(sim_, &valve));
  }

  // leaflet 0: all of them
  void set_leaflet(const mvs_leaflet_desc &tissue, mvs_id leaflet = 0) {
    must(mvs_set_leaflet(sim_, leaflet, &tissue));
  }
  void generate(mvs_parametric_desc desc = {}) {
    desc.struct_size = sizeof desc;
    must(mvs_generate_valve(sim_, &desc));
  }

  void refine() { must(mvs_refine_valve(sim_)); }

  // By vertices or by edge; what it did.
  mvs_coarsening coarsen(mvs_coarsen_options options) {
    options.struct_size = sizeof options;
    mvs_coarsening made = sized<mvs_coarsening>();
    must(mvs_coarsen_valve(sim_, &options, &made));
    return made;
  }

  // The state of a coarser or finer level of this valve.
  void transfer_state(const Snapshot &from) { must(mvs_transfer_state(sim_, from.get())); }

  void load_file(const std::string &path, std::uint32_t format = MVS_FORMAT_AUTO) {
    must(mvs_load_file(sim_, path.c_str(), format));
  }

  void load_memory(const std::string &bytes, std::uint32_t format = MVS_FORMAT_AUTO) {
    must(mvs_load_memory(sim_, bytes.data(), bytes.size(), format));
  }

  void set_load(double pressure, double boundary_fraction = 1) {
    mvs_load_case load = sized<mvs_load_case>();
    load.pressure = pressure;
    load.boundary_fraction = boundary_fraction;
    must(mvs_set_load(sim_, &load));
  }

  mvs_load_case load() const {
    mvs_load_case load = sized<mvs_load_case>();
    must(mvs_get_load(sim_, &load));
    return load;
  }

  // Not converged is no failure: look at the result's `converged`.
  mvs_stats settle(mvs_settle_options options = {}) {
    options.struct_size = sizeof options;
    mvs_stats stats = sized<mvs_stats>();
    must(mvs_settle(sim_, &options, &stats));
    return stats;
  }

  void step(mvs_step_options options = {}) {
    options.struct_size = sizeof options;
    must(mvs_step(sim_, &options));
  }

  mvs_stats stats() const {
    mvs_stats stats = sized<mvs_stats>();
    must(mvs_get_stats(sim_, &stats));
    return stats;
  }

  Snapshot snapshot() const {
    const mvs_snapshot *held = nullptr;
    must(mvs_get_snapshot(sim_, &held));
    return Snapshot(held);
  }

  // The text of a plan's file.
  mvs_replay replay_plan(const std::string &text) {
    mvs_replay replay = sized<mvs_replay>();
    must(mvs_replay_plan(sim_, text.data(), text.size(), &replay));
    return replay;
  }

  mvs_replay check_plan(const std::string &text) const {
    mvs_replay replay = sized<mvs_replay>();
    must(mvs_check_plan(sim_, text.data(), text.size(), &replay));
    return replay;
  }

  void open_journal(const std::string &path) { must(mvs_open_journal(sim_, path.c_str())); }
  void close_journal() { must(mvs_close_journal(sim_)); }

  mvs_replay recover_journal(const std::string &path) {
    mvs_replay replay = sized<mvs_replay>();
    must(mvs_recover_journal(sim_, path.c_str(), &replay));
    return replay;
  }

  void restore(const Snapshot &snapshot) { must(mvs_restore(sim_, snapshot.get())); }

  // Throws what apply would throw; changes nothing.
  void check(const mvs_op *op) const { must(mvs_check_op(sim_, op)); }

  // Applies an operation; the id of what it made, 0 for nothing.
  mvs_id apply(const mvs_op *op) {
    mvs_id made = 0;
    must(mvs_apply_op(sim_, op, &made));
    return made;
  }

  // The same for a struct mvs_op_*, whose size and kind need not be set.
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

// What a valve closes to along several paths; mvs/spread.h says what it means.
class Spread {
 public:
  Spread(const Snapshot &start, mvs_load_case load, mvs_settle_options settle = {},
         mvs_spread_options options = {}) {
    load.struct_size = sizeof load;
    settle.struct_size = sizeof settle;
    options.struct_size = sizeof options;
    must(mvs_spread_run(start.get(), &load, &settle, &options, &held_));
  }
  Spread(Spread &&other) noexcept : held_(std::exchange(other.held_, nullptr)) {}
  Spread &operator=(Spread &&other) noexcept {
    std::swap(held_, other.held_);
    return *this;
  }
  Spread(const Spread &) = delete;
  Spread &operator=(const Spread &) = delete;
  ~Spread() { mvs_spread_release(held_); }

  const mvs_spread *get() const { return held_; }

  mvs_spread_summary summary() const {
    mvs_spread_summary summary = sized<mvs_spread_summary>();
    must(mvs_spread_summarise(held_, &summary));
    return summary;
  }

  mvs_spread_path path(std::uint32_t path) const {
    mvs_spread_path found = sized<mvs_spread_path>();
    must(mvs_spread_get_path(held_, path, &found));
    return found;
  }

  mvs_stats stats(std::uint32_t path) const {
    mvs_stats stats = sized<mvs_stats>();
    must(mvs_spread_stats(held_, path, &stats));
    return stats;
  }

  Snapshot snapshot(std::uint32_t path) const {
    const mvs_snapshot *held = nullptr;
    must(mvs_spread_snapshot(held_, path, &held));
    return Snapshot(held);
  }

  // MVS_SPREAD_MEAN ... of every figure.
  mvs_measures measure(std::uint32_t statistic) const {
    mvs_measures measures = sized<mvs_measures>();
    must(mvs_spread_measure(held_, statistic, &measures));
    return measures;
  }

  // The array MVS_SPREAD_NODE or MVS_SPREAD_PAIRS, valid while the spread lives.
  View<double> view(std::uint32_t which) const {
    mvs_view found = {};
    must(mvs_spread_view(held_, which, &found));
    return View<double>(found);
  }

 private:
  mvs_spread *held_ = nullptr;
};

}  // namespace cpp17
}  // namespace mvs

#endif
