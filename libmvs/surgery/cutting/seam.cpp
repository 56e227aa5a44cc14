// Matches the two sides of a cut by their shares of length, as surgeons do with two edges of
// different length, and joins them by sutures.
#include "surgery/cutting/seam.h"

#include <mvs/snapshot.h>

#include <algorithm>

#include "surgery/cutting/split.h"

namespace mvs::core {
namespace {

// Polypropylene monofilament 5-0 (0.10 to 0.15 mm, USP) with 1.5 GPa: 18 N per unit strain. Between
// sutures 1 to 2 mm apart a leaflet pulls with about 0.3 N (pressure times radius times spacing),
// which stretches a suture by 2 %.
constexpr double seam_young = 1.5e9, seam_area = 1.2e-8;
// Suture length over contact thickness: a gap of up to 1 does not leak (measure/orifice/METHOD.md),
// 0.85 leaves room for the stretch; with shorter sutures the rims would repel each other.
constexpr double seam_length = 0.85;
// Nodes of both sides closer than this share of the node distance are joined.
constexpr double same_place = 0.4;

// One side of a cut, from the node where the sides part.
struct CutSide {
  std::vector<uint32_t> node;
  std::vector<double> share;  // of its length, 0 to 1

  double gap() const { return 1.0 / static_cast<double>(node.size() - 1); }
};

CutSide side_of(const std::vector<Vec3> &rest, std::vector<uint32_t> nodes) {
  CutSide side{std::move(nodes), {0}};
  for (size_t k = 1; k < side.node.size(); ++k) {
    side.share.push_back(side.share.back() + (rest[side.node[k]] - rest[side.node[k - 1]]).norm());
  }
  for (double &share : side.share) share /= side.share.back();
  side.share.back() = 1;
  return side;
}

// Adds a node before the k-th node of a side, at a share of the side, but not too near to its
// neighbours.
void add_before(Surgery &s, CutSide &side, size_t k, double share) {
  const double low = side.share[k - 1], high = side.share[k];
  const double along = std::clamp((share - low) / (high - low), 0.25, 0.75);
  const uint32_t node = split_side(s, side.node[k - 1], side.node[k], along);
  const auto at = static_cast<std::ptrdiff_t>(k);
  side.node.insert(side.node.begin() + at, node);
  side.share.insert(side.share.begin() + at, low + along * (high - low));
}

// Adds nodes until node k of one side is opposite to node k of the other.
void match_nodes(Surgery &s, CutSide &a, CutSide &b) {
  const double near = same_place * std::min(a.gap(), b.gap());
  for (size_t k = 1; k < std::max(a.node.size(), b.node.size()); ++k) {
    const bool a_ends = k + 1 >= a.node.size(), b_ends = k + 1 >= b.node.size();
    if (a_ends && b_ends) break;
    const double off = a.share[k] - b.share[k];
    if (!a_ends && !b_ends && std::abs(off) < near) continue;
    if (a_ends || (!b_ends && off > 0)) {
      add_before(s, a, k, b.share[k]);
    } else {
      add_before(s, b, k, a.share[k]);
    }
  }
}

}  // namespace

uint32_t sew(Surgery &s, const CutLine &line, size_t turn, const std::string &name) {
  const auto middle = line.begin() + static_cast<std::ptrdiff_t>(turn);
  CutSide a =
      side_of(s.valve.rest, {line.rend() - static_cast<std::ptrdiff_t>(turn) - 1, line.rend()});
  CutSide b = side_of(s.valve.rest, {middle, line.end()});
  match_nodes(s, a, b);
  uint32_t number = 1, count = 0;
  for (size_t k = 1; k < a.node.size(); ++k) {
    while (has_chord_named(s, name + std::to_string(number))) ++number;
    add_suture(s, {name + std::to_string(number++), a.node[k], b.node[k],
                   seam_length * s.valve.contact_thickness, seam_young, seam_area});
    ++count;
  }
  return count;
}

}  // namespace mvs::core
