// How likely an arc of the annulus is the attachment of the anterior leaflet.
#pragma once

#include <array>
#include <vector>

#include "patient/leaflet_sheet.h"

namespace mvs::core {

// The annulus in samples of equal length, 0 to n - 1, with the height of the leaflet at each.
struct AnnulusSamples {
  std::vector<Vec3> points;    // in the order of the annulus
  std::vector<double> height;  // m, without clefts and tears
  std::vector<Vec3> tips;      // of the papillary muscles; empty: not known
};

// Which pairs of samples are considered: the same everywhere, or the two feet.
struct ArcGuess {
  size_t from = 0, to = 0;  // the anterior arc; to may exceed n
  double confidence = 0;    // of the pair: share of the posterior within 5 mm
  double orientation = 0;   // that the middle of the anterior leaflet lies in this arc, by all arcs
};

// Sum of the squared deviations of an arc from normal anatomy, in standard deviations: heights all
// along the annulus, at both ends and in between, share of the annulus, flatness, distance of the
// ends, papillary tips.
class ArcOdds {
 public:
  explicit ArcOdds(const AnnulusSamples &annulus);

  // Samples `from` to `to` (from < to < from + n) as the anterior arc.
  double misfit(size_t from, size_t to) const;
  // The best of all arcs whose share, and that of the rest, is at least `least_share`.
  ArcGuess best(double least_share) const;
  // The probability that the arc is the anterior leaflet's, and not the rest of the annulus.
  double is_anterior(size_t from, size_t to) const;

 private:
  double forward_of_tips(const Vec3 &ends, const Vec3 &across) const;

  const AnnulusSamples &annulus_;
  double median_ = 0, width_ = 0;  // m: of all heights; largest distance of two samples
};

}  // namespace mvs::core
