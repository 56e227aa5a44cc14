// Landmarks in the other one of the frames LPS and RAS: their x and y have the other sign.
#pragma once

#include <string>
#include <vector>

#include "base/error.h"
#include "base/types.h"

namespace mvs::core {

inline Vec3 mirrored(const Vec3 &p) {
  return {-p.x(), -p.y(), p.z()};
}
inline std::vector<Vec3> mirrored(std::vector<Vec3> points) {
  for (Vec3 &p : points) p = mirrored(p);
  return points;
}

// m: landmarks nearer than this are in the right frame. Confidence in those that fit if they are
// mirrored only.
inline constexpr double off_by_frame = 1e-3, mirrored_confidence = 0.1;

// Whether landmarks fit with x and y mirrored: `other` (m, from where they belong) is within `near`
// and at most a third of the distance as given.
inline bool fits_mirrored(double as_given, double other, double near) {
  return other <= near && 3 * other <= as_given;
}

// The words for it, after a question; none if they do not fit.
inline std::string mirrored_words(double as_given, double other, double near) {
  if (!fits_mirrored(as_given, other, near)) return "";
  return format(
      " With x and y mirrored they lie %.1f mm from it: they are in the other frame of "
      "LPS and RAS",
      other * 1e3);
}

}  // namespace mvs::core
