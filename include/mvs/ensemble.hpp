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
    return filled<mvs_ensemble_summary>(mvs_ensemble_get_summary, held_);
  }

  mvs_ensemble_member member(std::uint32_t index) const {
    return filled<mvs_ensemble_member>(mvs_ensemble_get_member, held_, index);
  }

  mvs_stats stats(std::uint32_t index) const {
    return filled<mvs_stats>(mvs_ensemble_get_member_stats, held_, index);
  }

  mvs_profile profile(std::uint32_t index) const {
    return filled<mvs_profile>(mvs_ensemble_get_member_profile, held_, index);
  }

  Snapshot snapshot(std::uint32_t index) const {
    const mvs_snapshot *held = nullptr;
    must(mvs_ensemble_get_member_snapshot(held_, index, &held));
    return Snapshot(held);
  }

  // Returns the statistic MVS_ENSEMBLE_STATISTIC_* of every figure.
  mvs_measures measure(mvs_ensemble_statistic statistic) const {
    return filled<mvs_measures>(mvs_ensemble_measure, held_, statistic);
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
