// A valve as plain data: what files hold, generators make and operations edit.
#pragma once

#include <string>
#include <vector>

#include "base/types.h"
#include "model/law.h"

namespace mvs {

struct Leaflet {
  Id id = 0;
  std::string name;
  uint32_t law = 1;  // MVS_LEAFLET_*
  double thickness = 1e-3;
  Bilinear bilinear = {};  // constants of MVS_LEAFLET_SPRING
};

struct Scallop {
  Id id = 0;
  std::string name;
  uint32_t leaflet = 0;  // index into leaflets
};

struct Chord {
  Id id = 0;
  std::string name;
  uint32_t a = none;                                 // nearer the papillary head
  uint32_t b = none;                                 // nearer the leaflet
  uint32_t kind = 0;                                 // MVS_CHORD_MARGINAL ...
  uint32_t law = 1;                                  // MVS_CHORD_LINEAR
  double rest_length = 0;                            // m
  double young = 40e6;                               // Pa
  double area = 7.853981633974483e-7;                // m2, diameter 1 mm
  double stiffness() const { return young * area; }  // E A, N
};

struct Head {
  Id id = 0;
  std::string name;
  uint32_t node = none;
};

// Everything that is not derived. Nodes are leaflet vertices, branch points and heads in any order.
struct Valve {
  std::string name = "valve";
  std::vector<Vec3> rest;    // open, unloaded: the rest shape of the sheet
  std::vector<Vec3> loaded;  // where prescribed nodes go under load; equals rest elsewhere
  std::vector<Tri> triangles;
  std::vector<uint32_t> triangle_leaflet;
  std::vector<uint32_t> triangle_scallop;
  std::vector<double> triangle_thickness;
  std::vector<Vec3> triangle_fibre;  // unit, in the rest triangle's plane
  std::vector<uint32_t> annulus;     // closed loop, in order
  std::vector<Leaflet> leaflets;
  std::vector<Scallop> scallops;
  std::vector<Chord> chords;
  std::vector<Head> heads;
  double density = 1060;            // kg/m3
  double contact_thickness = 1e-3;  // m, of a leaflet
  double contact_stiffness = 20e3;  // Pa
  double bending_scale = 1;         // 0: no bending
  Id next_id = 1;                   // every id given so far is below it
};

}  // namespace mvs
