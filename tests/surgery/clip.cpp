// Edge-to-edge repair: the places that a clip joins, its title and name, and refused clips.
#include <cmath>
#include <cstdlib>
#include <string>

#include "surgery/leaflet/sheet_map.h"
#include "tests/surgery/clipped.h"

namespace mvs::core::test {
namespace {

std::vector<uint8_t> nodes_of_leaflet(const Model &model, const std::string &name) {
  std::vector<uint8_t> is(model.node_count(), 0);
  for (size_t t = 0; t < model.valve.triangles.size(); ++t) {
    if (model.valve.leaflets[model.valve.triangle_leaflet[t]].name != name) continue;
    for (const uint32_t node : model.valve.triangles[t]) is[node] = 1;
  }
  return is;
}

}  // namespace

TEST_CASE("a_clip_joins_facing_places_of_the_two_leaflets_in_rows") {
  const ModelState before = shipped();
  const Operated done = apply(before, clip());
  const Model &model = *done.current.model;
  const std::vector<Chord> list = stitches(model);
  // 5 mm along the edge and 4 mm into the leaflets, 2 mm apart: three rows of three
  REQUIRE(list.size() == 9);
  CHECK(list[0].id == done.made);
  CHECK(list[0].name == "clip");
  CHECK(list[1].name == "clip/2");
  CHECK(done.title == "Join A2 and P2 by clip, 9 stitches over 5.0 mm");
  const std::vector<uint8_t> in_a = nodes_of_leaflet(model, "A"),
                             in_p = nodes_of_leaflet(model, "P");
  for (const Chord &c : list) {
    CHECK(c.rest_length == model.valve.contact_thickness);
    CHECK((in_a[c.a] && !in_p[c.a] && in_p[c.b] && !in_a[c.b]));
    // half the width, and half a stitch for the mesh
    CHECK(std::abs(model.valve.rest[c.a][0]) < 2.5 * mm + 1 * mm);
    CHECK(std::abs(model.valve.rest[c.a][0] - model.valve.rest[c.b][0]) < 1 * mm);
  }
  // the valve is its own mirror image in x: the middle stitch is at the middle of the scallop, but
  // for half an edge of the mesh
  CHECK(std::abs(model.valve.rest[list[0].a][0]) < 1 * mm);
  CHECK(model.valve.chords.size() == before.model->valve.chords.size() + 9);
}

TEST_CASE("the_number_of_stitches_does_not_depend_on_the_mesh") {
  CHECK(stitches(*apply(shipped(of_size(1700)), clip()).current.model).size() == 9);
  auto op = clip();
  op.width = 1 * mm;
  op.reach = 0.5 * mm;
  CHECK(stitches(*apply(shipped(), op).current.model).size() == 1);
}

TEST_CASE("a_clip_is_placed_at_its_position") {
  const ModelState before = shipped();
  const SheetMap map(*before.model);
  for (const double position : {-0.8, 0.0, 0.8}) {
    CAPTURE(position);
    auto op = clip();
    op.position = position;
    const ModelPtr held = apply(before, op).current.model;
    const Model &model = *held;
    const Chord middle = stitches(model)[0];
    const std::vector<Scallop> &scallops = model.valve.scallops;
    for (uint32_t s = 0; s < scallops.size(); ++s) {
      if (scallops[s].name != "A2" && scallops[s].name != "P2") continue;
      const uint32_t node = scallops[s].name == "A2" ? middle.a : middle.b;
      // half an edge of the mesh, 1 mm of a scallop that is 7 mm wide there
      CHECK(std::abs(map.along(s, node) - 0.5 * (1 + position)) < 0.15);
    }
  }
}

// The sides of the wedge, sutured to each other, are no free edge any more: the clip reaches no
// deeper than on a whole leaflet, not to the apex near the annulus.
TEST_CASE("a_clip_on_a_resected_leaflet_joins_its_free_edges") {
  for (const double position : {0.0, -0.4}) {
    CAPTURE(position);
    const ModelState cut = apply(shipped(), op_of<mvs_op_resect>(MVS_OP_RESECT)).current;
    auto op = clip();
    op.position = position;
    const ModelState clipped = apply(cut, op).current;
    const SheetMap map(*cut.model);
    size_t joined = 0;
    for (const Chord &c : stitches(*clipped.model)) {
      if (!c.name.starts_with("clip")) continue;
      ++joined;
      // 4 mm, and half an edge of the mesh (1 mm), of a leaflet that is 9 mm high there
      CHECK(map.height(c.b) > 0.4);
      if (c.name == "clip") CHECK(map.height(c.b) == 1);
    }
    CHECK(joined >= 6);
    const Closed closed = close(clipped);
    CHECK(closed.stats.converged);
    CHECK(intersections(closed) == 0);
  }
}

// A point at depth d of a clip turned by t goes along the edge by d sin t, on both leaflets in
// opposite senses: anterior places towards CC, seen from the atrium anticlockwise from AP.
TEST_CASE("a_turned_clip_joins_places_that_a_rotation_carries_it_to") {
  const ModelState before = shipped();
  const Vec3 cc = valve_frame(*before.model, before.model->valve.rest).axes.row(1);
  for (const double angle : {-0.5, -0.25, 0.0, 0.25, 0.5}) {
    CAPTURE(angle);
    auto op = clip();
    op.angle = angle;
    const Operated done = apply(before, op);
    const Valve &valve = done.current.model->valve;
    const std::vector<Chord> list = stitches(*done.current.model);
    REQUIRE(list.size() >= 7);
    const auto along = [&](uint32_t node) { return cc.dot(valve.rest[node]); };
    // the middle stitch is the pivot, whatever the angle
    CHECK(std::abs(along(list[0].a)) < 1 * mm);
    // rows of the clip at 2 and 4 mm: mean shift of the anterior end before the posterior one
    double shift = 0;
    for (const Chord &c : list)
      shift += (along(c.a) - along(c.b)) / static_cast<double>(list.size());
    // mean depth 2 mm; ends at nodes, within half an edge of 2 mm of their places
    CHECK(std::abs(shift - 2 * 2 * mm * std::sin(angle)) < 0.7 * mm);
    CHECK((done.title.find("turned by") != std::string::npos) == (angle != 0));
  }
}

TEST_CASE("the_title_of_a_clip_says_how_far_it_is_from_the_middle_and_towards_which_scallop") {
  const ModelState before = shipped();
  const auto placed = [&](double position) {
    auto op = clip();
    op.position = position;
    return apply(before, op);
  };
  for (const double position : {0.5, -0.5}) {
    const Operated done = placed(position);
    const std::string after = " stitches over ", between = " mm towards ";
    const size_t width = done.title.find(after), place = done.title.find(" mm, ", width);
    const size_t towards = done.title.find(between, place);
    REQUIRE(towards != std::string::npos);
    const double from_middle = std::strtod(done.title.c_str() + place + 5, nullptr);
    CHECK(done.title.substr(towards + between.size()) == (position > 0 ? "A1" : "A3"));
    // the middle of the valve is x = 0; the first stitch is at the nearest node of the free edge,
    // within half an edge of 2 mm
    const Model &model = *done.current.model;
    const double x = std::abs(model.valve.rest[stitches(model)[0].a][0]);
    CHECK(std::abs(1e-3 * from_middle - x) < 1 * mm);
  }
  CHECK(placed(1).title.find("towards A1") != std::string::npos);
  auto op = clip();
  for (const Scallop &scallop : before.model->valve.scallops)
    if (scallop.name == "A1")
      op.anterior = scallop.id;
    else if (scallop.name == "P1")
      op.posterior = scallop.id;
  op.position = 0.5;
  CHECK(apply(before, op).title.find("towards the anterolateral side") != std::string::npos);
}

TEST_CASE("a_second_clip_has_a_distinct_name") {
  auto op = clip();
  op.position = -0.7;
  op.width = 2 * mm;
  const Operated first = apply(shipped(), op);
  op.position = 0.7;
  const Operated second = apply(first.current, op);
  CHECK(stitches(*second.current.model).back().name.starts_with("clip2"));
  op.name = "clip2";
  refused(second.current, op, MVS_E_OP, "named clip2");
  op.name = "again";
  refused(second.current, op, MVS_E_OP, "joins these two places");
}

TEST_CASE("a_clip_of_one_stitch_has_no_width_in_its_title") {
  auto op = clip();
  op.width = op.reach = 1 * mm;
  const Operated done = apply(shipped(), op);
  REQUIRE(stitches(*done.current.model).size() == 1);
  CHECK(done.title == "Join A2 and P2 by clip, 1 stitch");
}

TEST_CASE("impossible_clips_are_refused") {
  const ModelState valve = shipped();
  const Valve &parts = valve.model->valve;
  auto op = clip();
  op.posterior = parts.scallops[0].id;
  op.anterior = parts.scallops[1].id;
  refused(valve, op, MVS_E_OP, "belong to the same leaflet");
  op = clip();
  op.anterior = parts.heads[0].id;
  refused(valve, op, MVS_E_ID, "not a scallop");
  op = clip();
  op.position = 1.5;
  refused(valve, op, MVS_E_ARGUMENT, "position is 1.5");
  op = clip();
  op.width = 1e-4;
  refused(valve, op, MVS_E_ARGUMENT, "width is 0.0001 m");
  Valve renamed = parts;
  for (Scallop &scallop : renamed.scallops) scallop.name += "x";
  const ModelPtr model = make_model(renamed);
  refused({model, initial_state(*model)}, clip(), MVS_E_ID,
          "no scallop named A2: say which one you mean; there are A");
}

}  // namespace mvs::core::test
