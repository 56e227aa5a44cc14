// A leaflet along the central AP plane or beside it, from the annulus to its free edge.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs::core {

// Where the plane cuts one triangle: the point nearer to the annulus along the leaflet, then the
// other one.
struct ProfilePiece {
  uint32_t triangle;
  Vec3 from, to;  // m
};

// Walks from triangle to triangle, from the annulus of the anterior leaflet (`anterior`) or of
// another one to the border of the sheet. Each fold is followed, so that the length is that of the
// tissue. Empty if the plane does not cut the attachment of the leaflet. The plane is `offset` m
// along CC from the central one: a profile ends at the rim of a seam, so that leaflets are measured
// beside seams (section_planes.h).
std::vector<ProfilePiece> central_profile(const Model &model, const std::vector<Vec3> &x,
                                          bool anterior, double offset);

// Length of a profile; NaN of an empty one.
double length_of(const std::vector<ProfilePiece> &profile);

}  // namespace mvs::core
