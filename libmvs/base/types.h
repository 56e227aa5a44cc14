// The few types that every file of the core shares.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace mvs {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Tri = std::array<uint32_t, 3>;
using Edge = std::array<uint32_t, 2>;
using Id = uint64_t;

inline constexpr uint32_t none = UINT32_MAX;

}  // namespace mvs
