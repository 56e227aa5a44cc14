// Resections that are cut or refused with a sentence: impossible pieces, narrow ones, random ones.
#include <cstdlib>

#include "surgery/leaflet/sheet_map.h"
#include "tests/surgery/resected.h"

using namespace mvs::core;
using namespace mvs::core::test;

TEST_CASE("impossible_resections_are_refused") {
  const ModelState p = shipped();
  const auto &valve = p.model->valve;
  refused(p, resection(20 * mm, 0, 0), MVS_E_OP, "free edge of P2 is");
  refused(p, resection(8 * mm, 10 * mm, 0), MVS_E_OP, "wider than the 8.0 mm");
  refused(p, resection(8 * mm, 0, 13 * mm), MVS_E_OP, "take at most 1");
  refused(p, resection(1 * mm, 0, 2 * mm), MVS_E_OP, "smaller than a triangle");
  auto op = resection(8 * mm, 6 * mm, 0);
  op.scallop = valve.scallops[scallop_named(valve, "A2")].id;
  refused(p, op, MVS_E_OP, "skeleton of the heart");
  op.scallop = valve.heads[0].id;
  refused(p, op, MVS_E_ID, "not a scallop");
  std::vector<Vec3> points = notch(p);
  op = along_outline(points);
  op.width = 8 * mm;
  refused(p, op, MVS_E_ARGUMENT, "not both");
  std::swap(points[0], points[3]);
  refused(p, along_outline(points), MVS_E_OP, "crosses itself");
  points = notch(p);
  points[1] = place_on(p, "P2", 0.45, 0.02);
  refused(p, along_outline(points), MVS_E_OP, "reaches the annulus");
  points[0] = place_on(p, "P2", 0.3, 0.6);
  refused(p, along_outline(points), MVS_E_OP, "from the free edge");
  for (Vec3 &q : points) q += Vec3(0.1, 0, 0);
  refused(p, along_outline(points), MVS_E_OP, "from leaflet");
}

TEST_CASE("pieces_that_are_not_one_connected_piece_are_refused") {
  const ModelState p = fine_valve();
  const auto drawn = [&](const std::vector<std::array<double, 2>> &places) {
    std::vector<Vec3> points;
    points.reserve(places.size());
    for (const auto &[along, height] : places) points.push_back(place_on(p, "P2", along, height));
    return points;
  };
  // a ring around an interior that only a slit of 0.1 mm joins to the rest
  std::vector<Vec3> points = drawn({{0.45, 1},
                                    {0.45, 0.8},
                                    {0.2, 0.8},
                                    {0.2, 0.51},
                                    {0.35, 0.51},
                                    {0.35, 0.65},
                                    {0.65, 0.65},
                                    {0.65, 0.4},
                                    {0.35, 0.4},
                                    {0.35, 0.5},
                                    {0.2, 0.5},
                                    {0.2, 0.25},
                                    {0.8, 0.25},
                                    {0.8, 0.8},
                                    {0.55, 0.8},
                                    {0.55, 1}});
  refused(p, along_outline(points), MVS_E_OP, "island");
  points = drawn({{0.1, 1}, {0.3, 0.4}, {0.5, 1}, {0.7, 0.4}, {0.9, 1}});
  refused(p, along_outline(points), MVS_E_OP, "two pieces");
  // across the notch of an earlier resection
  points = drawn({{0.2, 1}, {0.2, 0.6}, {0.8, 0.6}, {0.8, 1}});
  const ModelState cut = apply(p, resection(5 * mm, 0, 10 * mm)).current;
  refused(cut, along_outline(points), MVS_E_OP, "two pieces");
}

