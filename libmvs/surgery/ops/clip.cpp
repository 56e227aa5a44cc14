// Two free edges are joined, edge to edge.
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

// Braided polyester 4-0 (README.md): 0.17 mm, 3 GPa.
constexpr double suture_young = 3e9, suture_diameter = 0.17e-3;

struct Pair {
  uint32_t a, b;
};

// The two leaflets near the clip.
struct Sides {
  std::vector<EdgeNode> anterior, posterior;
};

struct Place {
  double along, depth;
  double away(const EdgeNode &n) const { return math::hypot(n.along - along, n.depth - depth); }
};

// The node nearest to a place that is not taken yet; row 0 is the free edge itself.
const EdgeNode *nearest(const std::vector<EdgeNode> &nodes, const Place &place, bool on_edge,
                        const std::vector<uint8_t> &taken) {
  const EdgeNode *best = nullptr;
  for (const EdgeNode &n : nodes) {
    if (taken[n.node] || (n.depth == 0) != on_edge) continue;
    if (!best || place.away(n) < place.away(*best)) best = &n;
  }
  return best;
}

// Stitches in rows from the free edge inwards, each from its middle outwards, `gap` apart. A place
// gets the anterior node nearest to it and the posterior one that faces this node; where the mesh
// has none within half a gap, the place is left out, but the first is always joined.
std::vector<Pair> pairs_in_rows(const Sides &sides, size_t node_count, double width, double reach,
                                double gap) {
  std::vector<uint8_t> taken(node_count, 0);
  std::vector<Pair> pairs;
  const int rows = static_cast<int>(reach / gap + 1e-9);
  const int columns = static_cast<int>(width / 2 / gap + 1e-9);
  for (int row = 0; row <= rows; ++row) {
    for (int k = 0; k <= 2 * columns; ++k) {
      const int column = k % 2 ? (k + 1) / 2 : -k / 2;  // 0, 1, -1, 2, -2
      const Place place{column * gap, row * gap};
      const EdgeNode *a = nearest(sides.anterior, place, row == 0, taken);
      if (!a) continue;
      const EdgeNode *b = nearest(sides.posterior, {a->along, a->depth}, row == 0, taken);
      if (!b) continue;
      const bool near =
          place.away(*a) <= 0.5 * gap && Place{a->along, a->depth}.away(*b) <= 0.5 * gap;
      if (!near && !pairs.empty()) continue;
      taken[a->node] = taken[b->node] = 1;
      pairs.push_back({a->node, b->node});
    }
  }
  return pairs;
}

// Also by a stitch of another clip of this name.
bool has_chord(const Surgery &s, const std::string &name) {
  const std::vector<Chord> &chords = s.valve.chords;
  return std::any_of(chords.begin(), chords.end(), [&](const Chord &c) {
    return c.name == name || c.name.starts_with(name + "/");
  });
}

// "clip", or "clip2" where there is one already; a name that was given has to be free.
std::string free_name(const Surgery &s, const char *given) {
  if (given && *given) {
    MVS_MUST(!has_chord(s, given), MVS_E_OP, std::string("chord ") + given,
             "clip: there is a chord or clip named %s already: choose another name", given);
    return given;
  }
  std::string name = "clip";
  for (int number = 2; has_chord(s, name); ++number) name = "clip" + std::to_string(number);
  return name;
}

void sew(Surgery &s, const std::vector<Pair> &pairs, const std::string &name) {
  for (size_t k = 0; k < pairs.size(); ++k) {
    must_not_be_tied(s, pairs[k].a, pairs[k].b);
    Chord suture;
    suture.id = s.new_id();
    suture.name = k == 0 ? name : name + "/" + std::to_string(k + 1);
    suture.a = pairs[k].a;
    suture.b = pairs[k].b;
    suture.kind = MVS_CHORD_KIND_SUTURE;
    suture.rest_length = s.valve.contact_thickness;
    suture.young = suture_young;
    suture.area = std::numbers::pi / 4 * suture_diameter * suture_diameter;
    if (k == 0) s.made = suture.id;
    s.valve.chords.push_back(std::move(suture));
  }
}

// A stitch is sewn while the heart is arrested, a clip closes on leaflets that hang open. Pulled
// together from where they lie pressed on each other, the leaflets would have to fold: settling
// took hundreds of iterations and left creases that cross, from the open valve it takes about 26.
void open_the_valve(Surgery &s) {
  const State open = initial_state(s.before);
  s.state.x = open.x;
  s.state.v = open.v;
}

}  // namespace

void operate(Surgery &s, const mvs_op_clip &op) {
  const uint32_t a = scallop_or(s, op.anterior, "A2"), p = scallop_or(s, op.posterior, "P2");
  const std::vector<Scallop> &scallops = s.before.valve.scallops;
  MVS_MUST(scallops[a].leaflet != scallops[p].leaflet, MVS_E_OP, "scallop " + scallops[p].name,
           "clip: scallops %s and %s belong to the same leaflet: name one of each",
           scallops[a].name.c_str(), scallops[p].name.c_str());
  const double share = 0.5 * (1 + op.position);
  const Sides sides{nodes_from_free_edge(s, a, share), nodes_from_free_edge(s, p, share)};
  const double width = op.width != 0 ? op.width : default_width;
  const double reach = op.reach != 0 ? op.reach : default_reach;
  // two sheets thick: no farther apart, so that no fold opens between two stitches
  const double gap = 2 * s.valve.contact_thickness;
  const std::vector<Pair> pairs = pairs_in_rows(sides, s.before.node_count(), width, reach, gap);
  const std::string name = free_name(s, op.name);
  sew(s, pairs, name);
  open_the_valve(s);
  s.title = format("Join %s and %s by %s, %zu stitches over %.1f mm", scallops[a].name.c_str(),
                   scallops[p].name.c_str(), name.c_str(), pairs.size(), 1e3 * width);
}

}  // namespace mvs::core
