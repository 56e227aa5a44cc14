// Instruments with abrupt motion: pulled 50 mm at once, pushed through the sheet at 1 m/s.
#include <mvs/tool.hpp>

#include "tests/stability/case.h"

namespace stability {
namespace {

using Point = std::array<double, 3>;

// A point in the frame of the valve: along AP, CC and into the atrium from the annulus centroid.
Point at(const mvs::Snapshot &valve, double ap, double cc, double up) {
  const auto f = valve.frame();
  Point p;
  for (size_t k = 0; k < 3; ++k) p[k] = f[k] + ap * f[3 + k] + cc * f[6 + k] + up * f[9 + k];
  return p;
}

// The free leaflet node farthest along the AP axis, on the free edge.
uint32_t edge_node(const mvs::Snapshot &valve) {
  const auto edge = valve.view<uint32_t>(MVS_ARRAY_FREE_EDGE_NODES);
  const auto kinds = valve.view<uint8_t>(MVS_ARRAY_NODE_KIND);
  const auto x = valve.view<double>(MVS_ARRAY_NODE_POSITION);
  const auto f = valve.frame();
  double most = -1;
  uint32_t found = edge.data()[0];
  for (const uint32_t n : edge) {
    double along = 1;
    for (size_t k = 0; k < 3; ++k) along += f[3 + k] * (x.row(n)[k] - f[k]);
    if (kinds.data()[n] != MVS_NODE_KIND_LEAFLET || along < most) continue;
    most = along;
    found = n;
  }
  return found;
}

// Pulls an edge of the anterior leaflet by a vector in the frame of the valve, in one step, and
// releases it.
Case pulled(const std::string &name, double ap, double up) {
  return {"tools/" + name, [=](Watch &w) {
            const mvs::Snapshot valve = w.sim().snapshot();
            const uint32_t node = edge_node(valve);
            const double *x = valve.view<double>(MVS_ARRAY_NODE_POSITION).row(node);
            mvs_tool_desc grasp = mvs::sized<mvs_tool_desc>();
            grasp.kind = MVS_TOOL_KIND_GRASP;
            grasp.by_node = 1;
            grasp.node = node;
            for (size_t k = 0; k < 3; ++k) grasp.position[k] = x[k];
            mvs_id tool = 0;
            if (!w.attempt(mvs_add_tool(w.sim().get(), &grasp, &tool))) return;
            const Point from = at(valve, 0, 0, 0), to = at(valve, ap, 0, up);
            Point hand;
            for (size_t k = 0; k < 3; ++k) hand[k] = x[k] + to[k] - from[k];
            w.attempt(mvs_move_tool(w.sim().get(), tool, hand.data(), nullptr));
            w.changed();
            w.rest();
            w.attempt(mvs_remove_tool(w.sim().get(), tool));
            w.changed();
            w.rest();
          }};
}

// A ball from the atrium into the ventricle and back, 1 mm a step of 1 ms.
void ball(Watch &watch) {
  const mvs::Snapshot valve = watch.sim().snapshot();
  mvs_tool_desc desc = mvs::sized<mvs_tool_desc>();
  desc.kind = MVS_TOOL_KIND_BALL;
  const Point start = at(valve, 5e-3, 0, 20e-3);
  for (size_t k = 0; k < 3; ++k) desc.position[k] = start[k];
  mvs_id tool = 0;
  if (!watch.attempt(mvs_add_tool(watch.sim().get(), &desc, &tool))) return;
  for (int k = 1; k <= 100; ++k) {
    const double height = 20e-3 - 1e-3 * (k <= 50 ? k : 100 - k);
    watch.attempt(
        mvs_move_tool(watch.sim().get(), tool, at(valve, 5e-3, 0, height).data(), nullptr));
    watch.changed();
    watch.step(1e-3);
  }
  watch.attempt(mvs_remove_tool(watch.sim().get(), tool));
  watch.changed();
  watch.rest();
}

}  // namespace

std::vector<Case> tool_cases() {
  Case pushed{"tools/ball_through_at_1_m_s", ball};
  pushed.modes = {SolverMode::live};
  return {pulled("grasp_50mm_up", 0, 50e-3), pulled("grasp_50mm_through_the_other", -50e-3, 0),
          pushed};
}

}  // namespace stability
