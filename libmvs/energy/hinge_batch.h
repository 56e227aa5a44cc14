// Angles of hinges and their gradients, several hinges at a time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/types.h"

namespace mvs::core {

// Hinges side by side, so that one instruction takes several: element k of each row belongs to
// hinge k. The bits are those of HingeFold, whatever the number of hinges.
struct HingeBatch {
  static constexpr size_t most = 32;  // hinges
  using Row = std::array<double, most>;

  std::array<Row, 12> x;      // m: coordinates of nodes 0 to 3 in turn
  Row angle;                  // rad
  std::array<Row, 12> slope;  // rad/m: derivatives of the angle by those coordinates

  void set_nodes(size_t k, const std::array<uint32_t, 4> &node, const std::vector<Vec3> &at) {
    for (size_t n = 0; n < 4; ++n) {
      for (size_t c = 0; c < 3; ++c) x[3 * n + c][k] = at[node[n]][static_cast<Eigen::Index>(c)];
    }
  }

  // By node n of hinge k.
  Vec3 slope_at(size_t k, size_t n) const {
    return {slope[3 * n][k], slope[3 * n + 1][k], slope[3 * n + 2][k]};
  }
};

// Sets the angles of the first `count` hinges.
void find_angles(HingeBatch &batch, size_t count);

// Sets their angles and gradients.
void find_slopes(HingeBatch &batch, size_t count);

}  // namespace mvs::core
