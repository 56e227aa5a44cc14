// The open parametric valve: a well-shaped mesh with the requested dimensions and vertex count.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <doctest/doctest.h>

#include "anatomy/parametric.h"
#include "anatomy/shape.h"
#include "geometry/intersect.h"
#include "tests/about.h"
#include "tests/founding.h"

using namespace mvs::core;
using mvs::core::test::about;

namespace {

mvs_parametric_desc sized(uint32_t vertices) {
  mvs_parametric_desc desc{};
  desc.shape = MVS_SHAPE_FOUNDING;
  desc.struct_size = sizeof desc;
  desc.vertices = vertices;
  return desc;
}

size_t leaflet_vertices(const Valve &valve) {
  std::set<uint32_t> used;
  for (const Tri &triangle : valve.triangles) used.insert(triangle.begin(), triangle.end());
  return used.size();
}

std::map<Edge, int> edge_uses(const Valve &valve) {
  std::map<Edge, int> uses;
  for (const Tri &t : valve.triangles) {
    for (int k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(t[k], t[(k + 1) % 3]);
      ++uses[{a, b}];
    }
  }
  return uses;
}

double smallest_angle(const Valve &valve) {
  double smallest = M_PI;
  for (const Tri &t : valve.triangles) {
    for (int k = 0; k < 3; ++k) {
      const Vec3 e = valve.rest[t[(k + 1) % 3]] - valve.rest[t[k]];
      const Vec3 f = valve.rest[t[(k + 2) % 3]] - valve.rest[t[k]];
      smallest = std::min(smallest, std::atan2(e.cross(f).norm(), e.dot(f)));
    }
  }
  return smallest * 180 / M_PI;
}

double area(const Valve &valve) {
  double sum = 0;
  for (const auto &[a, b, c] : valve.triangles) {
    sum += 0.5 * (valve.rest[b] - valve.rest[a]).cross(valve.rest[c] - valve.rest[a]).norm();
  }
  return sum;
}

// The boundary edges as loops: the number of loops and of edges on them.
std::vector<size_t> boundary_loops(const Valve &valve) {
  std::map<uint32_t, std::vector<uint32_t>> next;
  for (const auto &[edge, uses] : edge_uses(valve)) {
    if (uses != 1) continue;
    next[edge[0]].push_back(edge[1]);
    next[edge[1]].push_back(edge[0]);
  }
  std::vector<size_t> loops;
  std::set<uint32_t> seen;
  for (const auto &[start, around] : next) {
    if (seen.count(start)) continue;
    size_t length = 0;
    uint32_t at = start;
    for (bool open = true; open; ++length) {
      seen.insert(at);
      open = false;
      for (uint32_t to : next[at]) {
        if (seen.count(to)) continue;
        at = to;
        open = true;
        break;
      }
    }
    loops.push_back(length);
  }
  return loops;
}

}  // namespace

TEST_CASE("every_requested_size_is_met_within_five_percent_by_well_shaped_triangles") {
  for (uint32_t vertices : {200u, 300u, 425u, 850u, 1700u, 6800u}) {
    CAPTURE(vertices);
    const Valve valve = make_parametric_valve(sized(vertices));
    CHECK(std::abs(static_cast<double>(leaflet_vertices(valve)) / vertices - 1) < 0.05);
    CHECK(smallest_angle(valve) > 25);  // measured 28 to 31; 20 is what the solver needs
  }
}

TEST_CASE("edge_lengths_are_nearly_uniform") {
  const Valve valve = make_parametric_valve(founding_valve());
  std::vector<double> lengths;
  for (const auto &[edge, uses] : edge_uses(valve)) {
    lengths.push_back((valve.rest[edge[0]] - valve.rest[edge[1]]).norm());
  }
  std::sort(lengths.begin(), lengths.end());
  // remeshing leaves edges between 4/5 and 4/3 of one length; smoothing adds a little to both ends
  CHECK(lengths[lengths.size() * 95 / 100] / lengths[lengths.size() * 5 / 100] < 1.8);
}

TEST_CASE("the_sheet_is_an_annulus_with_two_boundaries") {
  for (uint32_t vertices : {200u, 425u, 2000u}) {
    const Valve valve = make_parametric_valve(sized(vertices));
    const auto uses = edge_uses(valve);
    for (const auto &[edge, count] : uses) CHECK(count <= 2);
    const auto euler = static_cast<long>(leaflet_vertices(valve)) - static_cast<long>(uses.size()) +
                       static_cast<long>(valve.triangles.size());
    CHECK(euler == 0);
    CHECK(boundary_loops(valve).size() == 2);
    for (size_t i = 0; i < valve.annulus.size(); ++i) {
      const auto [a, b] =
          std::minmax(valve.annulus[i], valve.annulus[(i + 1) % valve.annulus.size()]);
      REQUIRE(uses.count({a, b}) == 1);
      CHECK(uses.at({a, b}) == 1);
    }
  }
}

TEST_CASE("the_open_sheet_does_not_cross_itself") {
  for (uint32_t vertices : {200u, 425u, 1700u}) {
    const Valve valve = make_parametric_valve(sized(vertices));
    CHECK(find_intersections(valve.rest, valve.triangles).empty());
  }
}

TEST_CASE("normals_point_into_the_funnel") {
  const Valve valve = make_parametric_valve(founding_valve());
  for (const auto &[a, b, c] : valve.triangles) {
    const Vec3 middle = (valve.rest[a] + valve.rest[b] + valve.rest[c]) / 3;
    const Vec3 normal = (valve.rest[b] - valve.rest[a]).cross(valve.rest[c] - valve.rest[a]);
    CHECK(normal.head<2>().dot(middle.head<2>()) < 0);
  }
}

