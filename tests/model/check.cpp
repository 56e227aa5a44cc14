// Model checks: each fault, made on purpose in a valid valve, is reported, and no other fault is.
#include <doctest/doctest.h>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "base/error.h"
#include "model/checks/check.h"
#include "model/model.h"
#include "tests/model/spoiled.h"

using namespace mvs::core;
using namespace mvs::core::spoiled;

namespace {

Chord chord_between(uint32_t a, uint32_t b) {
  Chord chord;
  chord.a = a;
  chord.b = b;
  return chord;
}

}  // namespace

TEST_CASE("a_valid_valve_has_no_fault") {
  size_t count = 1;
  CHECK(faults_after([](Valve &) {}, &count) == "");
  CHECK(count == 0);
  // and the completed valve stays valid
  CHECK(find_faults(make_model(small_valve())->valve).empty());
}

TEST_CASE("missing_lists_are_named") {
  size_t count = 0;
  CHECK(faults_after([](Valve &v) { v = Valve(); }, &count).find("has no nodes") !=
        std::string::npos);
  CHECK(count == 4);  // nodes, triangles, annulus, leaflets
  check_fault("has no annulus nodes", 1, [](Valve &v) { v.annulus.clear(); });
  check_fault("nodes_loaded has 1 entries", 1, [](Valve &v) { v.loaded.resize(1); });
  check_fault("triangle_leaflet has 1 entries", 1, [](Valve &v) { v.triangle_leaflet.resize(1); });
  check_fault("triangle_scallop has 0 entries", 1, [](Valve &v) {
    v.scallops.push_back({0, "A2", 0});
  });
  check_fault("triangle_thickness has 1", 1, [](Valve &v) { v.triangle_thickness = {1e-3}; });
  check_fault("triangle_fibre has 1", 1, [](Valve &v) { v.triangle_fibre.resize(1); });
  check_fault("the limit is", 1, [](Valve &v) { v.annulus.resize((1u << 24) + 1); });
}

TEST_CASE("indices_out_of_range_are_named") {
  check_fault("triangle 3: triangle 3 names node 4000000000", 1,
              [](Valve &v) { v.triangles[3][1] = 4000000000u; });
  check_fault("triangle 3 names leaflet 2", 1, [](Valve &v) { v.triangle_leaflet[3] = 2; });
  check_fault("scallop 0 names leaflet 9", 1, [](Valve &v) {
    v.scallops = {{0, "A2", 9}};
    v.triangle_scallop.assign(v.triangles.size(), 0);
  });
  check_fault("triangle 0 names scallop 7", 1, [](Valve &v) {
    v.scallops = {{0, "A2", 0}};
    v.triangle_scallop.assign(v.triangles.size(), 0);
    v.triangle_scallop[0] = 7;
  });
  check_fault("annulus entry 2 names node", 1, [](Valve &v) { v.annulus[2] = none; });
  check_fault("chord 1 names node", 1, [](Valve &v) { v.chords[1].b = none; });
  check_fault("chord 1 names node", 1, [](Valve &v) { v.chords[1].a = head + 4; });
  check_fault("papillary head 1 names node", 1, [](Valve &v) { v.heads[1].node = none; });
}

TEST_CASE("impossible_coordinates_are_named") {
  check_fault("node 5 has a rest coordinate", 1, [](Valve &v) { v.rest[5][1] = not_a_number; });
  check_fault("node 5 has a rest coordinate", 1, [](Valve &v) { v.rest[5][1] = 1e200; });
  check_fault("node 5 has a rest coordinate", 1,
              [](Valve &v) { v.rest[5][2] = -std::numeric_limits<double>::infinity(); });
  check_fault("node 66 lies", 1, [](Valve &v) { v.rest[66][0] = 3; });
  check_fault("looks like mm given as m", 1, [](Valve &v) {
    for (Vec3 &p : v.rest) p *= 1000;
  });
  check_fault("looks like cm given as m; multiply by 0.01", 1, [](Valve &v) {
    for (Vec3 &p : v.rest) p *= 100;
  });
  check_fault("coordinates are in metres", 1, [](Valve &v) {
    for (Vec3 &p : v.rest) p /= 1000;
  });
  check_fault("node 0 has a position when loaded", 1, [](Valve &v) {
    v.loaded = v.rest;
    v.loaded[0][0] = not_a_number;
  });
  check_fault("node 0 has a position when open", 1, [](Valve &v) {
    v.open = v.rest;
    v.open[0][0] = not_a_number;
  });
  check_fault("other units than nodes", small_segments + 2, [](Valve &v) {
    v.loaded = v.rest;
    for (Vec3 &p : v.loaded) p *= 1000;
  });
}

