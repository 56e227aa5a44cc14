// Operation clip: edge-to-edge repair by rows of stitches between two free edges.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/math.h"
#include "surgery/leaflet/free_edge.h"
#include "surgery/surgery.h"

namespace mvs::core {
namespace {

constexpr double default_width = 5e-3, default_reach = 4e-3;

// Braided polyester 4-0 (OPERATIONS.md): 0.17 mm, 3 GPa.
constexpr double clip_suture_young = 3e9, clip_suture_diameter = 0.17e-3;

struct Pair {
  uint32_t a, b;
};

// The two leaflets near the clip.
struct ClipLeaflets {
  std::vector<EdgeNode> anterior, posterior;
};

struct Place {
  double along, depth;
  double away(const EdgeNode &n) const { return math::hypot(n.along - along, n.depth - depth); }
};

// The turn of a clip about the normal of the leaflets, laid flat side by side, into the atrium.
// Along the edge counts alike on both sides, depth from it in opposite directions, so that in these
// coordinates the two sides of a clip turn in opposite senses. An angle of 0 keeps the bits.
struct Turn {
  double cosine, sine;
  explicit Turn(double angle) : cosine(math::cos(angle)), sine(math::sin(angle)) {}
  Place anterior(const Place &p) const {
    return {cosine * p.along + sine * p.depth, cosine * p.depth - sine * p.along};
  }
  Place posterior(const Place &p) const {
    return {cosine * p.along - sine * p.depth, cosine * p.depth + sine * p.along};
  }
};

// Returns the nearest unused node; places at the free edge use its nodes only.
const EdgeNode *nearest(const std::vector<EdgeNode> &nodes, const Place &place, bool on_edge,
                        const std::vector<uint8_t> &taken) {
  const EdgeNode *best = nullptr;
  for (const EdgeNode &n : nodes) {
    if (taken[n.node] || (n.depth == 0) != on_edge) continue;
    if (!best || place.away(n) < place.away(*best)) best = &n;
  }
  return best;
}

// Returns the stitches in rows from the free edge inwards, each from its middle outwards, `gap`
// apart. A place gets the nearest anterior node and the posterior node opposite to it; it is left
// out if the mesh has no such nodes within half a gap (more in a turned clip), except for the
// first, which is always joined.
std::vector<Pair> pairs_in_rows(const ClipLeaflets &sides, size_t node_count, double width,
                                double reach, double gap, const Turn &turn) {
  std::vector<uint8_t> taken(node_count, 0);
  std::vector<Pair> pairs;
  const int stitch_rows = static_cast<int>(reach / gap + 1e-9);
  const int columns = static_cast<int>(width / 2 / gap + 1e-9);
  // rows across the free edge run along those of the mesh, turned ones between its nodes
  const double reach_of_node = (0.5 + 0.5 * std::abs(turn.sine)) * gap;
  for (int row = 0; row <= stitch_rows; ++row) {
    for (int k = 0; k <= 2 * columns; ++k) {
      const int column = k % 2 ? (k + 1) / 2 : -k / 2;  // 0, 1, -1, 2, -2
      const Place in_clip{column * gap, row * gap};
      const Place place = turn.anterior(in_clip);
      const EdgeNode *a = nearest(sides.anterior, place, place.depth < 0.5 * gap, taken);
      if (!a) continue;
      // back into the clip, and out on its other side
      const Place opposite = turn.posterior(turn.posterior({a->along, a->depth}));
      const bool edge = turn.posterior(in_clip).depth < 0.5 * gap;
      const EdgeNode *b = nearest(sides.posterior, opposite, edge, taken);
      if (!b) continue;
      const bool near = place.away(*a) <= reach_of_node && opposite.away(*b) <= reach_of_node;
      if (!near && !pairs.empty()) continue;
      taken[a->node] = taken[b->node] = 1;
      pairs.push_back({a->node, b->node});
    }
  }
  return pairs;
}

// Returns whether a chord or the stitch of a clip has this name.
bool is_clip_name(const Surgery &s, const std::string &name) {
  const std::vector<Chord> &chords = s.valve.chords;
  return std::any_of(chords.begin(), chords.end(), [&](const Chord &c) {
    return c.name == name || c.name.starts_with(name + "/");
  });
}

// Returns "clip", or "clip2" if that is used; throws if the given name is used.
std::string free_clip_name(const Surgery &s, const char *given) {
  if (given && *given) {
    MVS_MUST(!is_clip_name(s, given), MVS_E_OP, std::string("chord ") + given,
             "clip: there is a chord or clip named %s: choose another name", given);
    return given;
  }
  std::string name = "clip";
  for (int number = 2; is_clip_name(s, name); ++number) name = "clip" + std::to_string(number);
  return name;
}

void sew_pairs(Surgery &s, const std::vector<Pair> &pairs, const std::string &name) {
  for (size_t k = 0; k < pairs.size(); ++k) {
    must_not_be_tied(s, pairs[k].a, pairs[k].b);
    const Id id =
        add_suture(s, {k == 0 ? name : name + "/" + std::to_string(k + 1), pairs[k].a, pairs[k].b,
                       s.valve.contact_thickness, clip_suture_young,
                       std::numbers::pi / 4 * clip_suture_diameter * clip_suture_diameter});
    if (k == 0) s.made = id;
  }
}

// Returns where the origin of `from_clip` lies on the free edge of its scallop: "3.0 mm towards
// A1", from the middle of the scallop at rest towards the next one of the leaflet, or to a
// commissure.
std::string place_in_words(const Surgery &s, uint32_t scallop,
                           const std::vector<EdgeNode> &from_clip) {
  const Valve &valve = s.before.valve;
  const std::vector<EdgeNode> from_middle = nodes_from_free_edge(s, scallop, 0.5);
  const double off = from_middle.front().along - from_clip.front().along;
  const double sense = off < 0 ? -1 : 1;
  std::vector<double> along(s.before.node_count(), std::nan(""));
  for (const EdgeNode &n : from_middle)
    if (n.depth == 0) along[n.node] = sense * n.along;
  // mean places of the scallops on the free edge, towards that side
  std::vector<double> sum(valve.scallops.size(), 0), count(valve.scallops.size(), 0);
  for (size_t t = 0; t < valve.triangles.size(); ++t) {
    const uint32_t of = valve.triangle_scallop[t];
    if (of == none) continue;
    for (const uint32_t node : valve.triangles[t]) {
      if (std::isnan(along[node])) continue;
      sum[of] += along[node];
      count[of] += 1;
    }
  }
  const auto place = [&](uint32_t k) { return sum[k] / count[k]; };
  uint32_t next = none;
  for (uint32_t k = 0; k < valve.scallops.size(); ++k) {
    const bool other = k != scallop && valve.scallops[k].leaflet == valve.scallops[scallop].leaflet;
    if (!other || count[k] == 0 || place(k) <= place(scallop)) continue;
    if (next == none || place(k) < place(next)) next = k;
  }
  const char *side = off < 0 ? "the posteromedial side" : "the anterolateral side";
  return format("%.1f mm towards %s", 1e3 * std::abs(off),
                next == none ? side : valve.scallops[next].name.c_str());
}

}  // namespace

void operate(Surgery &s, const mvs_op_clip &op) {
  const uint32_t a = scallop_or(s, op.anterior, "A2"), p = scallop_or(s, op.posterior, "P2");
  const std::vector<Scallop> &scallops = s.before.valve.scallops;
  MVS_MUST(scallops[a].leaflet != scallops[p].leaflet, MVS_E_OP, "scallop " + scallops[p].name,
           "clip: scallops %s and %s belong to the same leaflet: name one of each",
           scallops[a].name.c_str(), scallops[p].name.c_str());
  const double share = 0.5 * (1 + op.position);
  const ClipLeaflets sides{nodes_from_free_edge(s, a, share), nodes_from_free_edge(s, p, share)};
  const double width = op.width != 0 ? op.width : default_width;
  const double reach = op.reach != 0 ? op.reach : default_reach;
  // two sheets thick, so that no fold opens between two stitches
  const double gap = 2 * s.valve.contact_thickness;
  const std::vector<Pair> pairs =
      pairs_in_rows(sides, s.before.node_count(), width, reach, gap, Turn(op.angle));
  const std::string name = free_clip_name(s, op.name);
  sew_pairs(s, pairs, name);
  open_the_valve(s);
  s.title = format("Join %s and %s by %s, ", scallops[a].name.c_str(), scallops[p].name.c_str(),
                   name.c_str());
  s.title += pairs.size() == 1 ? "1 stitch"
                               : format("%zu stitches over %.1f mm", pairs.size(), 1e3 * width);
  if (op.position != 0) s.title += ", " + place_in_words(s, a, sides.anterior);
  if (op.angle != 0)
    s.title += format(", turned by %.0f degrees", 180 / std::numbers::pi * op.angle);
}

}  // namespace mvs::core
