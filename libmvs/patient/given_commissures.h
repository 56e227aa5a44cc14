// Given commissures: where they are on the annulus, and whether surface and landmarks agree.
#pragma once

#include <array>
#include <vector>

#include "patient/coordinates.h"
#include "patient/findings.h"
#include "patient/leaflet_odds.h"
#include "patient/leaflet_sheet.h"

namespace mvs::core {

// No leaflet is attached along less than this share of the annulus: normal are 0.35 to 0.45 for the
// anterior one.
inline constexpr double least_share = 0.2;
// m: a landmark farther from the surface is of another frame or patient. Landmarks of commissures
// are placed by hand on images of 0.7 mm; networks err by up to 3.6 mm.
inline constexpr double farthest_landmark = 8e-3;

// Feet of the commissures, how far they are from the surface, and the farther one with x and y
// mirrored, m.
struct CommissureFeet {
  std::array<double, 2> feet{}, distance{};
  double mirrored = 0;
};

// Throws if a point is too far from the surface, or both are at one place. `given`: by the caller,
// not found.
CommissureFeet feet_of(const LeafletSheet &sheet, const SheetCoordinates &coordinates,
                       const std::vector<Vec3> &points, bool given);

// Says how far given points are from the surface, with a doubt if that is far.
void say_given(const CommissureFeet &found, Finding &finding);

// Doubts given commissures where the leaflets are higher than midway between them: there they would
// be in the middle of both free edges.
void doubt_high(const AnnulusSamples &annulus, const std::array<double, 2> &feet, double length,
                Finding &finding);

// Doubts given commissures that are far less likely, by heights of the leaflets, shape of the
// annulus and tips, than the likeliest pair with at least this share of the annulus for each
// leaflet.
void doubt_unlikely(const AnnulusSamples &annulus, const std::array<double, 2> &feet, double length,
                    double least_guessed_share, Finding &finding);

}  // namespace mvs::core
