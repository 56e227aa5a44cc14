// Abaqus input to a valve: import of the toy valve of three leaflets.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <set>
#include <string>

#include "model/model.h"
#include "tests/about.h"
#include "tests/formats/inp_text.h"

using namespace mvs::core;
using mvs::core::test::about;

namespace {

Valve toy() {
  return make_model(read_inp(toy_inp()).loaded.valve)->valve;
}

const Chord &chord_between(const Valve &valve, uint32_t a, uint32_t b) {
  for (const Chord &chord : valve.chords) {
    if (chord.a == a && chord.b == b) return chord;
  }
  FAIL("no such chord");
  return valve.chords[0];
}

}  // namespace

TEST_CASE("inp_rows_are_the_kept_nodes_in_the_order_of_the_file") {
  const Valve valve = toy();
  // 36 of the sheet, 3 heads, and the branch points 921 to 923; not 911 to 913, inside cables
  REQUIRE(valve.rest.size() == 42);
  CHECK(valve.name == "Three leaflets, slack trusses");
  CHECK(valve.rest[0] == Vec3(12e-3, 0, 0));
  CHECK(valve.rest[12] == Vec3(10e-3, 0, -5e-3));
  CHECK(valve.rest[36].z() == -22e-3);
  CHECK(valve.rest[39].z() == -16e-3);
  CHECK(valve.heads.size() == 3);
  CHECK(valve.heads[0].node == 36);
}

TEST_CASE("inp_quads_are_split_along_their_shorter_diagonal") {
  const Valve valve = toy();
  // 20 quads, 3 triangles, and a quad with a repeated corner
  CHECK(valve.triangles.size() == 2 * 20 + 2 * 4);
  // the first one has the corners 101, 201, 202, 102: rows 0, 12, 13, 1
  const double first = (valve.rest[13] - valve.rest[0]).norm();
  const double second = (valve.rest[1] - valve.rest[12]).norm();
  const std::set<uint32_t> corners(valve.triangles[0].begin(), valve.triangles[0].end());
  CHECK(corners.contains(12));
  CHECK(corners.contains(second < first ? 1 : 13));
}

TEST_CASE("inp_the_longer_diagonal_is_never_an_edge") {
  // node 202 moved towards 101 makes the diagonal from 101 to 202 the shorter one
  const std::string text = toy_with("202, 8.660254, 5.000000, -5.0", "202, 10.5, 3., -3.5");
  const Valve valve = read_inp(text).loaded.valve;
  const double first = (valve.rest[13] - valve.rest[0]).norm();
  const double second = (valve.rest[1] - valve.rest[12]).norm();
  REQUIRE(first < second);
  for (const int k : {0, 1}) {
    const std::set<uint32_t> corners(valve.triangles[k].begin(), valve.triangles[k].end());
    CHECK(corners.contains(0));
    CHECK(corners.contains(13));
  }
}

TEST_CASE("inp_leaflets_are_the_sections_with_their_laws_in_pascal") {
  const Valve valve = toy();
  REQUIRE(valve.leaflets.size() == 3);
  CHECK(valve.leaflets[0].name == "Anterior");
  CHECK(valve.leaflets[0].law == LeafletLawId::fung);
  CHECK(valve.leaflets[0].thickness == 0.65e-3);
  CHECK(valve.leaflets[0].constants[0] == about(1000, rounding));
  CHECK(valve.leaflets[0].constants[1] == about(124, rounding));
  CHECK(valve.leaflets[0].constants[2] == 4.5);
  CHECK(valve.leaflets[1].name == "Septal");
  CHECK(valve.leaflets[1].law == LeafletLawId::neo_hookean);
  CHECK(valve.leaflets[1].constants[0] == about(40e3, rounding));  // 2 C10
  CHECK(valve.leaflets[2].name == "Posterior");
  CHECK(valve.leaflets[2].law == LeafletLawId::neo_hookean);
  CHECK(valve.leaflets[2].constants[0] == about(100e3, rounding));  // E / 3
  CHECK(valve.density == 1050);
}

