// The unstable equilibrium that a settle found last, and how often in a row it returned to it.
#pragma once

#include <cstdint>
#include <vector>

#include "model/model.h"

namespace mvs::core {

class UnstableReturns {
 public:
  // Records that the positions x are an unstable equilibrium.
  void record(const Model &model, const std::vector<Vec3> &x);
  // Returns to the last one, in a row; 0: it was found once, or none was found.
  uint32_t count() const { return count_; }
  // Whether the settle returned so often that it flutters around the equilibrium.
  bool are_endless() const;

 private:
  bool is_near(const Model &model, const std::vector<Vec3> &x) const;

  std::vector<Vec3> x_;  // m, of the nodes; empty: none yet
  uint32_t count_ = 0;
};

}  // namespace mvs::core
