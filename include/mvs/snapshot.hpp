// Snapshots for C++17: references that free themselves, arrays as views. Part of mvs/mvs.hpp.
#ifndef MVS_SNAPSHOT_HPP
#define MVS_SNAPSHOT_HPP

#include <mvs/mvs.h>
#include <mvs/base.hpp>

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace mvs {

// The element type of a view, as MVS_TYPE_F64 ...
template <typename Value>
struct TypeOf;
template <>
struct TypeOf<double> {
  static constexpr std::uint32_t value = MVS_TYPE_F64;
};
template <>
struct TypeOf<std::uint32_t> {
  static constexpr std::uint32_t value = MVS_TYPE_U32;
};
template <>
struct TypeOf<std::uint64_t> {
  static constexpr std::uint32_t value = MVS_TYPE_U64;
};
template <>
struct TypeOf<std::uint8_t> {
  static constexpr std::uint32_t value = MVS_TYPE_U8;
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

struct Cost;

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
  std::string name() const { return mvs_snapshot_get_name(held_); }

  std::array<std::uint64_t, 2> hash() const {
    std::array<std::uint64_t, 2> value = {};
    must(mvs_snapshot_get_hash(held_, value.data()));
    return value;
  }

  // The array MVS_ARRAY_NODE_POSITION ...; throws std::invalid_argument if it is not of `Value`.
  template <typename Value>
  View<Value> view(mvs_array_kind which) const {
    mvs_view found = {};
    must(mvs_snapshot_get_array(held_, which, &found));
    if (found.type != TypeOf<Value>::value) {
      throw std::invalid_argument("this array of the snapshot has another element type");
    }
    return View<Value>(found);
  }

  std::vector<mvs_part> parts(mvs_part_kind kind) const {
    std::uint32_t count = 0;
    must(mvs_snapshot_get_part_count(held_, kind, &count));
    std::vector<mvs_part> found(count);
    for (std::uint32_t k = 0; k < count; ++k)
      must(mvs_snapshot_get_part(held_, kind, k, &found[k]));
    return found;
  }

  mvs_part find(mvs_part_kind kind, const std::string &name) const {
    mvs_part part = {};
    must(mvs_snapshot_find_part(held_, kind, name.c_str(), &part));
    return part;
  }

  mvs_load_case load() const { return filled<mvs_load_case>(mvs_snapshot_get_load, held_); }

  mvs_chord_info chord(std::uint32_t index) const {
    return filled<mvs_chord_info>(mvs_snapshot_get_chord, held_, index);
  }

  // The scallops, then the commissures.
  std::vector<mvs_region_measures> regions() const {
    std::uint32_t count = 0;
    must(mvs_snapshot_get_region_count(held_, &count));
    std::vector<mvs_region_measures> found;
    for (std::uint32_t k = 0; k < count; ++k)
      found.push_back(filled<mvs_region_measures>(mvs_snapshot_get_region, held_, k));
    return found;
  }
  // The parts of the orifice, the largest first.
  std::vector<mvs_orifice_part> orifice_parts() const {
    std::uint32_t count = 0;
    must(mvs_snapshot_get_orifice_part_count(held_, &count));
    std::vector<mvs_orifice_part> found;
    for (std::uint32_t k = 0; k < count; ++k)
      found.push_back(filled<mvs_orifice_part>(mvs_snapshot_get_orifice_part, held_, k));
    return found;
  }

  mvs_stability stability() const {
    return filled<mvs_stability>(mvs_snapshot_get_stability, held_);
  }
  bool at_rest() const { return filled<mvs_rest>(mvs_snapshot_get_rest, held_).at_rest != 0; }

  History history() const {
    const mvs_history size = filled<mvs_history>(mvs_snapshot_get_history, held_);
    History found;
    for (std::uint32_t k = 0; k < size.done + size.undone; ++k) {
      (k < size.done ? found.done : found.undone)
          .push_back(filled<mvs_history_entry>(mvs_snapshot_get_history_entry, held_, k));
    }
    for (std::uint32_t k = 0; k < size.checkpoints; ++k) {
      const char *name = nullptr;
      must(mvs_snapshot_get_checkpoint(held_, k, &name));
      found.checkpoints.emplace_back(name);
    }
    return found;
  }

  mvs_measures measure() const { return filled<mvs_measures>(mvs_snapshot_measure, held_); }
  // The groups MVS_MEASURE_GROUP_* only; NaN and 0 in the other fields.
  mvs_measures measure(mvs_measure_group_flags groups) const {
    return filled<mvs_measures>(mvs_snapshot_measure_groups, held_, groups);
  }

  // Cost of the repair of this closed valve, and the open valve.
  Cost cost(mvs_cost_options options = {}) const;

  mvs_comparison compare(const Snapshot &other) const {
    return filled<mvs_comparison>(mvs_snapshot_compare, held_, other.held_);
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
    must(mvs_snapshot_get_frame(held_, value.data()));
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

// Cost of a repair (mvs_cost), and the valve opened in diastole.
struct Cost {
  mvs_cost figures;
  Snapshot opened;
};

inline Cost Snapshot::cost(mvs_cost_options options) const {
  options.struct_size = sizeof options;
  const mvs_snapshot *opened = nullptr;
  mvs_cost figures = {};
  figures.struct_size = sizeof figures;
  must(mvs_snapshot_measure_cost(held_, &options, &figures, &opened));
  return {figures, Snapshot(opened)};
}

}  // namespace mvs

#endif
