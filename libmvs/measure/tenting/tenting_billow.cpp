// Tenting and billow from a raster of the leaflets seen from the atrium, closed morphologically by
// a ball of the contact thickness, minus the surface that spans the annulus.
#include "measure/tenting/tenting_billow.h"

#include <algorithm>
#include <cmath>

#include "measure/annulus/annulus_surface.h"
#include "measure/annulus/frame.h"
#include "measure/annulus/landmarks.h"
#include "measure/tenting/height_field.h"

namespace mvs::core {
namespace {

constexpr int cells_across = 256;  // about 0.13 mm each

// Raster of the annulus plane: columns along AP, rows along CC. A cell has the height of the
// annulus surface (NaN outside the annulus) and of the leaflets (-infinity without a leaflet).
struct Raster {
  double low_u, low_v, width, height;  // m, of the first corner and of a cell
  std::vector<double> annulus, leaflet;

  size_t at(int column, int row) const {
    return static_cast<size_t>(row) * cells_across + static_cast<size_t>(column);
  }
  bool inside(size_t cell) const { return !std::isnan(annulus[cell]); }
};

double square(double a) {
  return a * a;
}

Raster empty_raster(const Loop &annulus, const Frame &frame) {
  Vec3 low = frame.local(annulus.point(0)), high = low;
  for (const Vec3 &point : annulus.points()) {
    low = low.cwiseMin(frame.local(point));
    high = high.cwiseMax(frame.local(point));
  }
  const Vec3 cell = (high - low) / cells_across;
  return {low[0], low[1], cell[0], cell[1], {}, {}};
}

void draw(const AnnulusSurface &surface, const HeightField &height_field, Raster &raster) {
  for (int row = 0; row < cells_across; ++row) {
    const double v = raster.low_v + (row + 0.5) * raster.height;
    for (int column = 0; column < cells_across; ++column) {
      const double u = raster.low_u + (column + 0.5) * raster.width;
      raster.annulus.push_back(surface.height(u, v));
      const HeightField::Top top =
          raster.inside(raster.annulus.size() - 1) ? height_field.top(u, v) : HeightField::Top();
      raster.leaflet.push_back(top.triangle != none ? top.height : -HUGE_VAL);
    }
  }
}

// One step of a morphological closing over the inside of the annulus: with sign +1, the height at
// which a ball rests on the heights; with -1, the lowest points of balls with these centres.
std::vector<double> roll(const Raster &raster, const std::vector<double> &heights, double radius,
                         double sign) {
  struct Offset {
    int column, row;
    double rise;
  };
  std::vector<Offset> ball;
  const int columns = static_cast<int>(radius / raster.width);
  const int rows = static_cast<int>(radius / raster.height);
  for (int r = -rows; r <= rows; ++r) {
    for (int c = -columns; c <= columns; ++c) {
      const double left2 = radius * radius - square(c * raster.width) - square(r * raster.height);
      if (left2 >= 0) ball.push_back({c, r, std::sqrt(left2)});
    }
  }
  std::vector<double> result(heights.size(), -HUGE_VAL);
  for (int row = 0; row < cells_across; ++row) {
    for (int column = 0; column < cells_across; ++column) {
      if (!raster.inside(raster.at(column, row))) continue;
      double best = -HUGE_VAL;
      for (const Offset &o : ball) {
        const int c = column + o.column, r = row + o.row;
        if (c < 0 || r < 0 || c >= cells_across || r >= cells_across) continue;
        if (!raster.inside(raster.at(c, r))) continue;
        best = std::max(best, sign * heights[raster.at(c, r)] + o.rise);
      }
      result[raster.at(column, row)] = sign * best;
    }
  }
  return result;
}

// Fills cells without a height by the mean of their neighbours, from the borders of each hole
// inwards.
void fill_holes(Raster &raster) {
  std::vector<size_t> holes;
  for (size_t c = 0; c < raster.leaflet.size(); ++c) {
    if (raster.inside(c) && std::isinf(raster.leaflet[c])) holes.push_back(c);
  }
  while (!holes.empty()) {
    std::vector<size_t> left;
    std::vector<std::pair<size_t, double>> filled;
    for (const size_t cell : holes) {
      const int column = static_cast<int>(cell) % cells_across;
      const int row = static_cast<int>(cell) / cells_across;
      double sum = 0, count = 0;
      for (int r = std::max(row - 1, 0); r <= std::min(row + 1, cells_across - 1); ++r) {
        for (int c = std::max(column - 1, 0); c <= std::min(column + 1, cells_across - 1); ++c) {
          const size_t n = raster.at(c, r);
          if (!raster.inside(n) || std::isinf(raster.leaflet[n])) continue;
          sum += raster.leaflet[n];
          ++count;
        }
      }
      if (count > 0) {
        filled.emplace_back(cell, sum / count);
      } else {
        left.push_back(cell);
      }
    }
    if (filled.empty()) return;  // no leaflet over the annulus
    for (const auto &[cell, height] : filled) raster.leaflet[cell] = height;
    holes = std::move(left);
  }
}

// Height of the leaflets above the annulus surface; 0 if either is not defined.
double rise_at(const Raster &raster, size_t cell) {
  const double rise = raster.leaflet[cell] - raster.annulus[cell];
  return std::isfinite(rise) ? rise : 0;
}

double area_below(const Raster &raster, int row) {
  double sum = 0;
  for (int column = 0; column < cells_across; ++column) {
    sum += raster.width * std::max(0.0, -rise_at(raster, raster.at(column, row)));
  }
  return sum;
}

// Area below the annulus surface in the central AP plane, interpolated between the adjacent rows.
double central_area_below(const Raster &raster) {
  const double place = std::clamp(-raster.low_v / raster.height - 0.5, 0.0, cells_across - 2.0);
  const int row = static_cast<int>(place);
  const double share = place - row;
  return (1 - share) * area_below(raster, row) + share * area_below(raster, row + 1);
}

double highest_over(const AnnulusSurface &surface, const Frame &frame, const Model &model,
                    const std::vector<Vec3> &x) {
  double highest = 0;
  for (const Tri &triangle : model.valve.triangles) {
    for (const uint32_t node : triangle) {
      const Vec3 p = frame.local(x[node]);
      const double rise = p[2] - surface.height(p[0], p[1]);
      if (rise > highest) highest = rise;
    }
  }
  return highest;
}

}  // namespace

TentingBillow measure_tenting_billow(const Model &model, const std::vector<Vec3> &x) {
  const Loop annulus(model.valve.annulus, x);
  const Frame frame = valve_frame(model, x);
  const AnnulusSurface surface(frame, annulus.points());
  Raster raster = empty_raster(annulus, frame);
  draw(surface, HeightField(frame, model.valve.triangles, x), raster);
  const double radius = 0.5 * model.valve.contact_thickness;
  raster.leaflet = roll(raster, roll(raster, raster.leaflet, radius, 1), radius, -1);
  fill_holes(raster);

  TentingBillow result;
  const double cell = raster.width * raster.height;
  for (size_t c = 0; c < raster.leaflet.size(); ++c) {
    if (!raster.inside(c)) continue;
    const double rise = rise_at(raster, c);
    result.tenting_volume += cell * std::max(0.0, -rise);
    result.billow_volume += cell * std::max(0.0, rise);
    if (std::isfinite(raster.leaflet[c])) {
      result.tenting_height = std::max(result.tenting_height, -raster.leaflet[c]);
    }
  }
  result.tenting_area = central_area_below(raster);
  result.billow_height = highest_over(surface, frame, model, x);
  return result;
}

}  // namespace mvs::core
