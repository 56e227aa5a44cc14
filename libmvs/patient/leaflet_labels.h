// Leaflets by the labels of triangles.
#pragma once

#include <array>
#include <vector>

#include "patient/coordinates.h"

namespace mvs::core {

// Labelled area around the annulus: that of the anterior leaflet positive, of the posterior one
// negative.
struct LabelledArea {
  std::vector<double> balance;         // of each sample of the annulus
  double anterior = 0, posterior = 0;  // m2
};

LabelledArea labelled_area(const LeafletSheet &sheet, const SheetCoordinates &c, size_t samples);

// The places of the annulus, m along it, between which the anterior labels outweigh the posterior
// ones by the largest area. Fails if one leaflet has no labels, or if much of the labelled area is
// on the wrong side. The confidence of the finding is the share on the right one.
std::array<double, 2> commissures_of_labels(const LabelledArea &area, double length,
                                            Findings &findings);

}  // namespace mvs::core