TEST_CASE("loaded_rows_of_free_nodes_are_ignored") {
  Valve valve = small_valve();
  valve.loaded = valve.rest;
  valve.loaded[edge_row][0] = not_a_number;
  CHECK(find_faults(valve).empty());
  const ModelPtr model = make_model(valve);
  CHECK(model->valve.loaded[edge_row] == model->valve.rest[edge_row]);
}

TEST_CASE("chords_with_bad_ends_are_named") {
  check_fault("to itself", 1, [](Valve &v) { v.chords[1].b = v.chords[1].a; });
  check_fault("joins two papillary heads", 1,
              [](Valve &v) { v.chords.push_back(chord_between(head, head + 2)); });
  check_fault("joins two nodes of the sheet", 1,
              [](Valve &v) { v.chords.push_back(chord_between(edge_row, edge_row + 5)); });
  check_fault("joins the same nodes as chord 3", 1,
              [](Valve &v) { v.chords.push_back(chord_between(v.chords[3].b, v.chords[3].a)); });
  check_fault("has no length", 1, [](Valve &v) { v.rest[head + 1] = v.rest[head]; });
  check_fault("chord 12 ends at node 68", 1, [](Valve &v) {
    v.rest.push_back({0, 0, -20e-3});
    v.chords.push_back(chord_between(head + 1, head + 4));
  });
  check_fault("reach no leaflet", 2, [](Valve &v) {
    v.rest.push_back({0, 0, -20e-3});  // not attached either
    v.chords.push_back(chord_between(head, head + 4));
  });
  check_fault("reach no papillary head", 1, [](Valve &v) { v.chords.erase(v.chords.begin()); });
}

TEST_CASE("nodes_and_heads_out_of_place_are_named") {
  check_fault("node 68 belongs to no triangle", 1, [](Valve &v) { v.rest.push_back({0, 0, 0}); });
  check_fault("papillary head 2 is node 63 of the sheet", 1, [](Valve &v) {
    v.heads.push_back({0, "", head - 1});
  });
  check_fault("is another head", 1, [](Valve &v) { v.heads.push_back({0, "", head}); });
}

TEST_CASE("names_and_ids_are_checked") {
  check_fault("leaflet 1 has no name", 1, [](Valve &v) { v.leaflets[1].name.clear(); });
  check_fault("leaflet 1 has the same name as leaflet 0, \"A\"", 1,
              [](Valve &v) { v.leaflets[1].name = "A"; });
  check_fault("has 64 bytes", 1, [](Valve &v) { v.chords[0].name = std::string(64, 'x'); });
  check_fault("control character", 1, [](Valve &v) { v.heads[0].name = "a\nb"; });
  check_fault("the name of the valve", 1, [](Valve &v) { v.name.clear(); });
  check_fault("chord 0 has id 7, which another part has", 1, [](Valve &v) {
    v.chords[0].id = 7;
    v.heads[0].id = 7;
  });
  check_fault("ids are below", 1, [](Valve &v) { v.chords[0].id = UINT64_MAX; });
}

