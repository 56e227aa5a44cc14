// Coaptation measures from samples of the sheet: each triangle is divided into equal parts, and
// each part counts with the weight with which its centre faces other tissue.
#include "measure/coaptation/coaptation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "measure/annulus/frame.h"
#include "measure/annulus/landmarks.h"
#include "measure/coaptation/central_section.h"
#include "measure/coaptation/coaptation_line.h"
#include "measure/coaptation/coaptation_parts.h"
#include "measure/coaptation/facing_surface.h"
#include "measure/coaptation/facing_weight.h"
#include "measure/tissue/surface.h"

namespace mvs::core {
namespace {

// Distance of stations in m: the least distance at which two lengths are independent, 2 mm in a
// default valve.
double station_spacing(const Model &model) {
  return 2 * model.valve.contact_thickness;
}

// Samples that face tissue of a leaflet, with the area of one side, by pair of leaflets.
class Coapted {
 public:
  explicit Coapted(size_t leaflets) : leaflets_(leaflets), pieces_(leaflets * leaflets) {}

  std::vector<CoaptedPiece> &of(uint32_t a, uint32_t b) {
    return pieces_[std::min(a, b) * leaflets_ + std::max(a, b)];
  }

 private:
  size_t leaflets_;
  std::vector<std::vector<CoaptedPiece>> pieces_;
};

// Returns the coapted samples of all triangles; fills `share` and the area.
Coapted sample(const Model &model, const std::vector<Vec3> &x, const Surface &surface,
               FacingWeight &facing, Coaptation &coaptation) {
  const Valve &valve = model.valve;
  Coapted samples(valve.leaflets.size());
  for (uint32_t t = 0; t < valve.triangles.size(); ++t) {
    const Tri &c = valve.triangles[t];
    double sum = 0;
    const size_t parts = coaptation_parts(model, t);
    const double area = surface.area[t] / static_cast<double>(parts * parts);
    if (facing.begin(t)) {
      FacingPoints centres;
      for_each_part(parts, [&](const std::array<double, 3> &w) {
        centres.add(w[0] * x[c[0]] + w[1] * x[c[1]] + w[2] * x[c[2]]);
      });
      const std::span<const Faced> all = facing.of_points(centres);
      for (size_t k = 0; k < all.size(); ++k) {
        sum += all[k].weight;
        for (const FacedLeaflet &f : all[k].leaflets) {
          // each side contributes half of the area of one side
          const Vec3 centre(centres.x[k], centres.y[k], centres.z[k]);
          samples.of(valve.triangle_leaflet[t], f.leaflet)
              .push_back({0.5 * (centre + f.point), surface.normal[t] - f.normal,
                          0.5 * area * all[k].weight * f.share});
        }
      }
    }
    coaptation.share.push_back(sum / static_cast<double>(parts * parts));
    coaptation.area += 0.5 * area * sum;
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
                                       Coapted &samples, const Frame &frame) {
  const Loop annulus(model.valve.annulus, x);
  const Vec3 axis = frame.axes.row(2);
  const uint32_t leaflets = static_cast<uint32_t>(model.valve.leaflets.size());
  std::vector<CoaptationLine> lines;
  for (uint32_t l = 0; l < leaflets; ++l) {
    for (uint32_t r = leaflets > 1 ? l + 1 : l; r < leaflets; ++r) {
      const std::vector<CoaptedPiece> &pieces = samples.of(l, r);
      if (pieces.empty()) continue;
      const Vec3 pole = find_pole(model, annulus, {l, r}, mean_of(pieces));
      lines.push_back(find_coaptation_line(pieces, pole, axis, station_spacing(model)));
      lines.back().leaflets = {l, r};
    }
  }
  return lines;
}

// Share of the area of all lines below which a line counts less and less: where two leaflets begin
// to meet, their line has a length at once, but hardly any area.
constexpr double whole_line = 0.01;

void summarise(const std::vector<CoaptationLine> &lines, Coaptation &coaptation) {
  double all = 0, area = 0, length = 0;
  for (const CoaptationLine &line : lines) all += line.area;
  const auto presence = [&](const CoaptationLine &line) {
    return std::min(1.0, line.area / (whole_line * all));
  };
  for (const CoaptationLine &line : lines) {
    coaptation.line.insert(coaptation.line.end(), line.stations.begin(), line.stations.end());
    coaptation.line_end.push_back(static_cast<uint32_t>(coaptation.line.size()));
    coaptation.line_leaflets.push_back(line.leaflets);
    coaptation.profile.push_back(line.profile);
    area += line.area;
    length += presence(line) * line.length;
    coaptation.length_max = std::max(coaptation.length_max, line.longest);
  }
  if (length > 0) coaptation.length_mean = area / length;
  coaptation.length_min = lines.empty() ? 0 : std::numeric_limits<double>::infinity();
  for (const CoaptationLine &line : lines) {
    const double there = presence(line), mean = coaptation.length_mean;
    const double shortest = there < 1 ? mean + there * (line.shortest - mean) : line.shortest;
    coaptation.length_min = std::min(coaptation.length_min, shortest);
  }
}

}  // namespace

Coaptation measure_coaptation(const Model &model, const std::vector<Vec3> &x) {
  const Surface surface = surface_of(model.valve.triangles, x);
  const FacingTree tree(model, x, surface);
  const FacingSurface nearest(model, x, surface, tree);
  const Frame frame = valve_frame(model, x);
  Coaptation coaptation;
  for (uint32_t node = 0; node < x.size(); ++node) {
    const bool on_sheet = surface.node_normal[node] != Vec3::Zero();
    coaptation.distance.push_back(on_sheet ? nearest.of_node(node).distance
                                           : std::numeric_limits<double>::infinity());
  }
  FacingWeight facing(model, x, surface, tree);
  Coapted samples = sample(model, x, surface, facing, coaptation);
  summarise(find_lines(model, x, samples, frame), coaptation);
  measure_central_section(model, frame.local(x), x, facing, coaptation);
  return coaptation;
}

}  // namespace mvs::core
