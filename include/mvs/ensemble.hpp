// Closing along several paths for C++17. Part of mvs/mvs.hpp.
#ifndef MVS_ENSEMBLE_HPP
#define MVS_ENSEMBLE_HPP

#include <mvs/ensemble.h>
#include <mvs/snapshot.hpp>

#include <cstdint>
#include <utility>

namespace mvs {

// What a valve closes to along several paths; mvs/ensemble.h says what it means.
class Spread {
 public:
  Spread(const Snapshot &start, mvs_load_case load, mvs_settle_options settle = {},
         mvs_ensemble_options options = {}) {
    load.struct_size = sizeof load;
    settle.struct_size = sizeof settle;
    options.struct_size = sizeof options;
    must(mvs_ensemble_run(start.get(), &load, &settle, &options, &held_));
  }
  Spread(Spread &&other) noexcept : held_(std::exchange(other.held_, nullptr)) {}
  Spread &operator=(Spread &&other) noexcept {
    std::swap(held_, other.held_);
    return *this;
  }
  Spread(const Spread &) = delete;
  Spread &operator=(const Spread &) = delete;
  ~Spread() { mvs_ensemble_release(held_); }

  const mvs_ensemble *get() const { return held_; }

  mvs_ensemble_summary summary() const {
    mvs_ensemble_summary summary = sized<mvs_ensemble_summary>();
    must(mvs_ensemble_get_summary(held_, &summary));
    return summary;
  }

  mvs_ensemble_member path(std::uint32_t path) const {
    mvs_ensemble_member found = sized<mvs_ensemble_member>();
    must(mvs_ensemble_get_member(held_, path, &found));
    return found;
  }

  mvs_stats stats(std::uint32_t path) const {
    mvs_stats stats = sized<mvs_stats>();
    must(mvs_ensemble_get_member_stats(held_, path, &stats));
    return stats;
  }

  Snapshot snapshot(std::uint32_t path) const {
    const mvs_snapshot *held = nullptr;
    must(mvs_ensemble_get_member_snapshot(held_, path, &held));
    return Snapshot(held);
  }

  // MVS_ENSEMBLE_STATISTIC_MEAN ... of every figure.
  mvs_measures measure(std::uint32_t statistic) const {
    mvs_measures measures = sized<mvs_measures>();
    must(mvs_ensemble_measure(held_, statistic, &measures));
    return measures;
  }

  // The array MVS_ENSEMBLE_ARRAY_NODE_DEVIATION or MVS_ENSEMBLE_ARRAY_PAIR_DISTANCE, valid while
  // the spread lives.
  View<double> view(std::uint32_t which) const {
    mvs_view found = {};
    must(mvs_ensemble_get_array(held_, which, &found));
    return View<double>(found);
  }

 private:
  mvs_ensemble *held_ = nullptr;
};

}  // namespace mvs

#endif
