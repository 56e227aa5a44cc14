// Resections: the removed tissue, the unchanged rest, and the closure of the sutured valve.
#include <cstdlib>

#include "measure/annulus/landmarks.h"
#include "surgery/leaflet/flat.h"
#include "surgery/leaflet/sheet_map.h"
#include "tests/surgery/operated.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

mvs_op_resect resection(double width, double base_width, double depth, double position = 0) {
  auto op = op_of<mvs_op_resect>(MVS_OP_RESECT);
  op.width = width;
  op.base_width = base_width;
  op.depth = depth;
  op.position = position;
  return op;
}

ModelState fine_valve() {
  mvs_parametric_desc desc = {};
  desc.shape = MVS_SHAPE_FOUNDING;
  desc.struct_size = sizeof desc;
  desc.vertices = 6800;
  return shipped(desc);
}

std::vector<Chord> sutures_of(const Valve &valve) {
  std::vector<Chord> list;
  for (const Chord &chord : valve.chords) {
    if (chord.kind == ChordKind::suture) list.push_back(chord);
  }
  return list;
}

double area_of(const Model &model) {
  double sum = 0;
  for (const double a : model.rest_area) sum += a;
  return sum;
}

double perimeter(const Valve &valve, const std::vector<Vec3> &places) {
  return Loop(valve.annulus, places).length();
}

uint32_t scallop_named(const Valve &valve, const std::string &name) {
  for (uint32_t k = 0; k < valve.scallops.size(); ++k) {
    if (valve.scallops[k].name == name) return k;
  }
  return none;
}

// The present place of a point of a scallop.
Vec3 place_on(const ModelState &p, const std::string &scallop, double along, double height) {
  const Surgery s{*p.model, p.model->valve, p.state, "test"};
  const Id id = p.model->valve.scallops[scallop_named(p.model->valve, scallop)].id;
  const SheetPoint at = locate(s, {MVS_SITE_ANATOMICAL, 0, id, {along, height, 0}});
  Vec3 sum = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    sum += at.weight[k] * p.state.x.get()[p.model->valve.triangles[at.triangle][k]];
  }
  return sum;
}

std::vector<Vec3> notch(const ModelState &p) {
  return {place_on(p, "P2", 0.3, 1), place_on(p, "P2", 0.45, 0.4), place_on(p, "P2", 0.6, 0.4),
          place_on(p, "P2", 0.7, 1)};
}

mvs_op_resect along_outline(const std::vector<Vec3> &points) {
  auto op = op_of<mvs_op_resect>(MVS_OP_RESECT);
  op.outline = array_of(points);
  return op;
}

double widest_gap(const Closed &closed) {
  double most = 0;
  for (const Chord &c : sutures_of(closed.model->valve)) {
    most = std::max(most, (closed.state.x.get()[c.a] - closed.state.x.get()[c.b]).norm());
  }
  return most;
}

}  // namespace

TEST_CASE("a_resected_valve_converges_sutured_and_sealed") {
  const ModelState before = shipped();
  const std::vector<Vec3> points = notch(before);
  for (const mvs_op_resect &op : {resection(0, 0, 0), resection(8 * mm, 6 * mm, 10 * mm),
                                  resection(12 * mm, 0, 0), along_outline(points)}) {
    CAPTURE(op.width);
    CAPTURE(op.base_width);
    const Closed closed = close(apply(before, op).current);
    CHECK(closed.stats.converged);
    CHECK(intersections(closed) == 0);
    CHECK(sutures_of(closed.model->valve).size() >= 5);
    // a gap of up to a contact thickness is sealed; sutures stretch by a few percent
    CHECK(widest_gap(closed) < closed.model->valve.contact_thickness);
    CHECK(measure_orifice(*closed.model, closed.state.x).area == 0);
  }
}

