// A valve as plain data: what files hold, generators make and operations edit.
#pragma once

#include <string>

#include "base/cow_vector.h"
#include "base/types.h"
#include "model/law.h"

namespace mvs::core {

struct Leaflet {
  Id id = 0;
  std::string name;
  uint32_t law = 1;  // MVS_LEAFLET_LAW_*
  double thickness = 1e-3;
  Constants constants = {100e3, 6e6, 0.25};  // of the law; what it does not use is 0

  bool operator==(const Leaflet &) const = default;
};

struct Scallop {
  Id id = 0;
  std::string name;
  uint32_t leaflet = 0;  // index into leaflets

  bool operator==(const Scallop &) const = default;
};

struct Chord {
  Id id = 0;
  std::string name;
  uint32_t a = none;                   // nearer the papillary head
  uint32_t b = none;                   // nearer the leaflet
  uint32_t kind = 0;                   // MVS_CHORD_KIND_MARGINAL ...
  uint32_t law = 1;                    // MVS_CHORD_LAW_LINEAR ...
  double rest_length = 0;              // m
  double young = 40e6;                 // Pa
  double area = 7.853981633974483e-7;  // m2, diameter 1 mm
  using Constants = std::array<double, 6>;
  Constants constants = {};  // of the law; what it does not use is 0

  bool operator==(const Chord &) const = default;
};

using CurvePoint = std::array<double, 2>;  // engineering strain, nominal stress in Pa

// A measured curve that chordae can follow.
struct ChordCurve {
  Id id = 0;
  std::string name;
  CowVector<CurvePoint> points;

  bool operator==(const ChordCurve &) const = default;
};

struct Head {
  Id id = 0;
  std::string name;
  uint32_t node = none;

  bool operator==(const Head &) const = default;
};

// A ring or band sewn to the annulus: what to draw, and that it is there. Where it holds the
// annulus is in Valve::open and Valve::loaded.
struct Ring {
  Id id = 0;
  std::string name;
  uint32_t kind = 1;      // MVS_RING_KIND_*
  CowVector<Vec3> curve;  // m, closed for a ring, open for a band

  bool operator==(const Ring &) const = default;
};

// Everything that is not derived. Nodes are leaflet vertices, branch points and heads in any order.
// Copies share their arrays, so that a valve after an operation costs what the operation changed.
struct Valve {
  std::string name = "valve";
  CowVector<Vec3> rest;        // unloaded: the rest shape of the sheet
  CowVector<Vec3> open;        // where prescribed nodes are without load; equals rest elsewhere
  CowVector<Vec3> loaded;      // where prescribed nodes go under load; equals rest elsewhere
  CowVector<uint32_t> origin;  // index before operations, levels changed the nodes; none: new
  CowVector<Tri> triangles;
  CowVector<uint32_t> triangle_leaflet;
  CowVector<uint32_t> triangle_scallop;
  CowVector<double> triangle_thickness;
  CowVector<Vec3> triangle_fibre;  // unit, in the rest triangle's plane
  CowVector<uint32_t> annulus;     // closed loop, in order
  CowVector<Leaflet> leaflets;
  CowVector<Scallop> scallops;
  CowVector<Chord> chords;
  CowVector<Head> heads;
  CowVector<Ring> rings;
  CowVector<ChordCurve> curves;
  double density = 1060;            // kg/m3
  double contact_thickness = 1e-3;  // m, of a leaflet
  double contact_stiffness = 20e3;  // Pa
  double bending_scale = 1;         // 0: no bending
  Id next_id = 1;                   // every id given so far is below it
};

}  // namespace mvs::core
