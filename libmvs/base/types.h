// Types that all files of the core share.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace mvs::core {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Tri = std::array<uint32_t, 3>;
using Edge = std::array<uint32_t, 2>;
using Id = uint64_t;

inline constexpr uint32_t none = UINT32_MAX;

template <typename T>
concept Enum = std::is_enum_v<T>;

// Reserves memory for `size` items and as many again: lists that grow with contact during live
// steps reach their largest size early.
template <typename T>
void make_room(std::vector<T> &items, size_t size) {
  if (size > items.capacity()) items.reserve(2 * size);
}

}  // namespace mvs::core
