// The rim of the sheet, divided as finely as the width of the opening at each place asks for.
#pragma once

#include <optional>
#include <vector>

#include "geometry/triangle_bvh.h"
#include "measure/orifice/opposite.h"

namespace mvs::core::orifice {

struct Sheet;

// Spacings of samples that bisection of an edge has to reach, and where.
struct Spacing {
  explicit Spacing(const Sheet &sheet);

  // Edge length over the distance to opposite tissue, and growth rate of edges away from a rim.
  static constexpr double growth = 0.5;

  // Whether an edge is longer than opposite tissue allows. Samples may be coarse in deep contact: a
  // ball that is stopped by them is stopped by the contact, too.
  bool is_too_long(const Opposite &sheet, const Vec3 &a, const Vec3 &b, const Vec3 &normal,
                   const Vec3 &out = Vec3::Zero()) const;

  double finest, coarsest;  // m
  double deep, seal;        // m
};

// Parts of edges, each as long as its surroundings allow; at corners of an opening the finest
// spacing, since the nearest tissue there is the corner itself.
class RimParts {
 public:
  RimParts(const Sheet &sheet, const Opposite &tissue, const Spacing &spacing);
  RimParts(const RimParts &) = delete;  // the tree refers to the other members
  RimParts &operator=(const RimParts &) = delete;

  // Whether an edge of the sheet is too long for the parts of the rim near it.
  bool is_too_long(const Vec3 &middle, double length) const;

 private:
  void divide(const Opposite &tissue, const Vec3 &a, const Vec3 &b, const Vec3 &normal,
              const Vec3 &out);
  void add(const Vec3 &a, const Vec3 &b, double length);

  const Spacing spacing_;
  std::vector<Vec3> x_;
  std::vector<Tri> parts_;
  std::vector<double> length_;
  std::optional<TriangleBvh> tree_;
};

}  // namespace mvs::core::orifice