TEST_CASE("inp_normals_point_into_the_atrium_and_the_pressure_comes_from_below") {
  const Loaded loaded = read_inp(toy_inp()).loaded;
  for (const Tri &t : loaded.valve.triangles) {
    const Vec3 &p = loaded.valve.rest[t[0]];
    const Vec3 normal = (loaded.valve.rest[t[1]] - p).cross(loaded.valve.rest[t[2]] - p);
    CHECK(normal.dot(Vec3(-p.x(), -p.y(), 30e-3)) > 0);
  }
  // the file's normals point into the ventricle, and P on SPOS pushes against them
  CHECK(loaded.state.load.pressure == about(3000, rounding));
  CHECK(loaded.state.load.boundary_fraction == 1);
  CHECK(read_inp(toy_with("All_Leaflets, SPOS", "All_Leaflets, SNEG")).loaded.state.load.pressure ==
        about(-3000, rounding));
}

TEST_CASE("inp_a_sheet_of_the_other_winding_gives_the_same_valve") {
  std::string text = toy_inp();
  // one element against all others: the first one
  const std::string piece = "\n1, 101, 201, 202, 102\n";
  text.replace(text.find(piece), piece.size(), "\n1, 101, 102, 202, 201\n");
  const Imported imported = read_inp(text);
  CHECK(make_model(imported.loaded.valve)->valve.triangles.size() == 48);
  CHECK(has_note(imported, "46 of 48 triangles turned"));
  // its pressure opposes that of the others, which is reported
  CHECK(has_note(imported, "the pressure is not the same everywhere (-3000 to 3000 Pa"));
}

TEST_CASE("inp_the_annulus_is_the_prescribed_loop_and_moves_to_the_files_positions") {
  const Valve valve = toy();
  REQUIRE(valve.annulus.size() == 12);
  for (uint32_t k = 0; k < 12; ++k) {
    CHECK(valve.annulus[k] < 12);
    const Vec3 moved = valve.loaded[valve.annulus[k]] - valve.rest[valve.annulus[k]];
    // 0.25 mm, by an amplitude that ends at 2
    CHECK((moved - Vec3(0, 0, 0.5e-3)).norm() < 1e-17);
  }
  for (const Head &head : valve.heads) CHECK(valve.loaded[head.node] == valve.rest[head.node]);
}

TEST_CASE("inp_chains_of_trusses_are_cables_with_their_slack") {
  const Valve valve = toy();
  REQUIRE(valve.chords.size() == 12);
  const Chord &trunk = chord_between(valve, 36, 39);
  CHECK(trunk.kind == ChordKind::trunk);
  CHECK(trunk.law == ChordLawId::ogden);
  CHECK(trunk.area == 0.5e-6);
  CHECK(trunk.constants[0] == about(4e6, rounding));
  CHECK(trunk.constants[1] == 50);
  CHECK(trunk.constants[5] == 70);
  // the path by node 911, from the coordinates of the file
  const Vec3 head = valve.rest[36], branch = valve.rest[39];
  const Vec3 between(3.5e-3, head.y(), -19.5e-3);
  CHECK(trunk.rest_length == about((between - head).norm() + (branch - between).norm(), rounding));
  CHECK(trunk.rest_length > 1.04 * (branch - head).norm());
  const Chord &marginal = chord_between(valve, 39, 25);
  CHECK(marginal.kind == ChordKind::marginal);
  CHECK(marginal.law == ChordLawId::linear);
  CHECK(marginal.young == about(40e6, rounding));
  CHECK(chord_between(valve, 36, 14).kind == ChordKind::rough_zone);
}

