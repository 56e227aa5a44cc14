// Operation resect: removes a piece of leaflet and sutures the gap.
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "geometry/distance.h"
#include "model/sides.h"
#include "surgery/cutting/plicate.h"
#include "surgery/cutting/resect_plan.h"
#include "surgery/cutting/seam.h"

namespace mvs::core {
namespace {

// Returns the node where the two sides of the cut part: the middle of its deepest part, measured
// from the line between its ends.
size_t turn_of(const Valve &valve, const CutLine &line) {
  const std::vector<Vec3> &rest = valve.rest;
  const auto depth = [&](size_t k) {
    return std::sqrt(
        closest_on_segment(rest[line[k]], rest[line.front()], rest[line.back()]).distance2);
  };
  std::vector<double> arc = {0};
  double deepest = 0;
  for (size_t k = 1; k < line.size(); ++k) {
    arc.push_back(arc.back() + (rest[line[k]] - rest[line[k - 1]]).norm());
    deepest = std::max(deepest, depth(k));
  }
  double first = arc.back(), last = 0;
  for (size_t k = 1; k + 1 < line.size(); ++k) {
    if (depth(k) < 0.9 * deepest) continue;
    first = std::min(first, arc[k]);
    last = std::max(last, arc[k]);
  }
  size_t turn = 1;
  for (size_t k = 1; k + 1 < line.size(); ++k) {
    if (std::abs(2 * arc[k] - first - last) < std::abs(2 * arc[turn] - first - last)) turn = k;
  }
  return turn;
}

void check_rest(const Surgery &s) {
  std::vector<uint8_t> left(s.valve.scallops.size(), 0), was(left);
  for (const uint32_t k : s.valve.triangle_scallop.get()) left[k] = 1;
  for (const uint32_t k : s.before.valve.triangle_scallop) was[k] = 1;
  for (size_t k = 0; k < left.size(); ++k) {
    MVS_MUST(left[k] || !was[k], MVS_E_OP, "scallop " + s.before.valve.scallops[k].name,
             "resect: the cut would remove all of %s: take a smaller piece",
             s.before.valve.scallops[k].name.c_str());
  }
  const std::vector<uint8_t> held = vertex_marks(s.valve.triangles, s.valve.rest.size());
  for (const uint32_t n : s.valve.annulus.get()) {
    MVS_MUST(held[n], MVS_E_OP, "annulus",
             "resect: the cut reaches the annulus: leave at least one row of triangles");
  }
}

double rest_area(const Valve &valve) {
  return surface_area(valve.rest, valve.triangles);
}

std::string title_of(const Surgery &s, const mvs_op_resect &op, const ResectPlan &plan) {
  const char *name = s.before.valve.scallops[plan.scallop].name.c_str();
  if (op.outline.count > 0) {
    return format("Resect a piece of %s along an outline, %.0f mm2", name,
                  1e6 * (rest_area(s.before.valve) - rest_area(s.valve)));
  }
  return format("Resect a %s of %s, %.1f mm wide and %.1f mm deep",
                op.base_width != 0 ? "quadrangle" : "triangle", name,
                op.width != 0 ? 1e3 * op.width : 8.0, 1e3 * plan.depth);
}

}  // namespace

void operate(Surgery &s, const mvs_op_resect &op) {
  ResectPlan plan = plan_resection(s, op);
  open_the_valve(s);
  if (op.base_width != 0) plicate(s, plan.annulus, op.base_width);
  const CutLine line = cut_out(s, plan.flat, plan.outline());
  check_rest(s);
  MVS_MUST(line.size() >= 3, MVS_E_OP, "outline",
           "resect: the cut is smaller than one triangle: take more");
  const uint32_t sutures =
      sew(s, line, turn_of(s.valve, line), s.before.valve.scallops[plan.scallop].name + " suture ");
  prune_chords(s);
  s.title = title_of(s, op, plan);
  const size_t lost = s.before.valve.chords.size() + sutures - s.valve.chords.size();
  if (lost > 0) s.title += format(", with the %zu chord segments that end there", lost);
}

}  // namespace mvs::core