TEST_CASE("pieces_narrower_than_the_mesh_are_cut_or_refused_with_that_reason") {
  mvs_parametric_desc coarse = {};
  coarse.shape = MVS_SHAPE_FOUNDING;
  coarse.struct_size = sizeof coarse;
  coarse.vertices = 200;
  const ModelState p = shipped(coarse);
  size_t empty = 0, holes = 0;
  for (int k = 0; k < 40; ++k) {
    try {
      apply(p, resection(1.2 * mm, 0, 10 * mm, 0.045 * k - 0.9));
    } catch (const Error &fault) {
      const std::string said = fault.what();
      CAPTURE(said);
      empty += said.find("narrower than a side") != std::string::npos;
      holes += said.find("reach through the free edge") != std::string::npos;
      CHECK(fault.code == MVS_E_OP);
    }
  }
  CHECK(empty > 0);
  CHECK(holes > 0);
}

TEST_CASE("a_whole_scallop_cannot_be_resected") {
  ModelState p = shipped();
  Valve valve = p.model->valve;
  const SheetMap map(*p.model);
  const uint32_t p2 = scallop_named(valve, "P2");
  valve.scallops.push_back({0, "tip", valve.scallops.get()[p2].leaflet});
  for (size_t t = 0; t < valve.triangles.size(); ++t) {
    if (valve.triangle_scallop.get()[t] != p2) continue;
    bool tip = true;
    for (const uint32_t n : valve.triangles.get()[t]) {
      tip &= map.height(n) > 0.7 && std::abs(map.along(p2, n) - 0.5) < 0.12;
    }
    if (tip) valve.triangle_scallop[t] = static_cast<uint32_t>(valve.scallops.size() - 1);
  }
  p.model = make_model(valve);
  refused(p, resection(9 * mm, 8 * mm, 9 * mm), MVS_E_OP, "would remove all of tip");
}

TEST_CASE("after_a_ring_only_triangles_can_be_cut") {
  auto ring = op_of<mvs_op_ring>(MVS_OP_RING);
  ring.size = 34 * mm;
  const ModelState p = apply(shipped(), ring).current;
  refused(p, resection(8 * mm, 6 * mm, 0), MVS_E_OP, "ring ring holds the annulus");
  CHECK(close(apply(p, resection(8 * mm, 0, 0)).current).stats.converged);
}

// Each of many pieces is cut out, or refused with a sentence of the operation.
TEST_CASE("any_piece_is_cut_or_refused") {
  const char *lengthy = std::getenv("MVS_TEST_LONG");
  const uint32_t pieces = lengthy && *lengthy ? 300 : 90;
  std::vector<ModelState> valves;
  for (const uint32_t vertices : {425u, 200u, 900u}) {
    mvs_parametric_desc desc = {};
    desc.shape = MVS_SHAPE_FOUNDING;
    desc.struct_size = sizeof desc;
    desc.vertices = vertices;
    valves.push_back(shipped(desc));
  }
  size_t cut = 0, again = 0;
  for (uint32_t k = 0; k < pieces; ++k) {
    CAPTURE(k);
    // three coordinates that fill the box evenly (Kronecker), the last two of a plastic number
    const double u = std::fmod(0.5 + 0.8191725133961645 * k, 1);
    const double v = std::fmod(0.5 + 0.6710436067037893 * k, 1);
    const double w = std::fmod(0.5 + 0.5497004779019703 * k, 1);
    ModelState p = valves[k % 3];
    auto op = resection((1 + 13 * u) * mm, k % 2 ? 0.7 * (1 + 13 * u) * mm : 0, (2 + 11 * v) * mm,
                        2 * w - 1);
    const char *names[] = {"P1", "P2", "P3", "A2"};
    op.scallop = p.model->valve.scallops[scallop_named(p.model->valve, names[k % 4])].id;
    for (int round = 0; round < 2; ++round) {
      try {
        p = apply(p, op).current;
        ++(round == 0 ? cut : again);
      } catch (const Error &fault) {
        const std::string said = fault.what();
        CAPTURE(said);
        CHECK((fault.code == MVS_E_OP || fault.code == MVS_E_ARGUMENT));
        CHECK(said.find("is not a valid valve") == std::string::npos);
      }
      op.position = -op.position;  // the same on the other side of the scallop
    }
  }
  CHECK(cut > pieces / 3);
  CHECK(again > pieces / 6);
}