TEST_CASE("impossible_materials_are_named") {
  check_fault("leaflet A has thickness 1 m", 1, [](Valve &v) { v.leaflets[0].thickness = 1; });
  check_fault("low modulus", 1, [](Valve &v) { v.leaflets[0].constants[0] = -1; });
  check_fault("high modulus", 1, [](Valve &v) { v.leaflets[0].constants[1] = not_a_number; });
  check_fault("follows law 7", 1,
              [](Valve &v) { v.leaflets[0].law = static_cast<LeafletLawId>(7); });
  check_fault("its law (spring) has only 3", 1, [](Valve &v) { v.leaflets[0].constants[3] = 1; });
  check_fault("constant c2", 1, [](Valve &v) {
    v.leaflets[0].law = LeafletLawId::fung;
    v.leaflets[0].constants = {1e3, 124, -4.6};
  });
  check_fault("follows law 5", 1, [](Valve &v) { v.chords[2].law = static_cast<ChordLawId>(5); });
  check_fault("give both, or neither", 1, [](Valve &v) {
    v.chords[2].law = ChordLawId::ogden;
    v.chords[2].constants = {1e6, 10, 1e6, 0, 0, 0};
  });
  check_fault("has no positive stiffness", 1, [](Valve &v) {
    v.chords[2].law = ChordLawId::ogden;
    v.chords[2].constants = {-1e6, 10, 0, 0, 0, 0};
  });
  check_fault("names curve 1, but there are 1", 1, [](Valve &v) {
    v.chords[2].law = ChordLawId::table;
    v.chords[2].constants = {1};
    v.curves = {{0, "c", {{0, 0}, {0.1, 1e6}}}};
  });
  check_fault("it needs 2 at least", 1, [](Valve &v) { v.curves = {{0, "c", {{0, 0}}}}; });
  check_fault("starts at strain", 1, [](Valve &v) { v.curves = {{0, "c", {{0, 5}, {0.1, 1e6}}}}; });
  check_fault("does not rise at point 1", 1, [](Valve &v) {
    v.curves = {{0, "c", {{0, 0}, {0.1, -1}}}};
  });
  check_fault("kink strain", 1, [](Valve &v) { v.leaflets[0].constants[2] = 25; });
  check_fault("law 9", 1, [](Valve &v) { v.leaflets[0].law = static_cast<LeafletLawId>(9); });
  check_fault("chord 2 follows law 9", 1,
              [](Valve &v) { v.chords[2].law = static_cast<ChordLawId>(9); });
  check_fault("is of kind 99", 1, [](Valve &v) { v.chords[2].kind = static_cast<ChordKind>(99); });
  check_fault("mm2 given as m2", 1, [](Valve &v) { v.chords[2].area = 0.785; });
  check_fault("Young's modulus", 1, [](Valve &v) { v.chords[2].young = 0; });
  check_fault("outside 1e-06 to 1: too small, or not a number", 1,
              [](Valve &v) { v.chords[2].rest_length = not_a_number; });
  check_fault("has rest length 1e-09 m", 1, [](Valve &v) { v.chords[2].rest_length = 1e-9; });
  check_fault("looks like MPa or GPa given as Pa", 1,
              [](Valve &v) { v.leaflets[0].constants[0] = 0.1; });
  check_fault("chord s has rest length 20 m", 1, [](Valve &v) {
    v.chords[2].rest_length = 20;
    v.chords[2].name = "s";
  });
  check_fault("looks like g/cm3 given as kg/m3", 1, [](Valve &v) { v.density = 1.06; });
  check_fault("contact thickness", 1, [](Valve &v) { v.contact_thickness = 0.6; });
  check_fault("contact stiffness", 1, [](Valve &v) { v.contact_stiffness = -1; });
  check_fault("bending scale", 1, [](Valve &v) { v.bending_scale = -1; });
  check_fault("triangle 3 has thickness 0.65 m", 1, [](Valve &v) {
    v.triangle_thickness.assign(v.triangles.size(), 1e-3);
    v.triangle_thickness[3] = 0.65;
  });
}

TEST_CASE("every_fault_is_listed") {
  check_fault("chord 2 has area", 4, [](Valve &v) {
    std::swap(v.triangles[20][0], v.triangles[20][1]);
    v.chords[2].area = 0.785;
    v.density = 0;
    v.heads.push_back({0, "", head});
  });
}

TEST_CASE("make_model_throws_the_first_fault") {
  Valve valve = small_valve();
  valve.triangles[3][1] = 4000;
  try {
    make_model(valve);
    CHECK(false);
  } catch (const Error &error) {
    CHECK(error.code == MVS_E_OP);
    CHECK(error.part == "triangle 3");
  }
}

TEST_CASE("a_valve_of_three_leaflets_is_valid") {
  Valve valve = small_valve();
  valve.leaflets.push_back({0, "septal"});
  for (size_t t = 0; t < valve.triangles.size(); ++t) {
    valve.triangle_leaflet[t] = static_cast<uint32_t>(3 * (t % 32) / 32);
  }
  CHECK(find_faults(valve).empty());
}
