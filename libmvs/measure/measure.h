// The read-outs: everything mvs_snapshot_measure and the derived arrays of a snapshot show.
// Each group is one header and one file of this folder; this header gathers them.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs {

// The valve's frame: rows of `axes` are AP (towards the anterior leaflet), CC, and the axis into
// the atrium; right-handed.
struct Frame {
  Vec3 origin;  // annulus centroid (by arc length)
  Mat3 axes;
};
Frame valve_frame(const Model &model, const std::vector<Vec3> &x);

struct AnnulusMeasures {
  double ap = 0, cc = 0, perimeter = 0, area_3d = 0, area = 0, saddle_height = 0,
         nonplanar_angle = 0;
};
AnnulusMeasures measure_annulus(const Model &model, const std::vector<Vec3> &x);

// Where leaflets face each other within the contact thickness.
struct Coaptation {
  std::vector<double> distance;  // m per node, infinity where nothing faces it
  std::vector<double> share;     // per triangle, 0..1
  double area = 0, length_mean = 0, length_min = 0, length_max = 0, height = 0, depth = 0;
};
Coaptation measure_coaptation(const Model &model, const std::vector<Vec3> &x);

struct Doming {
  double tenting_height = 0, tenting_area = 0, tenting_volume = 0, billow_height = 0,
         billow_volume = 0;
};
Doming measure_doming(const Model &model, const std::vector<Vec3> &x);

// Principal stretches and Cauchy stresses per triangle, larger first.
struct Strain {
  std::vector<std::array<double, 2>> stretch, stress;
  double max_strain = 0, max_stress = 0, leaflet_area = 0;
};
Strain measure_strain(const Model &model, const std::vector<Vec3> &x);

struct ChordMeasures {
  std::vector<double> strain, tension;  // per chord
  std::vector<Vec3> head_force;         // N, per head
  double max_strain = 0, max_tension = 0;
};
ChordMeasures measure_chords(const Model &model, const std::vector<Vec3> &x);

// The smallest cross-section joining ventricle and atrium: its area, and it as triangles.
struct Orifice {
  double area = 0;  // m2
  std::vector<Vec3> vertices;
  std::vector<Tri> triangles;
};
Orifice measure_orifice(const Model &model, const std::vector<Vec3> &x);

struct Comparison {
  bool same_mesh = false;
  double node_rms = 0, node_max = 0, surface_rms = 0, surface_max = 0;
  double node_rms_registered = 0, node_max_registered = 0, surface_rms_registered = 0,
         surface_max_registered = 0;
  std::array<double, 12> registration{};  // rows of [R | t]
};
Comparison compare_shapes(const Model &a, const std::vector<Vec3> &xa, const Model &b,
                          const std::vector<Vec3> &xb);

// A planar cut of the leaflets: pairs of points.
std::vector<Vec3> cut(const Model &model, const std::vector<Vec3> &x, const Vec3 &point,
                      const Vec3 &normal);

}  // namespace mvs
