// The description of a valve as plain data: files hold it, generators make it, operations edit it.
// Lengths in m, moduli in Pa.
#pragma once

#include <string>

#include "base/cow_vector.h"
#include "base/types.h"
#include "model/kinds.h"
#include "model/law.h"

namespace mvs::core {

struct Leaflet {
  Id id = 0;
  std::string name;
  LeafletLawId law = LeafletLawId::spring;
  double thickness = 1e-3;
  Constants constants = {100e3, 6e6, 0.25};  // of the law; unused entries are 0

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
  uint32_t a = none;  // nearer the papillary head
  uint32_t b = none;  // nearer the leaflet
  ChordKind kind = ChordKind::other;
  ChordLawId law = ChordLawId::linear;
  double rest_length = 0;              // m
  double young = 40e6;                 // Pa
  double area = 7.853981633974483e-7;  // m2, diameter 1 mm
  using Constants = std::array<double, 6>;
  Constants constants = {};  // of the law; unused entries are 0

  uint32_t other_end(uint32_t node) const { return node == a ? b : a; }
  bool operator==(const Chord &) const = default;
};

using CurvePoint = std::array<double, 2>;  // engineering strain, nominal stress in Pa

// A measured stress-strain curve for chordae of ChordLawId::table.
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

// A ring or band sewn to the annulus, for display. Valve::open and Valve::loaded contain the
// positions to which it moves the annulus.
struct Ring {
  Id id = 0;
  std::string name;
  RingKind kind = RingKind::rigid;
  CowVector<Vec3> curve;  // m, closed for a ring, open for a band

  bool operator==(const Ring &) const = default;
};

// A valve without derived data. Nodes are leaflet vertices, chord branch points and papillary heads
// in any order. Copies share their arrays (copy on write).
struct Valve {
  std::string name = "valve";
  CowVector<Vec3> rest;        // m: rest shape, without load
  CowVector<Vec3> open;        // m: prescribed nodes without load; equals rest elsewhere
  CowVector<Vec3> loaded;      // m: prescribed nodes under full load; equals rest elsewhere
  CowVector<uint32_t> origin;  // index before operations and levels; none: new
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
  Id next_id = 1;                   // larger than every id in use
};

}  // namespace mvs::core
