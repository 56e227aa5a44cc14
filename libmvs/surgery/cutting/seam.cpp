// The sides are matched by their share of each side's length, as a surgeon does who evens out two
// edges of different length along the suture line.
#include "surgery/cutting/seam.h"

#include <mvs/snapshot.h>

#include <algorithm>

#include "surgery/cutting/split.h"

namespace mvs::core {
namespace {

// A monofilament of polypropylene, 5-0 (0.10 to 0.15 mm, USP), at 1.5 GPa: 18 N per unit strain.
// Between sutures 1 to 2 mm apart a leaflet pulls with about 0.3 N (pressure times radius times
// spacing), which stretches it by 2 %.
constexpr double suture_young = 1.5e9, suture_area = 1.2e-8;
// Of the contact thickness: a gap of up to one does not leak (measure/orifice/README.md), this leaves room
// for the stretch; nearer, the rims would push each other away.
constexpr double suture_length = 0.85;
// Nodes of both sides closer than this share of the distance of nodes are sewn to each other.
constexpr double same_place = 0.4;

// One side of a cut, from where the sides part.
struct Side {
  std::vector<uint32_t> node;
  std::vector<double> share;  // of its length, 0 to 1

  double gap() const { return 1.0 / static_cast<double>(node.size() - 1); }
};

Side side_of(const std::vector<Vec3> &rest, std::vector<uint32_t> nodes) {
  Side side{std::move(nodes), {0}};
  for (size_t k = 1; k < side.node.size(); ++k) {
    side.share.push_back(side.share.back() + (rest[side.node[k]] - rest[side.node[k - 1]]).norm());
  }
  for (double &share : side.share) share /= side.share.back();
  side.share.back() = 1;
  return side;
}

// Adds a node to a side before its k-th, at a share of the whole side, but not too near to the
// next.
void add_before(Surgery &s, Side &side, size_t k, double share) {
  const double low = side.share[k - 1], high = side.share[k];
  const double along = std::clamp((share - low) / (high - low), 0.25, 0.75);
  const uint32_t node = split_side(s, side.node[k - 1], side.node[k], along);
  const auto at = static_cast<std::ptrdiff_t>(k);
  side.node.insert(side.node.begin() + at, node);
  side.share.insert(side.share.begin() + at, low + along * (high - low));
}

// Goes along both sides and makes node k of one belong to node k of the other.
void match(Surgery &s, Side &a, Side &b) {
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

std::string free_name(const Valve &valve, const std::string &name, uint32_t &number) {
  for (;;) {
    std::string tried = name + std::to_string(number++);
    const auto taken = [&](const Chord &chord) { return chord.name == tried; };
    const std::vector<Chord> &chords = valve.chords;
    if (std::none_of(chords.begin(), chords.end(), taken)) return tried;
  }
}

}  // namespace

uint32_t sew(Surgery &s, const CutLine &line, size_t turn, const std::string &name) {
  const auto middle = line.begin() + static_cast<std::ptrdiff_t>(turn);
  Side a =
      side_of(s.valve.rest, {line.rend() - static_cast<std::ptrdiff_t>(turn) - 1, line.rend()});
  Side b = side_of(s.valve.rest, {middle, line.end()});
  match(s, a, b);
  uint32_t number = 1, count = 0;
  for (size_t k = 1; k < a.node.size(); ++k) {
    Chord suture;
    suture.id = s.new_id();
    suture.name = free_name(s.valve, name, number);
    suture.a = a.node[k];
    suture.b = b.node[k];
    suture.kind = MVS_CHORD_KIND_SUTURE;
    suture.rest_length = suture_length * s.valve.contact_thickness;
    suture.young = suture_young;
    suture.area = suture_area;
    s.valve.chords.push_back(std::move(suture));
    ++count;
  }
  return count;
}

}  // namespace mvs::core
