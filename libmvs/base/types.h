// The few types that every file of the core shares.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace mvs::core {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Tri = std::array<uint32_t, 3>;
using Edge = std::array<uint32_t, 2>;
using Id = uint64_t;

inline constexpr uint32_t none = UINT32_MAX;

// Sees to room for `size` items, and for as many again: what follows the contact of a live step
// comes to its largest size early.
template <typename T>
void make_room(std::vector<T> &items, size_t size) {
  if (size > items.capacity()) items.reserve(2 * size);
}

}  // namespace mvs::core
