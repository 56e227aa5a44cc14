// Planes beside the central one where that runs along a seam.
#include "measure/cost/section_planes.h"

#include <algorithm>

#include "measure/annulus/frame.h"
#include "measure/annulus/landmarks.h"

namespace mvs::core {
namespace {

// A range along CC.
struct Span {
  double low, high;
};

// The range of each seam, with one contact thickness more on either side.
std::vector<Span> spans_of(const Model &model, const std::vector<Vec3> &x, const Seams &seams,
                           SeamsOf leaflets) {
  std::vector<Span> spans;
  const Frame frame = valve_frame(model, x);
  const uint32_t anterior = anterior_leaflet(model.valve);
  const double beside = model.valve.contact_thickness;
  for (const std::vector<uint32_t> &seam : seams.nodes) {
    const SeamsOf of =
        leaflet_of_seam(model, seam) == anterior ? SeamsOf::anterior : SeamsOf::posterior;
    if (leaflets != SeamsOf::both && leaflets != of) continue;
    const double at = frame.local(x[seam[0]])[1];
    Span span = {at, at};
    for (const uint32_t node : seam) {
      const double across = frame.local(x[node])[1];
      span = {std::min(span.low, across), std::max(span.high, across)};
    }
    spans.push_back({span.low - beside, span.high + beside});
  }
  return spans;
}

}  // namespace

std::vector<SectionPlane> section_planes(const Model &model, const std::vector<Vec3> &x,
                                         const Seams &seams, SeamsOf leaflets) {
  std::vector<SectionPlane> central = {{0, 1}};
  if (seams.nodes.empty()) return central;
  std::vector<Span> spans = spans_of(model, x, seams, leaflets);
  // a plane beside one seam may meet the next one: each span is taken once at most
  Span taken = {0, 0};
  for (bool grows = true; grows;) {
    const size_t count = spans.size();
    std::erase_if(spans, [&](const Span &span) {
      if (span.low > taken.high || span.high < taken.low) return false;
      taken = {std::min(taken.low, span.low), std::max(taken.high, span.high)};
      return true;
    });
    grows = spans.size() < count;
  }
  const double width = taken.high - taken.low;
  if (width == 0) return central;
  return {{taken.low, taken.high / width}, {taken.high, -taken.low / width}};
}

}  // namespace mvs::core
