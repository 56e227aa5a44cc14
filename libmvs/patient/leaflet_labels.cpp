// Sums over the annulus, and the heaviest arc of them.
#include "patient/leaflet_labels.h"

#include <algorithm>

#include "base/error.h"
#include "model/sides.h"
#include "patient/findings.h"

namespace mvs::core {
namespace {

// Share of the labelled area on its own side of the border. Labels that a network swapped at the
// commissures reach 0.9, random ones 0.5.
constexpr double least_agreement = 0.7;

// The arc of samples with the largest sum.
std::array<size_t, 2> heaviest_arc(const std::vector<double> &balance) {
  const size_t n = balance.size();
  std::array<size_t, 2> best = {0, 0};
  double most = 0;
  for (size_t first = 0; first < n; ++first) {
    double sum = 0;
    for (size_t count = 1; count < n; ++count) {
      sum += balance[(first + count - 1) % n];
      if (sum > most) {
        most = sum;
        best = {first, first + count};
      }
    }
  }
  return best;
}

}  // namespace

LabelledArea labelled_area(const LeafletSheet &sheet, const SheetCoordinates &c, size_t samples) {
  LabelledArea area;
  area.balance.assign(samples, 0);
  for (size_t t = 0; t < sheet.triangles.size(); ++t) {
    if (t >= sheet.label.size() || sheet.label[t] == LeafletLabel::unknown) continue;
    const Tri &tri = sheet.triangles[t];
    const double part = triangle_area(sheet.x, tri);
    const double foot = triangle_foot(c, tri);
    const bool anterior = sheet.label[t] == LeafletLabel::anterior;
    (anterior ? area.anterior : area.posterior) += part;
    const size_t cell = static_cast<size_t>(foot / c.annulus_length * static_cast<double>(samples));
    area.balance[std::min(samples - 1, cell)] += anterior ? part : -part;
  }
  return area;
}

std::array<double, 2> commissures_of_labels(const LabelledArea &area, double length,
                                            Findings &findings) {
  const size_t samples = area.balance.size();
  const double total = area.anterior + area.posterior;
  MVS_MUST(std::min(area.anterior, area.posterior) > 0.02 * total, MVS_E_OP, "triangle_leaflet",
           "the labels show one leaflet only: the anterior one has %.0f mm2, the posterior one "
           "%.0f mm2; label both, or leave the labels out and give the commissures",
           area.anterior * 1e6, area.posterior * 1e6);
  const auto [first, last] = heaviest_arc(area.balance);
  double right = area.posterior;  // agreement: posterior tissue outside and anterior inside the arc
  for (size_t k = first; k < last; ++k) right += area.balance[k % samples];
  MVS_MUST(right >= least_agreement * total, MVS_E_OP, "triangle_leaflet",
           "the labels do not show two leaflets: only %.0f %% of the labelled area lies on its own "
           "side of the best border between them; label each leaflet from the annulus to the free "
           "edge, or leave the labels out and give the commissures",
           100 * right / total);
  const double width = length / static_cast<double>(samples);
  findings.push_back(
      {"commissures",
       FindingSource::measured,
       std::clamp(right / total, 0.0, 1.0),
       format("where the labels of the leaflets meet; %.0f %% of the labelled area agree with this "
              "border",
              100 * right / total),
       {},
       ""});
  return {static_cast<double>(first) * width, static_cast<double>(last) * width};
}

}  // namespace mvs::core