TEST_CASE("the_sutures_seal_the_gap") {
  ModelState cut = apply(shipped(), resection(0, 0, 0)).current;
  Valve valve = cut.model->valve;
  std::vector<Chord> chords = valve.chords;
  std::erase_if(chords, [](const Chord &c) { return c.kind == ChordKind::suture; });
  valve.chords = chords;
  cut.model = make_model(valve);
  const Closed open = close(cut);
  CHECK(open.stats.converged);
  // a triangle 8 mm wide stands open: half its area or more
  CHECK(measure_orifice(*open.model, open.state.x).area > 15e-6);
}

TEST_CASE("the_remaining_tissue_is_unchanged") {
  const ModelState before = shipped();
  const Operated done = apply(before, resection(0, 0, 0));
  const ModelState &after = done.current;
  const Valve &old = before.model->valve, &now = after.model->valve;
  size_t added = 0;
  for (size_t n = 0; n < now.rest.size(); ++n) {
    const uint32_t origin = now.origin[n];
    if (origin == none) {
      ++added;
      continue;
    }
    CHECK(now.rest[n] == old.rest[origin]);
    CHECK(now.open[n] == old.open[origin]);
    CHECK(now.loaded[n] == old.loaded[origin]);
    CHECK(after.state.x.get()[n] == before.state.x.get()[origin]);
  }
  CHECK(added > 0);
  REQUIRE(now.annulus.size() == old.annulus.size());
  for (size_t k = 0; k < now.annulus.size(); ++k) {
    CHECK(now.origin[now.annulus[k]] == old.annulus[k]);
  }
  CHECK(now.scallops == old.scallops);
  // a remaining chord is the same between the same nodes
  size_t kept = 0;
  for (const Chord &c : now.chords) {
    if (c.kind == ChordKind::suture) continue;
    for (const Chord &o : old.chords) {
      if (o.id != c.id) continue;
      ++kept;
      CHECK(now.origin[c.a] == o.a);
      CHECK(now.origin[c.b] == o.b);
      CHECK(c.rest_length == o.rest_length);
    }
  }
  CHECK(kept + sutures_of(now).size() == now.chords.size());
  CHECK(kept < old.chords.size());  // those of the resected piece are removed
  CHECK(done.title.ends_with(
      format("mm deep, with the %zu chord segments that end there", old.chords.size() - kept)));
}

TEST_CASE("the_piece_has_the_requested_size") {
  const ModelState before = fine_valve();
  const double edge = 0.5 * mm;  // of this mesh, about
  for (const double base : {0.0, 5 * mm}) {
    const ModelState after = apply(before, resection(9 * mm, base, 8 * mm)).current;
    const double cut = area_of(*before.model) - area_of(*after.model);
    const double wanted = 0.5 * (9 * mm + base) * 8 * mm;
    // a node within a fifth of an edge beside one of the two sides is cut through, on average half
    // of that; the free edge between them is not straight: 2 mm2
    CHECK(std::abs(cut - wanted) < 0.1 * edge * 2 * 9 * mm + 2e-6);
    double width = 0;
    for (const Chord &c : sutures_of(after.model->valve)) {
      const std::vector<Vec3> &rest = after.model->valve.rest;
      width = std::max(width, (rest[c.a] - rest[c.b]).norm());
    }
    CHECK(std::abs(width - 9 * mm) < 2 * 0.2 * edge + 0.02 * 9 * mm);  // chord below arc: 2 %
  }
}

