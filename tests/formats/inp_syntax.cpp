// Abaqus input as text: ignored keywords, node sets, units, line ends, parts and steps.
#include <cctype>
#include <fstream>
#include <sstream>
#include <string>

#include "model/model.h"
#include "tests/about.h"
#include "tests/formats/inp_text.h"

using namespace mvs::core;
using mvs::core::test::about;

TEST_CASE("inp_every_ignored_keyword_is_listed_with_its_line") {
  const Imported imported = read_inp(toy_inp());
  for (const char *piece :
       {"*Transverse Shear", "*Friction", "*Dynamic", "*Output, field", "*Surface Behavior"}) {
    CAPTURE(piece);
    CHECK(has_note(imported, "line " + std::to_string(toy_line(piece)) + ": "));
  }
  CHECK(has_note(imported, "`*OUTPUT` is left out: an output request (2 times)"));
  CHECK(has_note(imported, "the bulk modulus of a user material is left out"));
  CHECK(has_note(imported, "prescribed rotations"));
  CHECK(has_note(imported, "taken as mm, MPa, tonne"));
  const Imported unknown = read_inp(toy_with("*Friction\n0.01,", "*Glue, strength=2\n1."));
  CHECK(has_note(unknown, "`*GLUE` is left out: not known to this reader"));
  const Imported parameter = read_inp(toy_with("nlgeom=YES", "nlgeom=YES, inc=7"));
  CHECK(has_note(parameter, "parameter `INC` of `*STEP` is left out"));
  const Imported element = read_inp(
      toy_with("*NSET, NSET=Annulus, GENERATE",
               "*ELEMENT, TYPE=C3D4\n900, 101, 102, 103, 104\n*NSET, NSET=Annulus, GENERATE"));
  CHECK(has_note(element, "an element of type `C3D4` is left out"));
}

TEST_CASE("inp_a_node_set_may_be_defined_by_elements") {
  // the nodes of elements on the annulus, and those alone, by their numbers
  const Valve plain = read_inp(toy_inp()).loaded.valve;
  const Valve same = read_inp(toy_with("*NSET, NSET=Held\nAnnulus, HEADS",
                                       "*NSET, NSET=Thick_Nodes, ELSET=Thick\n*NSET, NSET=Held\n"
                                       "Annulus, Thick_Nodes"))
                         .loaded.valve;
  CHECK(same.rest == plain.rest);
}

TEST_CASE("inp_units_are_those_of_a_comment_in_the_file") {
  const Loaded mpa = read_inp(toy_inp()).loaded;
  // the same valve in mm and kPa, so that the unit of mass is 1 kg
  const std::string text =
      changed(toy_inp(), {{"1.05e-9,", "1.05e-6,"},
                          {"1.2e-9", "1.2e-6"},
                          {"0.001, 20., 0.000124, 4.5", "1., 2e4, 0.124, 4.5"},
                          {"0.02, 0.", "20., 0."},
                          {"0.3, 0.45", "300., 0.45"},
                          {"4., 50., 2., 30., 0.001,", "4e3, 50., 2e3, 30., 1.,"},
                          {"40., 0.3", "4e4, 0.3"},
                          {"P, 0.0030", "P, 3."}});
  const Imported imported = read_inp("** Units: kPa, mm\n" + text);
  CHECK(!has_note(imported, "taken as mm"));
  const Loaded &kpa = imported.loaded;
  CHECK(kpa.valve.rest == mpa.valve.rest);
  CHECK(kpa.valve.density == mpa.valve.density);
  CHECK(kpa.state.load.pressure == about(mpa.state.load.pressure, rounding));
  for (size_t l = 0; l < 3; ++l) {
    for (size_t k = 0; k < 3; ++k) {
      CHECK(kpa.valve.leaflets[l].constants[k] ==
            about(mpa.valve.leaflets[l].constants[k], rounding));
    }
  }
  CHECK(kpa.valve.chords[0].constants[0] == about(mpa.valve.chords[0].constants[0], rounding));
  const Loaded same = read_inp("** UNITS = mm MPa\r\n" + toy_inp()).loaded;
  CHECK(hash_of(*make_model(same.valve), same.state) == hash_of(*make_model(mpa.valve), mpa.state));
}

TEST_CASE("inp_line_ends_case_and_blanks_have_no_effect") {
  const Loaded plain = read_inp(toy_inp()).loaded;
  std::string text;
  for (const char c : toy_inp()) {
    text += c == '\n'  ? "\r\n"
            : c == ',' ? "\t, "
                       : std::string(1, static_cast<char>(std::toupper(c)));
  }
  const Loaded other = read_inp(text).loaded;
  CHECK(other.valve.rest == plain.valve.rest);
  CHECK(other.valve.triangles == plain.valve.triangles);
  CHECK(other.valve.loaded == plain.valve.loaded);
}

TEST_CASE("inp_a_file_may_have_no_parts_and_steps_that_extend_the_model") {
  std::stringstream text;
  text << std::ifstream(MVS_SOURCE_DIR "/tests/fuzz/corpus_inp/flat.inp").rdbuf();
  const Loaded loaded = read_inp(text.str()).loaded;
  const Valve &valve = loaded.valve;
  // *DLOAD pushes along the normals of the file, which point into the atrium here
  CHECK(loaded.state.load.pressure == 15e3);
  // pinned before the step, in which one direction of one node is moved
  CHECK((valve.loaded[0] - valve.rest[0] - Vec3(-5e-4, 0, 0)).norm() < 1e-17);
  for (const uint32_t node : {1u, 7u, 16u}) CHECK(valve.loaded[node] == valve.rest[node]);
  CHECK(valve.leaflets[0].law == LeafletLawId::neo_hookean);
  CHECK(valve.leaflets[0].constants[0] == 30e3);
  CHECK(valve.chords[0].law == ChordLawId::ogden);
  CHECK(valve.chords[0].constants[0] == 1e7);
  CHECK(valve.density == 1060);
}

TEST_CASE("inp_a_step_with_op_new_replaces_earlier_conditions") {
  // a second step that holds the same nodes elsewhere, and loads less
  const Imported imported =
      read_inp(toy_inp() +
               "*Step\n*Boundary, op=NEW\nSheet-1.Annulus, 1, 3\nSheet-1.Heads, 3, 3, 0.1\n"
               "*Dsload, op=NEW\nWet, P, 0.001\n*End Step\n");
  const Valve &valve = imported.loaded.valve;
  CHECK(valve.loaded[0] == valve.rest[0]);
  CHECK((valve.loaded[36] - valve.rest[36] - Vec3(0, 0, 1e-4)).norm() < 1e-17);
  CHECK(imported.loaded.state.load.pressure == about(1000, rounding));
  CHECK(has_note(imported, "2 steps: the end of the last one is the load"));
  CHECK(has_note(imported,
                 "a node that is held in some directions is held in all of them (6 times)"));
}
