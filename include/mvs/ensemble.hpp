// Ensembles for C++17. Part of mvs/experimental.hpp.
#ifndef MVS_ENSEMBLE_HPP
#define MVS_ENSEMBLE_HPP

#include <mvs/ensemble.h>
#include <mvs/snapshot.hpp>

#include <cstdint>
#include <utility>

namespace mvs {

// An ensemble of closures of one valve, owned; mvs/ensemble.h defines it.
class Ensemble {
 public:
  Ensemble(const Snapshot &start, mvs_load_case load, mvs_settle_options settle = {},
           mvs_ensemble_options options = {}) {
    load.struct_size = sizeof load;
    settle.struct_size = sizeof settle;
    options.struct_size = sizeof options;
    must(mvs_ensemble_run(start.get(), &load, &settle, &options, &held_));
  }
  Ensemble(Ensemble &&other) noexcept : held_(std::exchange(other.held_, nullptr)) {}
  Ensemble &operator=(Ensemble &&other) noexcept {
    std::swap(held_, other.held_);
    return *this;
  }
  Ensemble(const Ensemble &) = delete;
  Ensemble &operator=(const Ensemble &) = delete;
  ~Ensemble() { mvs_ensemble_release(held_); }

  const mvs_ensemble *get() const { return held_; }

  mvs_ensemble_summary summary() const {
    mvs_ensemble_summary summary = sized<mvs_ensemble_summary>();
    must(mvs_ensemble_get_summary(held_, &summary));
    return summary;
  }

  mvs_ensemble_member member(std::uint32_t index) const {
    mvs_ensemble_member found = sized<mvs_ensemble_member>();
    must(mvs_ensemble_get_member(held_, index, &found));
    return found;
  }

  mvs_stats stats(std::uint32_t index) const {
    mvs_stats stats = sized<mvs_stats>();
    must(mvs_ensemble_get_member_stats(held_, index, &stats));
    return stats;
  }

  mvs_profile profile(std::uint32_t index) const {
    mvs_profile profile = sized<mvs_profile>();
    must(mvs_ensemble_get_member_profile(held_, index, &profile));
    return profile;
  }

  Snapshot snapshot(std::uint32_t index) const {
    const mvs_snapshot *held = nullptr;
    must(mvs_ensemble_get_member_snapshot(held_, index, &held));
    return Snapshot(held);
  }

  // Returns the statistic MVS_ENSEMBLE_STATISTIC_* of every figure.
  mvs_measures measure(mvs_ensemble_statistic statistic) const {
    mvs_measures measures = sized<mvs_measures>();
    must(mvs_ensemble_measure(held_, statistic, &measures));
    return measures;
  }

  // Returns the array MVS_ENSEMBLE_ARRAY_*, valid while the ensemble lives.
  View<double> view(mvs_ensemble_array which) const {
    mvs_view found = {};
    must(mvs_ensemble_get_array(held_, which, &found));
    return View<double>(found);
  }

 private:
  mvs_ensemble *held_ = nullptr;
};

}  // namespace mvs

#endif
