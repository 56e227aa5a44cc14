// Connected parts of the regurgitant orifice, and the tissue beside each. Pieces that touch in a
// point are one part: where a gap is hardly wider than the contact thickness, single triangles of
// the cut hang on the others by a point, and may face any way.
#pragma once

#include <string>
#include <vector>

#include "measure/orifice/orifice.h"
#include "measure/regions/region_map.h"

namespace mvs::core {

// Small pieces of the orifice that follow each other, and tissue of the regions that are nearest to
// their centres.
struct OrificeSamples {
  double area;  // m2, of each
  size_t count;
  uint32_t tissue;  // triangle of the sheet
  uint32_t part;
};

struct OrificePart {
  uint32_t triangles = 0;
  double area = 0;                  // m2
  double gap = 0;                   // m, widest ball in it
  Vec3 centroid = Vec3::Zero();     // m
  Vec3 direction = Vec3::Zero();    // unit, mean normal, into the atrium
  std::string anterior, posterior;  // scallops beside it, joined by '+'
  std::string commissures;          // the same
};

struct OrificeParts {
  std::vector<OrificePart> parts;     // the largest first
  std::vector<uint32_t> of_triangle;  // per triangle of the orifice: its part
  std::vector<OrificeSamples> samples;
  std::vector<double> gap_of_region;  // m; empty without an orifice
};
OrificeParts find_orifice_parts(const Model &model, const std::vector<Vec3> &x,
                                const RegionMap &map, const Orifice &orifice);

}  // namespace mvs::core
