// Coaptation measures from samples of the sheet: each triangle is divided into equal parts, and
// each part is tested for tissue that it faces.
#include "measure/coaptation/coaptation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "measure/annulus/frame.h"
#include "measure/annulus/landmarks.h"
#include "measure/coaptation/coaptation_line.h"
#include "measure/coaptation/facing_surface.h"
#include "measure/tissue/surface.h"

namespace mvs::core {
namespace {

constexpr double samples_per_reach = 2;
constexpr size_t most_parts = 12;  // of a triangle's side
constexpr double ends = 0.05;      // share at either end of the line without minimum and maximum

// Distance of stations in m: the least distance at which two lengths are independent, 1.2 mm in a
// default valve.
double station_spacing(const Model &model) {
  return 2 * model.valve.contact_thickness;
}

// A sample that faces other tissue.
struct Coapted {
  Vec3 middle;             // between both
  Vec3 normal;             // towards the other
  double area;             // m2 around it
  double lowest, highest;  // m over the annulus plane
  uint32_t leaflet, other;
};

using Weights = std::array<double, 3>;

// Calls visit(corners) for each of the parts^2 equal parts of a triangle, corners as barycentric
// weights.
template <typename Visit>
void for_each_part(size_t parts, Visit visit) {
  const double n = static_cast<double>(parts);
  const auto corner = [&](size_t i, size_t j) -> Weights {
    const double u = static_cast<double>(i) / n, v = static_cast<double>(j) / n;
    return {1 - u - v, u, v};
  };
  for (size_t i = 0; i < parts; ++i) {
    for (size_t j = 0; i + j < parts; ++j) {
      visit(std::array<Weights, 3>{corner(i, j), corner(i + 1, j), corner(i, j + 1)});
      if (i + j + 1 == parts) continue;
      visit(std::array<Weights, 3>{corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)});
    }
  }
}

size_t parts_of(const Tri &triangle, const std::vector<Vec3> &x, double reach) {
  double longest = 0;
  for (size_t k = 0; k < 3; ++k) {
    longest = std::max(longest, (x[triangle[(k + 1) % 3]] - x[triangle[k]]).norm());
  }
  const double parts = std::ceil(samples_per_reach * longest / reach);
  return static_cast<size_t>(std::clamp(parts, 1.0, static_cast<double>(most_parts)));
}

// Returns the coapted samples of all triangles and fills `share`.
std::vector<Coapted> sample(const Model &model, const std::vector<Vec3> &x, const Surface &surface,
                            const FacingSurface &facing, const Frame &frame,
                            std::vector<double> &share) {
  const Valve &valve = model.valve;
  std::vector<Coapted> samples;
  for (uint32_t t = 0; t < valve.triangles.size(); ++t) {
    const Tri &triangle = valve.triangles[t];
    const size_t parts = parts_of(triangle, x, facing.reach());
    const double area = surface.area[t] / static_cast<double>(parts * parts);
    size_t found = 0;
    for_each_part(parts, [&](const std::array<Weights, 3> &corners) {
      std::array<Vec3, 3> at;
      for (size_t c = 0; c < 3; ++c) {
        at[c] = corners[c][0] * x[triangle[0]] + corners[c][1] * x[triangle[1]] +
                corners[c][2] * x[triangle[2]];
      }
      const Vec3 centre = (at[0] + at[1] + at[2]) / 3;
      const Partner partner = facing.of_point(t, centre);
      if (partner.triangle == none) return;
      ++found;
      const auto height =
          std::minmax({frame.local(at[0])[2], frame.local(at[1])[2], frame.local(at[2])[2]});
      const Vec3 normal = surface.normal[t] - partner.normal;
      samples.push_back({0.5 * (centre + partner.point), normal, area, height.first, height.second,
                         valve.triangle_leaflet[t], valve.triangle_leaflet[partner.triangle]});
    });
    share.push_back(static_cast<double>(found) / static_cast<double>(parts * parts));
  }
  return samples;
}

Vec3 mean_of(const std::vector<CoaptedPiece> &pieces) {
  Vec3 sum = Vec3::Zero();
  double area = 0;
  for (const CoaptedPiece &piece : pieces) {
    sum += piece.area * piece.middle;
    area += piece.area;
  }
  return sum / area;
}

// Returns the midpoint of the attachment of the leaflet that reaches further: the coaptation line
// bulges away from it.
Vec3 find_pole(const Model &model, const Loop &annulus, const std::array<uint32_t, 2> &pair,
               const Vec3 &mean) {
  Vec3 pole = find_landmarks(model, annulus).a;
  double furthest = 0;
  for (const uint32_t leaflet : pair) {
    const Arc arc = attachment(model, annulus, leaflet);
    const Vec3 middle = annulus.at(arc.middle());
    if (arc.length() == 0 || (middle - mean).norm() <= furthest) continue;
    furthest = (middle - mean).norm();
    pole = middle;
  }
  return pole;
}

// Returns one line for each pair of leaflets in contact; a leaflet in contact with itself has a
// line only if the valve has no other leaflet.
std::vector<CoaptationLine> find_lines(const Model &model, const std::vector<Vec3> &x,
                                       const std::vector<Coapted> &samples, const Frame &frame) {
  const Loop annulus(model.valve.annulus, x);
  const Vec3 axis = frame.axes.row(2);
  const uint32_t leaflets = static_cast<uint32_t>(model.valve.leaflets.size());
  std::vector<CoaptationLine> lines;
  for (uint32_t l = 0; l < leaflets; ++l) {
    for (uint32_t r = leaflets > 1 ? l + 1 : l; r < leaflets; ++r) {
      std::vector<CoaptedPiece> pieces;
      for (const Coapted &s : samples) {
        // each side contributes half of the area of one side
        if (std::minmax(s.leaflet, s.other) == std::minmax(l, r)) {
          pieces.push_back({s.middle, s.normal, 0.5 * s.area});
        }
      }
      if (pieces.empty()) continue;
      const Vec3 pole = find_pole(model, annulus, {l, r}, mean_of(pieces));
      lines.push_back(find_coaptation_line(pieces, pole, axis, station_spacing(model)));
    }
  }
  return lines;
}

void summarise(const std::vector<CoaptationLine> &lines, Coaptation &coaptation) {
  double area = 0, length = 0;
  coaptation.length_min = lines.empty() ? 0 : std::numeric_limits<double>::infinity();
  for (const CoaptationLine &line : lines) {
    const double count = static_cast<double>(line.stations.size());
    for (size_t k = 0; k < line.stations.size(); ++k) {
      const CoaptationStation &station = line.stations[k];
      coaptation.line.push_back(station);
      area += station.length * line.spacing;
      length += line.spacing;
      const double along = (static_cast<double>(k) + 0.5) / count;
      if (std::abs(along - 0.5) > 0.5 - ends && count > 2) continue;
      coaptation.length_max = std::max(coaptation.length_max, station.length);
      coaptation.length_min = std::min(coaptation.length_min, station.length);
    }
    coaptation.line_end.push_back(static_cast<uint32_t>(coaptation.line.size()));
  }
  if (length > 0) coaptation.length_mean = area / length;
}

// Height and depth in the central AP plane, as in echocardiography.
void measure_central_plane(const std::vector<Coapted> &samples, const Frame &frame,
                           double half_width, Coaptation &coaptation) {
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (const Coapted &s : samples) {
    if (std::abs(frame.local(s.middle)[1]) > half_width) continue;
    lowest = std::min(lowest, s.lowest);
    highest = std::max(highest, s.highest);
  }
  if (highest < lowest) return;
  coaptation.height = highest - lowest;
  coaptation.depth = -highest;
}

}  // namespace

Coaptation measure_coaptation(const Model &model, const std::vector<Vec3> &x) {
  const Surface surface = surface_of(model.valve.triangles, x);
  const FacingSurface facing(model, x, surface);
  const Frame frame = valve_frame(model, x);
  Coaptation coaptation;
  for (uint32_t node = 0; node < x.size(); ++node) {
    const bool on_sheet = surface.node_normal[node] != Vec3::Zero();
    coaptation.distance.push_back(on_sheet ? facing.of_node(node).distance
                                           : std::numeric_limits<double>::infinity());
  }
  const std::vector<Coapted> samples = sample(model, x, surface, facing, frame, coaptation.share);
  for (const Coapted &s : samples) coaptation.area += 0.5 * s.area;
  summarise(find_lines(model, x, samples, frame), coaptation);
  measure_central_plane(samples, frame, 0.5 * station_spacing(model), coaptation);
  return coaptation;
}

}  // namespace mvs::core