TEST_CASE("dimensions_are_the_requested_ones") {
  mvs_parametric_desc desc = sized(6000);
  desc.annulus_ap = 29 * mm;
  desc.annulus_cc = 36 * mm;
  desc.saddle_height = 7 * mm;
  desc.anterior_height = 22 * mm;
  desc.posterior_height = 12.5 * mm;
  desc.commissure_height = 8 * mm;
  desc.papillary_depth = 25 * mm;
  desc.papillary_separation = 24 * mm;
  const Valve valve = make_parametric_valve(desc);
  Vec3 low = Vec3::Constant(1), high = Vec3::Constant(-1);
  for (uint32_t i : valve.annulus) {
    low = low.cwiseMin(valve.rest[i]);
    high = high.cwiseMax(valve.rest[i]);
  }
  // vertices lie on the annulus; a commissure, A and P point are always vertices
  CHECK(high.x() - low.x() == about(desc.annulus_cc, 1e-12));
  CHECK(high.y() - low.y() == about(desc.annulus_ap, 1e-12));
  CHECK(high.z() - low.z() == about(desc.saddle_height, 1e-12));
  // the columns of A2 and P2, cut into some 50 chords of a gentle arc: short by less than 0.1 %
  double anterior = 0, posterior = 0;
  for (const auto &[edge, uses] : edge_uses(valve)) {
    const Vec3 &a = valve.rest[edge[0]], &b = valve.rest[edge[1]];
    if (a.x() != 0 || b.x() != 0) continue;
    (a.y() > 0 ? anterior : posterior) += (a - b).norm();
  }
  CHECK(anterior == about(desc.anterior_height, 1e-3));
  CHECK(posterior == about(desc.posterior_height, 1e-3));
  for (const Head &head : valve.heads) {
    CHECK(valve.rest[head.node].z() == about(-desc.papillary_depth, 1e-12));
  }
}

TEST_CASE("the_founding_shape_is_an_adult_valve") {
  const Dimensions d = resolve_dimensions(founding_valve());
  const Shape shape(d);
  const double annulus =
      0.25 * M_PI * d.annulus_ap * d.annulus_cc;  // an ellipse's; a D has the same
  const double ratio = area(make_parametric_valve(founding_valve())) / annulus;
  // unloaded tissue: under pressure it stretches by a quarter each way (README)
  CHECK(ratio > 1.4);
  CHECK(ratio < 2.5);
  CHECK(shape.height(0) == d.anterior_height);
  CHECK(shape.height(Shape::commissure) == about(d.commissure_height, 1e-3));
  // both clefts are resolved: the edge rises towards P1, P2 and P3
  const double cleft = shape.height(Shape::cleft_theta());
  CHECK(shape.height(M_PI) > cleft + 2 * mm);
  CHECK(shape.height(Shape::cleft_theta() - 0.3) > cleft + 0.4 * mm);
}

TEST_CASE("refinement_converges_to_one_surface") {
  const double coarse = area(make_parametric_valve(sized(400)));
  const double middle = area(make_parametric_valve(sized(1600)));
  const double fine = area(make_parametric_valve(sized(6400)));
  const double limit = area(make_parametric_valve(sized(25600)));
  // flat triangles and straight edges fall short by the square of their edge, relative to the radii
  // of some 5 mm: 2 mm, 1 mm and 0.5 mm edges, with a factor of 2 for the clefts
  CHECK(coarse == about(limit, 2e-3));
  CHECK(middle == about(limit, 5e-4));
  CHECK(fine == about(limit, 1.25e-4));
}

TEST_CASE("the_two_halves_are_mirror_images_to_the_last_bit") {
  const Valve valve = make_parametric_valve(founding_valve());
  std::set<std::array<double, 3>> places;
  for (const Vec3 &x : valve.rest) places.insert({x.x(), x.y(), x.z()});
  for (const Vec3 &x : valve.rest) {
    CHECK(places.count({x.x() == 0 ? 0.0 : -x.x(), x.y(), x.z()}) == 1);
  }
}

TEST_CASE("the_same_description_gives_the_same_bits") {
  mvs_parametric_desc desc = sized(1000);
  desc.branching = 1;
  const Valve a = make_parametric_valve(desc), b = make_parametric_valve(desc);
  CHECK(a.rest == b.rest);
  CHECK(a.loaded == b.loaded);
  CHECK(a.triangles == b.triangles);
  REQUIRE(a.chords.size() == b.chords.size());
  for (size_t i = 0; i < a.chords.size(); ++i) {
    CHECK(a.chords[i].rest_length == b.chords[i].rest_length);
    CHECK(a.chords[i].b == b.chords[i].b);
    CHECK(a.chords[i].name == b.chords[i].name);
  }
}

TEST_CASE("only_the_loaded_annulus_takes_contraction_and_dilation") {
  mvs_parametric_desc desc = sized(425);
  const Valve plain = make_parametric_valve(desc);
  desc.annulus_contraction = 0.9;
  desc.annulus_scale = 1.2;
  const Valve dilated = make_parametric_valve(desc);
  CHECK(plain.rest == dilated.rest);
  std::set<uint32_t> annulus(plain.annulus.begin(), plain.annulus.end());
  for (uint32_t i = 0; i < plain.rest.size(); ++i) {
    const double scale = annulus.count(i) ? 0.9 * 1.2 : 1;
    CHECK((dilated.loaded[i] - scale * dilated.rest[i]).norm() < 1e-15);  // a bit of 40 mm
  }
}
