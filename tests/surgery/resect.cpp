// Resections: the removed tissue, the unchanged rest, and the closure of the sutured valve.
#include "measure/annulus/landmarks.h"
#include "surgery/leaflet/flat.h"
#include "surgery/leaflet/sheet_map.h"
#include "tests/surgery/resected.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

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

TEST_CASE("a_resection_is_made_on_the_open_shape_in_any_state") {
  const ModelState before = shipped();
  const Closed healthy = close(before);
  const ModelState closed{healthy.model, healthy.state};
  for (const mvs_op_resect &op : {resection(0, 0, 0), resection(8 * mm, 6 * mm, 10 * mm)}) {
    const Closed from_open = close(apply(before, op).current);
    const Closed from_closed = close(apply(closed, op).current);
    CHECK(from_open.state.x.get() == from_closed.state.x.get());
  }
  // the outline is of the closed leaflet, as it lies before the operation
  const ModelState after = apply(closed, along_outline(notch(closed))).current;
  const State open = initial_state(*closed.model);
  for (size_t n = 0; n < after.model->valve.rest.size(); ++n) {
    const uint32_t origin = after.model->valve.origin[n];
    if (origin != none) CHECK(after.state.x.get()[n] == open.x.get()[origin]);
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
