// The snapshot behind mvs_snapshot: model, state, history, and measures computed on demand.
#pragma once

#include <mvs/snapshot.h>

#include <atomic>
#include <mutex>
#include <optional>
#include <utility>

#include "anatomy/chord_ends.h"
#include "energy/forces.h"
#include "history/history.h"
#include "measure/measure.h"
#include "model/model.h"
#include "solve/stability.h"

namespace mvs::core {

// A value computed by the first call of get(), from any thread. A failure is not stored: the next
// call tries again.
template <typename Value>
class Lazy {
 public:
  template <typename Make>
  const Value &get(Make make) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!value_) value_.emplace(make());
    return *value_;
  }
  bool is_computed() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return value_.has_value();
  }

 private:
  mutable std::mutex mutex_;
  mutable std::optional<Value> value_;
};

// Fields of the parts as arrays, for views of the C interface.
struct Tables {
  std::vector<Edge> chord_nodes;
  std::vector<ChordKind> chord_kind;
  std::vector<ChordLawId> chord_law;
  std::vector<LeafletLawId> leaflet_law;
  std::vector<RingKind> ring_kind;
  std::vector<uint32_t> head_nodes, free_edge_nodes, ring_start, curve_start;
  std::vector<Vec3> ring_points;
  std::vector<CurvePoint> curve_points;
  std::vector<Chord::Constants> chord_constants;
  std::vector<Id> chord_id, ring_id;
  std::vector<double> chord_rest_length, chord_young, chord_area;
  std::vector<std::array<double, 9>> leaflet_constants;
  std::array<double, 4> valve_constants;
};

}  // namespace mvs::core

// Forces on all nodes, and in N those on the nodes of the annulus, in its order.
struct BoundaryForces {
  mvs::core::Forces all;
  std::vector<mvs::core::Vec3> annulus;
};

// The leaflets seen from the atrium, with their tenting and billow.
struct AtrialSide {
  mvs::core::AtrialSurface surface;
  mvs::core::TentingBillow tenting_billow;
};

// Immutable except for the reference count and the values computed on demand.
struct mvs_snapshot {
  explicit mvs_snapshot(mvs::core::Snapshot value_in)
      : value(std::move(value_in)), model(value.current.model), state(value.current.state) {}

  const mvs::core::Forces &forces() const;
  const mvs::core::Coaptation &coaptation() const;
  const mvs::core::Strain &strain() const;
  const mvs::core::Tensors &tensors() const;
  const mvs::core::ChordMeasures &chords() const;
  const mvs::core::ChordEnds &chord_ends() const;
  const mvs::core::Orifice &orifice() const;
  const mvs::core::OrificeParts &orifice_parts() const;
  const mvs::core::RegionMap &region_map() const;
  const std::vector<mvs::core::RegionMeasures> &regions() const;
  const mvs::core::Stability &stability() const;
  const std::vector<mvs::core::Vec3> &annulus_force() const;  // N, on each node of the annulus
  const mvs::core::Tables &tables() const;
  const mvs::core::AnnulusMeasures &annulus() const;
  // Leaflets seen from the atrium, for tenting, billow and regions.
  const mvs::core::AtrialSurface &atrial_surface() const;
  const mvs::core::TentingBillow &tenting_billow() const;
  uint32_t crossings() const;  // pairs of triangles that cross
  const mvs_measures &measures() const;
  // Groups MVS_MEASURE_GROUP_* only; NaN and 0 in the others, which are not computed.
  mvs_measures measures(mvs_measure_group_flags groups) const;
  // The groups computed so far, by any call.
  mvs_measure_group_flags computed_groups() const;

  const mvs::core::Snapshot value;
  const mvs::core::ModelPtr &model;
  const mvs::core::State &state;
  void retain() const { references_.fetch_add(1, std::memory_order_relaxed); }
  void release() const {
    if (references_.fetch_sub(1, std::memory_order_acq_rel) == 1) delete this;
  }

 private:
  ~mvs_snapshot() = default;
  const BoundaryForces &boundary_forces() const;
  const AtrialSide &atrial_side() const;

  mutable std::atomic<uint32_t> references_{1};
  mvs::core::Lazy<BoundaryForces> forces_;
  mvs::core::Lazy<mvs::core::Coaptation> coaptation_;
  mvs::core::Lazy<mvs::core::Strain> strain_;
  mvs::core::Lazy<mvs::core::Tensors> tensors_;
  mvs::core::Lazy<mvs::core::ChordMeasures> chords_;
  mvs::core::Lazy<mvs::core::ChordEnds> chord_ends_;
  mvs::core::Lazy<mvs::core::Orifice> orifice_;
  mvs::core::Lazy<mvs::core::OrificeParts> orifice_parts_;
  mvs::core::Lazy<mvs::core::RegionMap> region_map_;
  mvs::core::Lazy<std::vector<mvs::core::RegionMeasures>> regions_;
  mvs::core::Lazy<mvs::core::Stability> stability_;
  mvs::core::Lazy<mvs::core::Tables> tables_;
  mvs::core::Lazy<mvs::core::AnnulusMeasures> annulus_;
  mvs::core::Lazy<AtrialSide> atrial_side_;
  mvs::core::Lazy<uint32_t> crossings_;
  mvs::core::Lazy<mvs_measures> measures_;
};

namespace mvs::core {

// Holds one reference to a snapshot.
class SnapshotPtr {
 public:
  SnapshotPtr() = default;
  // Takes ownership of a reference of the caller.
  explicit SnapshotPtr(const mvs_snapshot *held) : held_(held) {}
  SnapshotPtr(const SnapshotPtr &other) : held_(other.held_) {
    if (held_) held_->retain();
  }
  SnapshotPtr(SnapshotPtr &&other) noexcept : held_(std::exchange(other.held_, nullptr)) {}
  SnapshotPtr &operator=(SnapshotPtr other) noexcept {
    std::swap(held_, other.held_);
    return *this;
  }
  void swap(SnapshotPtr &other) noexcept { std::swap(held_, other.held_); }
  ~SnapshotPtr() {
    if (held_) held_->release();
  }

  const mvs_snapshot *get() const { return held_; }
  const mvs_snapshot *operator->() const { return held_; }
  explicit operator bool() const { return held_ != nullptr; }
  // Gives the reference to the caller.
  const mvs_snapshot *release() { return std::exchange(held_, nullptr); }

 private:
  const mvs_snapshot *held_ = nullptr;
};

inline SnapshotPtr make_snapshot(Snapshot snapshot) {
  return SnapshotPtr(new mvs_snapshot(std::move(snapshot)));
}

inline mvs_load_case public_load(const Load &load) {
  return {sizeof(mvs_load_case), 0, load.pressure, load.boundary_fraction};
}

}  // namespace mvs::core
