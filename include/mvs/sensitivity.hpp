// Sensitivities for C++17. Part of mvs/experimental.hpp.
#ifndef MVS_SENSITIVITY_HPP
#define MVS_SENSITIVITY_HPP

#include <mvs/sensitivity.h>
#include <mvs/snapshot.hpp>

#include <cstdint>
#include <utility>
#include <vector>

namespace mvs {

// Derivatives of a snapshot at rest, owned; mvs/sensitivity.h defines them.
class Sensitivity {
 public:
  Sensitivity(const Snapshot &snapshot, const std::vector<mvs_quantity> &of,
              const std::vector<mvs_parameter> &to, mvs_sensitivity_options options = {}) {
    options.struct_size = sizeof options;
    must(mvs_sensitivity_run(snapshot.get(), of.data(), static_cast<std::uint32_t>(of.size()),
                             sizeof(mvs_quantity), to.data(), static_cast<std::uint32_t>(to.size()),
                             sizeof(mvs_parameter), &options, &held_));
  }
  Sensitivity(Sensitivity &&other) noexcept : held_(std::exchange(other.held_, nullptr)) {}
  Sensitivity &operator=(Sensitivity &&other) noexcept {
    std::swap(held_, other.held_);
    return *this;
  }
  Sensitivity(const Sensitivity &) = delete;
  Sensitivity &operator=(const Sensitivity &) = delete;
  ~Sensitivity() { mvs_sensitivity_release(held_); }

  const mvs_sensitivity *get() const { return held_; }

  mvs_sensitivity_summary summary() const {
    return filled<mvs_sensitivity_summary>(mvs_sensitivity_get_summary, held_);
  }

  // A row a quantity, a column a parameter. Valid while the result lives.
  View<double> derivative() const {
    mvs_view view = {};
    must(mvs_sensitivity_get_array(held_, MVS_SENSITIVITY_ARRAY_DERIVATIVE, &view));
    return View<double>(view);
  }

 private:
  mvs_sensitivity *held_ = nullptr;
};

}  // namespace mvs

#endif
