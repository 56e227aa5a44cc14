// Assembles a parametric valve from a mesh of one half and its mirror image, with named parts,
// chordae and boundary conditions.
#include "anatomy/parametric.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "anatomy/chordae.h"
#include "anatomy/leaflet_names.h"
#include "base/error.h"

namespace mvs::core {
namespace {

// A2 extends to this share of the angle between its middle and a commissure.
constexpr double a2_share = 0.42;
// Position of a branch node between papillary tip and leaflet, as a share from the tip.
double trunk_share(ParametricShape shape) {
  return shape == ParametricShape::founding ? 0.6 : 0.4;
}

enum ScallopIndex : uint32_t { a1, a2, a3, p1, p2, p3 };

// Rest length of a chord over the distance from its tip to the place of its vertex in the closed
// target: loaded chordae are 1 to 2 % longer than at rest, and 1 % more keeps the anterior belly of
// the softest tissue below 2 mm of billow (PARAMETRIC.md).
double rest_share(ParametricShape shape, uint32_t scallop) {
  if (shape == ParametricShape::founding) return 1;
  return scallop <= a3 ? 0.97 : 0.98;
}

// Returns the scallop at an angle: on the posteromedial half if `medial`, else on its mirror image.
uint32_t scallop_at(double theta, bool medial) {
  if (theta < a2_share * Shape::commissure) return a2;
  if (theta <= Shape::commissure) return medial ? a3 : a1;
  if (theta <= Shape::cleft_theta()) return medial ? p3 : p1;
  return p2;
}

// The smooth shape, its half mesh, and the vertex of the other half that mirrors each of its
// vertices.
struct Halves {
  const Dimensions &dimensions;
  const Shape &shape;
  const HalfSheet &sheet;
  std::vector<uint32_t> image;
};

// A point of the posteromedial half, or its mirror image.
Vec3 on_half(const Vec3 &x, bool medial) {
  return medial ? x : Vec3(-x.x(), x.y(), x.z());
}

uint32_t count_of(const CowVector<Vec3> &nodes) {
  return static_cast<uint32_t>(nodes.size());
}

// Adds the vertices of the medial half, then the mirror images of those that are not on the mirror
// plane; fills `image`.
void add_vertices(Halves &halves, Valve &valve) {
  const HalfSheet &sheet = halves.sheet;
  valve.rest = sheet.x;
  for (uint32_t i = 0; i < sheet.x.size(); ++i) {
    const bool shared = (sheet.sides[i] & on_mirror) != 0;
    halves.image.push_back(shared ? i : count_of(valve.rest));
    if (!shared) valve.rest.push_back(on_half(sheet.x[i], false));
  }
}

void add_triangles(const Halves &halves, Valve &valve) {
  const std::vector<uint32_t> &image = halves.image;
  for (bool medial : {true, false}) {
    for (const auto &[a, b, c] : halves.sheet.triangles) {
      const auto &p = halves.sheet.place;
      const uint32_t scallop = scallop_at((p[a].theta + p[b].theta + p[c].theta) / 3, medial);
      valve.triangles.push_back(medial ? Tri{a, b, c} : Tri{image[a], image[c], image[b]});
      valve.triangle_scallop.push_back(scallop);
      valve.triangle_leaflet.push_back(valve.scallops[scallop].leaflet);
    }
  }
}

// From the A point over the posteromedial commissure to the P point, and back over the other half.
void add_annulus(const Halves &halves, Valve &valve) {
  for (uint32_t i = 0; i < halves.sheet.x.size(); ++i) {
    if (halves.sheet.sides[i] & on_annulus) valve.annulus.push_back(i);
  }
  for (size_t i = valve.annulus.size() - 2; i > 0; --i) {
    valve.annulus.push_back(halves.image[valve.annulus[i]]);
  }
}

uint32_t add_heads(const Shape &shape, bool medial, Valve &valve) {
  const uint32_t first = count_of(valve.rest);
  int number = 0;
  for (const Vec3 &tip : shape.medial_tips()) {
    valve.heads.push_back(
        {0, format("%s%d", medial ? "PM" : "AL", ++number), count_of(valve.rest)});
    valve.rest.push_back(on_half(tip, medial));
  }
  return first;
}

// One half of a valve to which chordae are added; chords get the names of their scallops, numbered
// within each scallop in the order of the list: "P2/3".
struct ChordBuilder {
  const Halves &halves;
  bool medial;
  Valve &valve;
  std::array<int, 6> &number;

