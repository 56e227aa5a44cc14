// Heights of the leaflets in section planes, the distance to the septum, the pressure drop of a
// flow.
#include "measure/cost/outflow.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "measure/coaptation/coaptation_parts.h"
#include "measure/coaptation/facing_weight.h"
#include "measure/cost/central_profile.h"
#include "measure/cost/section_planes.h"

namespace mvs::core {
namespace {

constexpr double unknown_length = std::numeric_limits<double>::quiet_NaN();

// The first point of a profile that faces other tissue with a weight of at least one half, as in
// central_section, and the length up to it.
struct Begin {
  double length = unknown_length;
  std::optional<Vec3> point;
};

Begin find_coaptation(const Model &model, const std::vector<ProfilePiece> &profile,
                      FacingWeight &facing) {
  double length = 0;
  for (const ProfilePiece &piece : profile) {
    const double whole = (piece.to - piece.from).norm();
    if (!facing.begin(piece.triangle)) {
      length += whole;
      continue;
    }
    const size_t parts = coaptation_parts(model, piece.triangle);
    const auto along = [&](double k) { return k / static_cast<double>(parts); };
    FacingPoints points;
    for (size_t k = 0; k <= parts; ++k) {
      points.add(piece.from + along(static_cast<double>(k)) * (piece.to - piece.from));
    }
    const FacingPoints::Row weight = facing.weights_of(points);
    for (size_t k = 0; k <= parts; ++k) {
      if (weight[k] < 0.5) continue;
      // linear from the point before; the first point of a piece is taken as it is
      const double back = k == 0 ? 0 : (weight[k] - 0.5) / (weight[k] - weight[k - 1]);
      const double share = along(static_cast<double>(k) - back);
      return {length + share * whole, piece.from + share * (piece.to - piece.from)};
    }
    length += whole;
  }
  return {};
}

// The weighted mean of those values that are known; NaN without any.
class MeanOfKnown {
 public:
  void add(double value, double weight) {
    if (std::isnan(value)) return;
    sum_ += weight * value;
    weight_ += weight;
  }
  double value() const { return weight_ > 0 ? sum_ / weight_ : unknown_length; }

 private:
  double sum_ = 0, weight_ = 0;
};

double height_of(const Model &model, const Seams &seams, bool anterior) {
  const std::vector<Vec3> &rest = model.valve.rest;
  const SeamsOf leaflets = anterior ? SeamsOf::anterior : SeamsOf::posterior;
  MeanOfKnown height;
  for (const auto &[offset, weight] : section_planes(model, rest, seams, leaflets)) {
    height.add(length_of(central_profile(model, rest, anterior, offset)), weight);
  }
  return height.value();
}

// Where the coaptation begins on both leaflets in one plane.
struct Section {
  Begin anterior, posterior;
  double weight;
  bool coapts() const { return anterior.point && posterior.point; }
};

// One section, or one on either side of a seam. Where only one of these coapts, it stands for both:
// the lengths of both leaflets are to be of the same places.
std::vector<Section> sections_of(const Model &model, const std::vector<Vec3> &x,
                                 const Seams &seams) {
  const Surface surface = surface_of(model.valve.triangles, x);
  const FacingTree tree(model, x, surface);
  FacingWeight facing(model, x, surface, tree);
  facing.leave_out_folds();
  std::vector<Section> sections;
  for (const auto &[offset, weight] : section_planes(model, x, seams, SeamsOf::both)) {
    sections.push_back({find_coaptation(model, central_profile(model, x, true, offset), facing),
                        find_coaptation(model, central_profile(model, x, false, offset), facing),
                        weight});
  }
  const auto coapts = [](const Section &section) { return section.coapts(); };
  if (std::any_of(sections.begin(), sections.end(), coapts)) {
    std::erase_if(sections, [&](const Section &section) { return !coapts(section); });
  }
  return sections;
}

}  // namespace

std::optional<Vec3> Outflow::nearest_of(const std::vector<Vec3> &septum) const {
  if (!coaptation || septum.empty()) return std::nullopt;
  return *std::min_element(septum.begin(), septum.end(), [&](const Vec3 &a, const Vec3 &b) {
    return (a - *coaptation).norm() < (b - *coaptation).norm();
  });
}

Outflow measure_outflow(const Model &model, const std::vector<Vec3> &x) {
  const Seams seams = find_seams(model);
  MeanOfKnown anterior, posterior;
  Vec3 sum = Vec3::Zero();
  double weight = 0;
  for (const Section &section : sections_of(model, x, seams)) {
    anterior.add(section.anterior.length, section.weight);
    posterior.add(section.posterior.length, section.weight);
    if (!section.coapts()) continue;
    sum += section.weight * 0.5 * (*section.anterior.point + *section.posterior.point);
    weight += section.weight;
  }
  Outflow outflow = {height_of(model, seams, true), height_of(model, seams, false),
                     anterior.value(), posterior.value(), std::nullopt};
  if (weight > 0) outflow.coaptation = sum / weight;
  return outflow;
}

}  // namespace mvs::core