TEST_CASE("a_quadrangle_gathers_the_posterior_annulus_by_its_base") {
  const ModelState before = shipped();
  const ModelState after = apply(before, resection(8 * mm, 6 * mm, 10 * mm)).current;
  const Valve &old = before.model->valve, &now = after.model->valve;
  // nodes are placed along the new curve by arc length, their chords are shorter by parts of 1 %
  CHECK(std::abs(perimeter(old, old.open) - perimeter(now, now.open) - 6 * mm) < 0.4 * mm);
  CHECK(std::abs(perimeter(old, old.loaded) - perimeter(now, now.loaded) - 6 * mm) < 0.4 * mm);
  const Loop loop(old.annulus, old.rest);
  const Arc anterior = attachment(*before.model, loop, anterior_leaflet(old));
  for (size_t k = 0; k < old.annulus.size(); ++k) {
    const double s = loop.start_of(k);
    const bool is_anterior = (s >= anterior.from - 1e-9 && s <= anterior.to + 1e-9) ||
                             s + loop.length() <= anterior.to + 1e-9;
    const bool moved = now.loaded[now.annulus[k]] != old.loaded[old.annulus[k]];
    CHECK(moved != is_anterior);
    CHECK(now.rest[now.annulus[k]] == old.rest[old.annulus[k]]);
  }
}

TEST_CASE("an_outline_removes_the_same_tissue_on_an_open_and_a_closed_valve") {
  const ModelState open = shipped();
  const Closed closed = close(open);
  const ModelState shut{closed.model, closed.state};
  const ModelState a = apply(open, along_outline(notch(open))).current;
  const ModelState b = apply(shut, along_outline(notch(shut))).current;
  REQUIRE(a.model->node_count() == b.model->node_count());
  for (size_t n = 0; n < a.model->node_count(); ++n) {
    // the flat points are combined with other triangles' weights: rounding
    CHECK((a.model->valve.rest[n] - b.model->valve.rest[n]).norm() < 1e-9);
  }
}

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

TEST_CASE("a_seam_is_not_part_of_the_free_edge_of_anatomical_sites") {
  const ModelState before = shipped();
  const ModelState after = apply(before, resection(0, 0, 0)).current;
  const SheetMap old(*before.model), now(*after.model);
  double most = 0, highest = 0;
  for (uint32_t n = 0; n < after.model->node_count(); ++n) {
    const uint32_t origin = after.model->valve.origin[n];
    if (origin == none || after.model->topology.node_triangles[n].empty()) continue;
    most = std::max(most, std::abs(now.height(n) - old.height(origin)));
  }
  // a seam that counted as free edge would lift its deep end from 0.2 to 1
  CHECK(most < 0.2);
  for (const Chord &c : sutures_of(after.model->valve)) {
    highest = std::max(highest, now.height(c.a));
    CHECK(std::abs(now.height(c.a) - now.height(c.b)) < 0.1);
  }
  CHECK(highest == 1);
}

TEST_CASE("a_flattened_leaflet_keeps_its_lengths") {
  const ModelState p = fine_valve();
  const Model &model = *p.model;
  const Surgery s{model, model.valve, p.state, "test"};
  const uint32_t p2 = scallop_named(model.valve, "P2");
  const SheetPoint middle =
      locate(s, {MVS_SITE_ANATOMICAL, 0, model.valve.scallops[p2].id, {0.5, 0.5, 0}});
  const Flat flat = flatten(model, middle.triangle);
  double most = 0, sum = 0, count = 0;
  for (uint32_t t = 0; t < model.valve.triangles.size(); ++t) {
    if (!flat.has(model.valve, t) || model.valve.triangle_scallop[t] != p2) continue;
    const Tri &tri = model.valve.triangles[t];
    for (int k = 0; k < 3; ++k) {
      const uint32_t a = tri[k], b = tri[(k + 1) % 3];
      const double length = (model.valve.rest[a] - model.valve.rest[b]).norm();
      const double change = (flat.at[a] - flat.at[b]).norm() / length - 1;
      most = std::max(most, std::abs(change));
      sum += change * change;
      ++count;
    }
    const Vec2 u = flat.at[tri[1]] - flat.at[tri[0]], v = flat.at[tri[2]] - flat.at[tri[0]];
    CHECK(u.x() * v.y() - u.y() * v.x() > 0);  // no triangle is folded over
  }
  // P2 bulges between its clefts and cannot be flattened without distortion: 10 % at most, along
  // them
  CHECK(most < 0.15);
  CHECK(std::sqrt(sum / count) < 0.03);
}