  // Branches of the healthy shape have the cross-section of a chord, a trunk has that of its
  // branches.
  void add(uint32_t a, uint32_t b, ChordKind kind, double length, const Attachment &at,
           size_t branches = 1) {
    const uint32_t scallop = scallop_at(halves.sheet.place[at.vertex].theta, medial);
    Chord chord;
    chord.a = a;
    chord.b = b;
    chord.kind = kind;
    chord.rest_length =
        rest_share(halves.dimensions.shape, scallop) * halves.dimensions.chord_slack * length;
    if (halves.dimensions.shape == ParametricShape::healthy) {
      chord.area *= static_cast<double>(branches);
    }
    chord.name = format("%s/%d", valve.scallops.get()[scallop].name.c_str(), ++number[scallop]);
    valve.chords.push_back(chord);
  }
};

void add_tree(const Tree &tree, uint32_t first_head, ChordBuilder &builder) {
  const auto &[halves, medial, valve, number] = builder;
  // clang 14 captures no structured binding by reference
  const auto closed = [&halves = halves](const Attachment &a) {
    return halves.shape.closed(halves.sheet.place[a.vertex]);
  };
  const Vec3 tip = halves.shape.medial_tips()[tree.front().tip];
  uint32_t from = first_head + tree.front().tip;
  Vec3 from_closed = tip;
  if (tree.size() > 1) {
    Vec3 mean_open = Vec3::Zero(), mean_closed = Vec3::Zero();
    for (const Attachment &a : tree) {
      mean_open += halves.sheet.x[a.vertex] / static_cast<double>(tree.size());
      mean_closed += closed(a) / static_cast<double>(tree.size());
    }
    const double share = trunk_share(halves.dimensions.shape);
    const Vec3 node = tip + share * (mean_open - tip);
    from_closed = tip + share * (mean_closed - tip);
    const uint32_t trunk_end = count_of(valve.rest);
    valve.rest.push_back(on_half(node, medial));
    builder.add(from, trunk_end, ChordKind::trunk, (from_closed - tip).norm(),
                tree[tree.size() / 2], tree.size());
    from = trunk_end;
  }
  for (const Attachment &a : tree) {
    const uint32_t vertex = medial ? a.vertex : halves.image[a.vertex];
    builder.add(from, vertex, a.kind, (closed(a) - from_closed).norm(), a);
  }
}

// The lateral muscle first.
void add_chordae(const Halves &halves, Valve &valve) {
  const std::vector<Tree> trees = plan_trees(halves.shape, halves.sheet, halves.dimensions);
  std::array<int, 6> number{};
  for (bool medial : {false, true}) {
    const uint32_t first_head = add_heads(halves.shape, medial, valve);
    ChordBuilder builder{halves, medial, valve, number};
    for (const Tree &tree : trees) add_tree(tree, first_head, builder);
  }
}

void load_boundary(const Dimensions &d, Valve &valve) {
  valve.loaded = valve.rest;
  for (uint32_t node : valve.annulus) {
    valve.loaded[node] *= d.annulus_contraction * d.annulus_scale;
  }
}

}  // namespace

Valve make_parametric_valve(const mvs_parametric_desc &desc) {
  const Dimensions d = resolve_dimensions(desc);
  const Shape shape(d);
  const HalfSheet sheet = mesh_half_sheet(shape, d.vertices);
  Halves halves{d, shape, sheet, {}};
  Valve valve;
  valve.name = "parametric mitral valve";
  name_leaflets(d.law, d.thickness, valve);
  add_vertices(halves, valve);
  add_triangles(halves, valve);
  add_annulus(halves, valve);
  add_chordae(halves, valve);
  load_boundary(d, valve);
  return valve;
}

}  // namespace mvs::core
