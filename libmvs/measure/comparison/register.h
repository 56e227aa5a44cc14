// Rigid registration of one shape to another.
#pragma once

#include <vector>

#include "measure/annulus/frame.h"
#include "measure/comparison/surface_distance.h"

namespace mvs::core {

// p -> turn p + shift
struct Rigid {
  Mat3 turn = Mat3::Identity();
  Vec3 shift = Vec3::Zero();

  Vec3 operator()(const Vec3 &p) const { return turn * p + shift; }
  Rigid inverse() const { return {turn.transpose(), -(turn.transpose() * shift)}; }
};

// Returns the motion that maps frame a onto frame b.
Rigid align(const Frame &a, const Frame &b);

// Returns the motion with the least sum of squared distances from a[i] to b[i] (Kabsch, Acta Cryst.
// A 32, 1976). `a` must not be empty.
Rigid register_points(const std::vector<Vec3> &a, const std::vector<Vec3> &b);

// Returns the motion of a, near `start`, with the least symmetric RMS surface distance to b; uses
// at most a few thousand samples of either.
Rigid register_surfaces(const SampledSurface &a, const SampledSurface &b, const Rigid &start);

}  // namespace mvs::core
