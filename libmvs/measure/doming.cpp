// Comparing the leaflets seen from the atrium with the surface that spans the annulus.
#include "measure/doming.h"

#include <algorithm>
#include <cmath>

#include "measure/frame.h"
#include "measure/landmarks.h"
#include "measure/opposite.h"
#include "measure/relief.h"
#include "measure/span.h"
#include "measure/surface.h"

namespace mvs {
namespace {

constexpr size_t cells_across = 256;  // about 0.15 mm each
constexpr size_t cells_along = 1024;  // of the central AP line

// Cells of the annulus plane: the height of the annulus surface (NaN outside the annulus) and of
// the leaflets over each.
struct Raster {
  size_t columns, rows;
  double cell_area;  // m2; of a single row, its length in m
  std::vector<double> span, leaflet;

  bool inside(size_t c) const { return !std::isnan(span[c]); }
};

struct Box {
  double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
};

Box box_of(const Loop &annulus, const Frame &frame) {
  Box box;
  for (const Vec3 &point : annulus.points()) {
    const Vec3 p = frame.local(point);
    for (int axis = 0; axis < 2; ++axis) {
      box.low[axis] = std::min(box.low[axis], p[axis]);
      box.high[axis] = std::max(box.high[axis], p[axis]);
    }
  }
  return box;
}

// Everything that is looked at from the atrium.
struct View {
  Frame frame;
  Span span;
  Relief relief;
  Opposite opposite;

  // The height of the atrial surface; NaN where there is none: in a hole, or between leaflets that
  // lie together, where one would look down into what only the gap of the model leaves open.
  double atrial_height(double u, double v) const {
    const Relief::Top top = relief.top(u, v);
    if (top.triangle == none) return NAN;
    const Vec3 point = frame.origin + frame.axes.transpose() * Vec3(u, v, top.height);
    return opposite.of_point(top.triangle, point).triangle == none ? top.height : NAN;
  }
};

// What has no height takes the mean of its neighbours, from the borders of each hole inwards.
void fill_holes(Raster &raster) {
  std::vector<size_t> holes;
  for (size_t c = 0; c < raster.leaflet.size(); ++c) {
    if (raster.inside(c) && std::isnan(raster.leaflet[c])) holes.push_back(c);
  }
  while (!holes.empty()) {
    std::vector<size_t> left, filled;
    std::vector<double> heights;
    for (const size_t c : holes) {
      const size_t column = c % raster.columns, row = c / raster.columns;
      double sum = 0, count = 0;
      for (size_t r = row - std::min<size_t>(row, 1); r <= std::min(row + 1, raster.rows - 1);
           ++r) {
        for (size_t k = column - std::min<size_t>(column, 1);
             k <= std::min(column + 1, raster.columns - 1); ++k) {
          const size_t n = r * raster.columns + k;
          if (!raster.inside(n) || std::isnan(raster.leaflet[n])) continue;
          sum += raster.leaflet[n];
          ++count;
        }
      }
      if (count > 0) {
        filled.push_back(c);
        heights.push_back(sum / count);
      } else {
        left.push_back(c);
      }
    }
    if (filled.empty()) return;  // no leaflet over the annulus at all
    for (size_t i = 0; i < filled.size(); ++i) raster.leaflet[filled[i]] = heights[i];
    holes = std::move(left);
  }
}

Raster draw(const View &view, const Box &box, size_t columns, size_t rows) {
  const double width = (box.high[0] - box.low[0]) / static_cast<double>(columns);
  const double height = (box.high[1] - box.low[1]) / static_cast<double>(rows);
  Raster raster = {columns, rows, width * (rows > 1 ? height : 1), {}, {}};
  for (size_t r = 0; r < rows; ++r) {
    const double v = box.low[1] + (static_cast<double>(r) + 0.5) * height;
    for (size_t k = 0; k < columns; ++k) {
      const double u = box.low[0] + (static_cast<double>(k) + 0.5) * width;
      raster.span.push_back(view.span.height(u, v));
      raster.leaflet.push_back(std::isnan(raster.span.back()) ? NAN : view.atrial_height(u, v));
    }
  }
  fill_holes(raster);
  return raster;
}

struct Volumes {
  double below = 0, above = 0;
};

Volumes volumes_of(const Raster &raster) {
  Volumes volumes;
  for (size_t c = 0; c < raster.leaflet.size(); ++c) {
    const double rise = raster.leaflet[c] - raster.span[c];
    if (rise > 0) volumes.above += rise * raster.cell_area;
    if (rise < 0) volumes.below -= rise * raster.cell_area;
  }
  return volumes;
}

double highest_over_span(const View &view, const Model &model, const std::vector<Vec3> &x) {
  double highest = 0;
  for (const Tri &triangle : model.valve.triangles) {
    for (const uint32_t node : triangle) {
      const Vec3 p = view.frame.local(x[node]);
      const double rise = p[2] - view.span.height(p[0], p[1]);
      if (rise > highest) highest = rise;
    }
  }
  return highest;
}

}  // namespace

Doming measure_doming(const Model &model, const std::vector<Vec3> &x) {
  const Loop annulus(model.valve.annulus, x);
  const Frame frame = valve_frame(model, x);
  const Surface surface = surface_of(model.valve.triangles, x);
  const View view = {frame, Span(frame, annulus.points()), Relief(frame, model.valve.triangles, x),
                     Opposite(model, x, surface)};
  Box box = box_of(annulus, frame);
  const Raster raster = draw(view, box, cells_across, cells_across);

  Doming doming;
  for (const double height : raster.leaflet) {
    if (-height > doming.tenting_height) doming.tenting_height = -height;
  }
  const Volumes volumes = volumes_of(raster);
  doming.tenting_volume = volumes.below;
  doming.billow_volume = volumes.above;
  doming.billow_height = highest_over_span(view, model, x);

  box.low[1] = box.high[1] = 0;  // the central AP line
  doming.tenting_area = volumes_of(draw(view, box, cells_along, 1)).below;
  return doming;
}

}  // namespace mvs
