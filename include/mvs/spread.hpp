// Closing along several paths for C++17. Part of mvs/mvs.hpp.
#ifndef MVS_SPREAD_HPP
#define MVS_SPREAD_HPP

#include <mvs/spread.h>
#include <mvs/snapshot.hpp>

#include <cstdint>
#include <utility>

namespace mvs {

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

}  // namespace mvs

#endif
