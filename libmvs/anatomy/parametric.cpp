#include "anatomy/parametric.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "anatomy/chordae.h"
#include "base/error.h"

namespace mvs::core {
namespace {

// The middle scallop of the anterior leaflet reaches this share of the way to a commissure.
constexpr double a2_share = 0.42;
// A branch node lies this share of the way from the papillary tip to the leaflet.
constexpr double trunk_share = 0.6;

enum ScallopIndex : uint32_t { a1, a2, a3, p1, p2, p3 };

// On the posteromedial half if `medial`, else on its mirror image.
uint32_t scallop_at(double theta, bool medial) {
  if (theta < a2_share * Shape::commissure) return a2;
  if (theta <= Shape::commissure) return medial ? a3 : a1;
  if (theta <= Shape::cleft_theta()) return medial ? p3 : p1;
  return p2;
}

Vec3 mirrored(const Vec3 &x) {
  return {-x.x(), x.y(), x.z()};
}

class Builder {
 public:
  explicit Builder(const Dimensions &d)
      : d_(d), shape_(d), sheet_(mesh_half_sheet(shape_, d.vertices)) {}

  Valve build() {
    name_parts();
    add_vertices();
    add_triangles();
    add_annulus();
    add_chordae();
    load_boundary();
    return std::move(valve_);
  }

 private:
  void name_parts() {
    valve_.name = "parametric mitral valve";
    for (const char *name : {"A", "P"}) {
      Leaflet leaflet;
      leaflet.name = name;
      leaflet.thickness = d_.thickness;
      valve_.leaflets.push_back(leaflet);
    }
    for (const char *name : {"A1", "A2", "A3", "P1", "P2", "P3"}) {
      valve_.scallops.push_back({0, name, name[0] == 'A' ? 0u : 1u});
    }
  }

  // The medial half as it is, then the mirror images of all but the mirror's own vertices.
  void add_vertices() {
    valve_.rest = sheet_.x;
    for (uint32_t i = 0; i < sheet_.x.size(); ++i) {
      if (sheet_.sides[i] & on_mirror) {
        image_.push_back(i);
      } else {
        image_.push_back(static_cast<uint32_t>(valve_.rest.size()));
        valve_.rest.push_back(mirrored(sheet_.x[i]));
      }
    }
  }

  void add_triangles() {
    for (bool medial : {true, false}) {
      for (const auto &[a, b, c] : sheet_.triangles) {
        const auto &p = sheet_.place;
        const uint32_t scallop = scallop_at((p[a].theta + p[b].theta + p[c].theta) / 3, medial);
        valve_.triangles.push_back(medial ? Tri{a, b, c} : Tri{image_[a], image_[c], image_[b]});
        valve_.triangle_scallop.push_back(scallop);
        valve_.triangle_leaflet.push_back(valve_.scallops[scallop].leaflet);
      }
    }
  }

  // From the A point over the posteromedial commissure and the P point back.
  void add_annulus() {
    for (uint32_t i = 0; i < sheet_.x.size(); ++i) {
      if (sheet_.sides[i] & on_annulus) valve_.annulus.push_back(i);
    }
    for (size_t i = valve_.annulus.size() - 2; i > 0; --i) {
      valve_.annulus.push_back(image_[valve_.annulus[i]]);
    }
  }

  void add_chordae() {
    const std::vector<Tree> trees = plan_trees(shape_, sheet_, d_);
    for (bool medial : {false, true}) {
      const uint32_t first_head = add_heads(medial);
      for (const Tree &tree : trees) add_tree(tree, first_head, medial);
    }
    name_chordae();
  }

  uint32_t add_heads(bool medial) {
    const uint32_t first = static_cast<uint32_t>(valve_.rest.size());
    int number = 0;
    for (const Vec3 &tip : shape_.medial_tips()) {
      const uint32_t node = static_cast<uint32_t>(valve_.rest.size());
      valve_.heads.push_back({0, format("%s%d", medial ? "PM" : "AL", ++number), node});
      valve_.rest.push_back(medial ? tip : mirrored(tip));
    }
    return first;
  }

  void add_tree(const Tree &tree, uint32_t first_head, bool medial) {
    const Vec3 tip = shape_.medial_tips()[tree.front().tip];
    uint32_t from = first_head + tree.front().tip;
    Vec3 from_closed = tip;
    if (tree.size() > 1) {
      Vec3 open = Vec3::Zero(), closed = Vec3::Zero();
      for (const Attachment &a : tree) {
        open += sheet_.x[a.vertex] / static_cast<double>(tree.size());
        closed += shape_.closed(sheet_.place[a.vertex]) / static_cast<double>(tree.size());
      }
      const Vec3 node = tip + trunk_share * (open - tip);
      from_closed = tip + trunk_share * (closed - tip);
      const uint32_t trunk_end = static_cast<uint32_t>(valve_.rest.size());
      valve_.rest.push_back(medial ? node : mirrored(node));
      add_chord(from, trunk_end, MVS_CHORD_KIND_TRUNK, (from_closed - tip).norm(),
                scallop_of(tree[tree.size() / 2], medial));
      from = trunk_end;
    }
    for (const Attachment &a : tree) {
      const double length = (shape_.closed(sheet_.place[a.vertex]) - from_closed).norm();
      add_chord(from, medial ? a.vertex : image_[a.vertex], a.kind, length, scallop_of(a, medial));
    }
  }

  uint32_t scallop_of(const Attachment &a, bool medial) const {
    return scallop_at(sheet_.place[a.vertex].theta, medial);
  }

  void add_chord(uint32_t a, uint32_t b, uint32_t kind, double length, uint32_t scallop) {
    Chord chord;
    chord.a = a;
    chord.b = b;
    chord.kind = kind;
    chord.rest_length = d_.chord_slack * length;
    valve_.chords.push_back(chord);
    chord_scallop_.push_back(scallop);
  }

  // "P2/3": numbered within each scallop in the order of the list, lateral muscle first.
  void name_chordae() {
    std::array<int, 6> number{};
    for (size_t i = 0; i < valve_.chords.size(); ++i) {
      const uint32_t scallop = chord_scallop_[i];
      valve_.chords[i].name =
          format("%s/%d", valve_.scallops[scallop].name.c_str(), ++number[scallop]);
    }
  }

  void load_boundary() {
    valve_.loaded = valve_.rest;
    for (uint32_t node : valve_.annulus) {
      valve_.loaded[node] *= d_.annulus_contraction * d_.annulus_scale;
    }
  }

  Dimensions d_;
  Shape shape_;
  HalfSheet sheet_;
  std::vector<uint32_t> image_;  // of each vertex of the half sheet on the lateral half
  std::vector<uint32_t> chord_scallop_;
  Valve valve_;
};

}  // namespace

Valve make_parametric_valve(const mvs_parametric_desc &desc) {
  return Builder(resolve_dimensions(desc)).build();
}

}  // namespace mvs::core