TEST_CASE("inp_two_cables_between_the_same_ends_keep_their_nodes") {
  // a second path from head 901 to branch point 921, by node 999
  const Imported imported = read_inp(toy_with("*ELEMENT, TYPE=T3D2, ELSET=Thin",
                                              "190, 901, 999\n191, 999, 921\n"
                                              "*ELEMENT, TYPE=T3D2, ELSET=Thin"));
  const Valve valve = make_model(imported.loaded.valve)->valve;
  CHECK(valve.rest.size() == 43);
  CHECK(valve.chords.size() == 14);
}

TEST_CASE("inp_fibres_are_the_first_local_direction_in_the_plane") {
  const Valve valve = read_inp(toy_inp()).loaded.valve;
  REQUIRE(valve.triangle_fibre.size() == valve.triangles.size());
  for (size_t t = 0; t < valve.triangles.size(); ++t) {
    const Vec3 &p = valve.rest[valve.triangles[t][0]];
    const Vec3 normal = (valve.rest[valve.triangles[t][1]] - p)
                            .cross(valve.rest[valve.triangles[t][2]] - p)
                            .normalized();
    const Vec3 &fibre = valve.triangle_fibre[t];
    CHECK(std::abs(fibre.norm() - 1) < 4 * rounding);
    CHECK(std::abs(fibre.dot(normal)) < 4 * rounding);
    if (valve.triangle_leaflet[t] != 0) continue;
    // axes turned by 90 degrees, fibres along minus the second: the first axis again
    const Vec3 axis = t < 2 ? Vec3::UnitY() : Vec3::UnitX();
    const Vec3 flat = axis - axis.dot(normal) * normal;
    CHECK((fibre - flat.normalized()).norm() < 1e-14);
  }
}

TEST_CASE("inp_contact_is_reduced_where_elements_are_smaller_than_the_shell_thickness") {
  CHECK(read_inp(toy_inp()).loaded.valve.contact_thickness == 0.8e-3);
  // a hundredth of the shortest line of each element
  const Imported reduced = read_inp(toy_with("maxratio=0.6", "maxratio=0.01"));
  CHECK(reduced.loaded.valve.contact_thickness < 0.08e-3);
  CHECK(reduced.loaded.valve.contact_thickness > 0.03e-3);
  CHECK(has_note(reduced, "which reduces 26 of 26 shells"));
}

TEST_CASE("inp_the_texas_tricuspid_valve_is_imported") {
  const char *folder = std::getenv("MVS_TEST_DATA");
  const std::string path = (folder ? std::string(folder) : MVS_SOURCE_DIR "/../shared/data") +
                           "/texas_trivalve_1.1_healthy/Healthy_QuasiStatic.inp";
  if (!std::ifstream(path)) {
    MESSAGE("skipped: ", path, " is not there");
    return;
  }
  const Imported imported = read_inp(read_whole_file(path));
  const Valve valve = make_model(imported.loaded.valve)->valve;
  // stated in the README of the data set
  CHECK(valve.triangles.size() == 2 * 8283);
  CHECK(valve.annulus.size() == 244);
  CHECK(valve.heads.size() == 32);
  CHECK(valve.leaflets.size() == 3);
  CHECK(imported.loaded.state.load.pressure == about(3060, rounding));
  // node n of the file is row n - 1, so that its result frames compare node to node
  CHECK(valve.rest[0] == Vec3(-8.164562e-3, 8.880193e-3, 1.297155e-3));
  CHECK(valve.rest[8586] == Vec3(-2.117846e-3, 1.173931e-2, -4.900901e-3));
  double farthest = 0;
  for (const uint32_t node : valve.annulus) {
    CHECK(node < 8587);
    farthest = std::max(farthest, (valve.loaded[node] - valve.rest[node]).norm());
  }
  CHECK(farthest == about(1.58e-3, 1e-2));
  // 4166 trusses, of which 2330 nodes join two of a section; 19 cables would double another
  CHECK(valve.chords.size() == 4166 - 2330 + 19);
  CHECK(valve.leaflets[0].constants[2] == 17.75149);
}
