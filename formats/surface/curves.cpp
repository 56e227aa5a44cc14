// Order of points along curves: chains of the segments of a file, which may list them in any order
// and direction, as an extraction of boundary edges does.
#include "formats/surface/parts.h"

namespace mvs::core {
namespace {

// The neighbours of a point on curves that neither branch nor cross.
struct CurveLinks {
  uint32_t next[2] = {none, none};

  bool add(uint32_t point) {
    if (next[0] == point || next[1] == point) return true;
    uint32_t &free = next[0] == none ? next[0] : next[1];
    if (free != none) return false;
    free = point;
    return true;
  }
};

// Links between neighbours of all curves; empty if a point has more than two.
std::vector<CurveLinks> curve_links(const SurfaceParts &parts) {
  std::vector<CurveLinks> links(parts.points.size());
  for (size_t c = 0; c < parts.path_start.size(); ++c) {
    const size_t end =
        c + 1 < parts.path_start.size() ? parts.path_start[c + 1] : parts.path.size();
    for (size_t k = parts.path_start[c] + 1; k < end; ++k) {
      const uint32_t a = parts.path[k - 1], b = parts.path[k];
      if (a != b && !(links[a].add(b) && links[b].add(a))) return {};
    }
  }
  return links;
}

// The points in their order, each at most once.
struct PointOrder {
  std::vector<uint32_t> order;
  std::vector<uint8_t> taken;

  explicit PointOrder(size_t points) : taken(points, 0) {}
  bool take(uint32_t point) {
    if (taken[point]) return false;
    taken[point] = 1;
    order.push_back(point);
    return true;
  }
  void walk(const std::vector<CurveLinks> &links, uint32_t point) {
    while (point != none && take(point)) {
      const CurveLinks &here = links[point];
      const bool first_is_new = here.next[0] != none && !taken[here.next[0]];
      point = first_is_new ? here.next[0] : here.next[1];
    }
  }
};

}  // namespace

std::vector<uint32_t> order_along_curves(const SurfaceParts &parts) {
  const std::vector<CurveLinks> links = curve_links(parts);
  PointOrder points(parts.points.size());
  if (!links.empty()) {
    // open curves from the end that the file names first, then closed ones
    for (const uint32_t point : parts.path) {
      if (links[point].next[1] == none) points.walk(links, point);
    }
    for (const uint32_t point : parts.path) points.walk(links, point);
  }
  for (const uint32_t point : parts.path) points.take(point);
  for (uint32_t point = 0; point < parts.points.size(); ++point) points.take(point);
  return std::move(points.order);
}

}  // namespace mvs::core
