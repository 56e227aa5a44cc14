// Leaflet tissue of a patient as one sheet of triangles, its two rims, coordinates on it, and the
// findings that were made on the way.
#pragma once

#include <string>
#include <vector>

#include "base/types.h"

namespace mvs::core {

// Labels of triangles, as in mvs_surface_desc.
enum class LeafletLabel : uint32_t { unknown = 0, anterior = 1, posterior = 2 };

struct LeafletSheet {
  std::vector<Vec3> x;              // m
  std::vector<Tri> triangles;       // wound alike
  std::vector<LeafletLabel> label;  // of each triangle
  std::vector<double> thickness;    // m, of each vertex; empty: not known
};

// The two boundary loops of a sheet, in the order in which the triangles pass along them.
struct SheetRims {
  std::vector<uint32_t> annulus, free_edge;
  bool turned = false;  // whether the triangles were turned when the rims were found
};

// Surface coordinates of each vertex.
struct SheetCoordinates {
  double annulus_length = 0;   // m
  std::vector<double> foot;    // m along the annulus from its first node: where its fibre starts
  std::vector<double> share;   // 0 at the annulus to 1 at the free edge
  std::vector<double> height;  // m, from the annulus to the vertex along the leaflet
  std::vector<double> whole;   // m, from the annulus past the vertex to the free edge
};

// Where a value comes from.
enum class FindingSource : uint32_t {
  given = 1,     // by the caller
  measured = 2,  // on the surface
  guessed = 3,   // from the shape, by a rule that may be wrong
  assumed = 4    // from a table of normal anatomy
};

// One decision of the build, with the values that it led to.
struct Finding {
  std::string name;  // "annulus", "thickness": the key of import.json
  FindingSource source = FindingSource::measured;
  double confidence = 1;      // 0 to 1
  std::string sentence;       // the observation, and the remedy if it is wrong
  std::vector<double> value;  // SI
  std::string unit;           // "m", "m2", or ""
};
using Findings = std::vector<Finding>;

}  // namespace mvs::core
