// The part of the measures that depends on the annulus alone: its spanning surface, area, and
// height on a raster of the annulus plane.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "measure/annulus/annulus_surface.h"
#include "measure/annulus/frame.h"

namespace mvs::core {

// Raster over the bounding box of the annulus: columns along AP, rows along CC. A cell stands for
// its part of the line through the centres of its row: integrals along these lines are continuous
// in the positions of the annulus.
class AnnulusMap {
 public:
  static constexpr int across = 256;  // cells, about 0.13 mm each
  // A part of the line through the centres of a row, by coordinate along AP, m.
  struct Interval {
    double from, to;
  };

  AnnulusMap(const Frame &frame, const std::vector<Vec3> &rim);

  const AnnulusSurface &surface() const { return surface_; }
  double area() const { return area_; }  // m2, of the surface

  double width() const { return width_; }  // m, of a cell along AP
  double depth() const { return depth_; }  // m, along CC
  // Coordinates of the centre of a column or row, m.
  const std::array<double, across> &u() const { return u_; }
  const std::array<double, across> &v() const { return v_; }
  // Coordinates of the border of the raster, m.
  double low_u() const { return low_u_; }
  double low_v() const { return low_v_; }

  static size_t at(int column, int row) {
    return static_cast<size_t>(row) * across + static_cast<size_t>(column);
  }
  // Height of the surface over the middle of the part of a cell inside the annulus, m; NaN outside.
  const std::vector<double> &heights() const { return heights_; }
  // The share of a cell that is inside the annulus: 0 to 1.
  double share(size_t cell) const { return shares_[cell]; }
  bool inside(size_t cell) const { return shares_[cell] > 0; }
  const std::vector<double> &shares() const { return shares_; }
  // The parts of a row inside the annulus, one after the other.
  const std::vector<Interval> &intervals(size_t row) const { return intervals_[row]; }
  // The columns of a row from the first cell inside to behind the last one; 0 and 0 without any.
  size_t first_inside(size_t row) const { return first_inside_[row]; }
  size_t end_inside(size_t row) const { return end_inside_[row]; }

  bool is_of(const Frame &frame, const std::vector<Vec3> &rim) const;

 private:
  void find_intervals();
  void fill_row(size_t row, size_t &near);

  Frame frame_;
  std::vector<Vec3> rim_;
  AnnulusSurface surface_;
  double area_, low_u_, low_v_, width_, depth_;
  std::array<double, across> u_, v_;
  std::array<std::vector<Interval>, across> intervals_;
  std::vector<double> heights_, shares_;
  std::array<size_t, across> first_inside_{}, end_inside_{};
};

// The map of an annulus, from any thread. The process keeps those of the last few annuli, as an
// annulus stands while its valve is closed and operated on; a kept map has the bits of a new one.
std::shared_ptr<const AnnulusMap> annulus_map(const Frame &frame, const std::vector<Vec3> &rim);

}  // namespace mvs::core
