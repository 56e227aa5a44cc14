// Every fault of Abaqus input is reported with its line and a sentence.
#include "tests/formats/inp_text.h"

using namespace mvs::core;

namespace {

struct Fault {
  int32_t line = -1;
  std::string sentence;
};

Fault fault_of(const std::string &text) {
  try {
    read_inp(text);
  } catch (const Error &error) {
    CHECK(error.code == MVS_E_FORMAT);
    return {error.line, error.what()};
  }
  return {};
}

void check_text(const std::string &text, int32_t line, const std::string &wanted) {
  const Fault fault = fault_of(text);
  CAPTURE(wanted);
  CAPTURE(fault.sentence);
  CHECK(fault.line == line);
  CHECK(fault.sentence.find(wanted) != std::string::npos);
}

// Changes a piece of text that occurs in one place, and expects a fault in its first line (plus
// `below`).
void check_fault(const std::string &old, const std::string &with, const std::string &wanted,
                 int32_t below = 0) {
  CAPTURE(with);
  check_text(toy_with(old, with), toy_line(old) + below, wanted);
}

}  // namespace

TEST_CASE("inp_faults_of_lines") {
  check_text("", 0, "no keyword");
  check_text("1, 2, 3\n*NODE\n", 1, "`1, 2, 3` stands before the first keyword");
  check_text("*\n", 1, "a keyword has to follow the star");
  check_text("*NODE\n*INCLUDE, INPUT=other.inp\n", 2, "*INCLUDE is not followed: paste");
  check_text("*NODE, NSET=A, nset=B\n", 1, "parameter `NSET` of *NODE is given twice");
  check_text("*NODE\n" + std::string(70000, '1') + "\n", 2, "the line has 70000 bytes");
  check_text("** units: mm\n*NODE\n", 1, "units need one of length and one of stress");
  check_text("** units: mm psi\n*NODE\n", 1, "`PSI` is neither");
  check_text("** units: mm cm MPa\n*NODE\n", 1, "`CM` is neither");
}

TEST_CASE("inp_faults_of_nodes_and_elements") {
  check_fault("\n101, 12.000000", "\n101, twelve", "`twelve` is not a number; a coordinate", 1);
  check_fault("\n101, 12.0", "\n101., 12.0", "`101.` is not a whole number; a node number", 1);
  check_fault("999, 0., 0., -30.", "999, 0., 0.", "the line ends where a coordinate is needed");
  check_fault("999, 0., 0., -30.", "902, 0., 0., -30.", "stands in line 44 already, with other");
  check_fault("\n1, 101, 201, 202, 102", "\n1, 101, 201, 202", "ends where a node number", 1);
  check_fault("\n1, 101, 201, 202, 102", "\n1, 101, 201, 202, 102, 103", "more than 4 nodes", 1);
  check_fault("\n1, 101, 201, 202, 102", "\n1, 101, 201, 202, 77", "node 77 is not in the file", 1);
  check_fault("\n1, 101, 201, 202, 102", "\n3, 101, 201, 202, 102", "element 3 stands in line", 4);
  check_fault("\n1, 101, 201, 202, 102", "\n1, 101, 202, 201, 102", "element 1 is folded", 1);
  check_fault("\n1, 101, 201, 202, 102", "\n1, 101, 201, 101, 102", "fewer than 3 corners", 1);
  check_fault("101, 901, 911", "101, 901, 901", "truss 101 joins a node with itself");
}

TEST_CASE("inp_faults_of_parts_and_instances") {
  check_fault("*End Part", "*End Part\n*Part, name=Second", "a second *PART", 1);
  check_fault("*End Instance", "*End Instance\n*Instance, name=S-2, part=Sheet",
              "a second *INSTANCE", 1);
  check_fault("*End Instance", "0., 0., 5.\n*End Instance", "moved or turned");
}

TEST_CASE("inp_faults_of_sets") {
  check_fault("Annulus, HEADS", "Annulus, HEDAS", "the file has no set of nodes `HEDAS`");
  check_fault(" 901, 902,", " 901, 9020,", "node 9020 is not in the file");
  check_fault("101, 112, 1\n", "101, 113, 1\n", "node 113 is not in the file");
  check_fault("101, 112, 1\n", "112, 101, 1\n", "from 112 to 101 in steps of 1 is not a range");
  check_fault("101, 112, 1\n", "101, 112, 0\n", "`0` is not a step");
  check_fault("*NSET, NSET=Annulus, GENERATE", "*NSET, GENERATE", "*NSET lacks NSET=");
  std::string often = "101, 112, 1\n";
  for (int k = 0; k < 200; ++k) often += "101, 112, 1\n";
  CHECK_THROWS_WITH_AS(read_inp(toy_with("101, 112, 1\n", often)),
                       doctest::Contains("the set names more than ten times the nodes of the file"),
                       Error);
  check_fault("Sheet-1.Annulus, 3, 3, 0.25", "Sheet-2.Annulus, 3, 3, 0.25", "no set of nodes");
}

TEST_CASE("inp_faults_of_sections_and_orientations") {
  check_fault("elset=Septal_Leaflet_Elements, material=Neo", "elset=Septum, material=Neo",
              "no set of elements `SEPTUM`");
  check_fault("material=Neo", "material=Meo", "no material `MEO`");
  check_fault("orientation=Ori\n", "orientation=Ari\n", "no orientation `Ari`");
  check_fault(".8\n", "thick\n", "`thick` is not a number; thickness");
  check_fault("elset=Septal_Leaflet_Elements, material=Neo",
              "elset=Anterior_Leaflet_Elements, material=Neo", "has a section in line");
  check_fault("*Solid Section, elset=Thick,", "*Solid Section, elset=Thin,", "has a section", 2);
  check_fault("elset=Thin,", "elset=Anterior_Leaflet_Elements,", "is not a truss, as the section");
  check_text(toy_with("*Solid Section, elset=Thin, material=Wire\n0.25\n", ""),
             toy_line("107, 921, 302"), "element 107 has no section");
  check_fault("*Shell Section, elset=Septal", "*Shell Section, composite, elset=Septal",
              "with COMPOSITE is not read");
  check_fault("3, 90.", "1, 90.", "axis 3");
  check_fault("system=RECTANGULAR", "system=CYLINDRICAL", "RECTANGULAR by COORDINATES");
  check_fault("1, 0., 1., 0., 0., 0., 1.", "1, 0., 1., 0., 0., 2., 0.",
              "the two directions are parallel");
  check_fault("1, 0., 1., 0., 0., 0., 1.", "1000, 0., 1., 0., 0., 0., 1.", "element 1000 is not");
  check_fault("location=ELEMENT", "location=NODE", "LOCATION=ELEMENT");
}

TEST_CASE("inp_faults_of_materials") {
  check_fault("*Elastic\n0.3, 0.45", "*Elastic, type=LAMINA\n0.3, 0.45",
              "TYPE=`LAMINA` is not read");
  check_fault("*Hyperelastic, neo hooke", "*Hyperelastic, yeoh", "`YEOH` is not read: known are");
  check_fault("*Hyperelastic, neo hooke", "*Hyperelastic, neo hooke, test data input", "test data");
  check_fault("OGDEN, N=3", "OGDEN, N=4", "N=1 to 3");
  check_fault("properties=4", "properties=7", "USER, PROPERTIES=4 alone");
  check_fault("0.001, 20., 0.000124, 4.5", "0.001, 20.", "has 2 constants, it needs 4", -1);
  check_fault("*Material, name=Soft", "*Material, name=Neo", "material `NEO` stands in line");
  check_fault("*Elastic\n40., 0.3", "*Elastic\n40., 0.3\n*Elastic\n40., 0.3", "two laws", 2);
  check_text("*Elastic\n1., 0.3\n", 1, "*ELASTIC stands before any *MATERIAL");
  check_text(toy_with("*Elastic\n0.3, 0.45\n", ""), toy_line("*Material, name=Soft"),
             "material `SOFT` has no law, which a leaflet cannot follow: known are");
  check_text(toy_with("material=Soft", "material=Collagen"), toy_line("*Hyperelastic, OGDEN"),
             "has *HYPERELASTIC, OGDEN, which a leaflet cannot follow");
  check_text(toy_with("material=Wire", "material=Fung"), toy_line("*Anisotropic Hyperelastic"),
             "has the user material, which a chord cannot follow");
}

TEST_CASE("inp_faults_of_loads") {
  check_fault("*Boundary, op=NEW, amplitude=Ramp", "*Boundary, op=NEW, amplitude=Romp",
              "no amplitude `Romp`");
  check_fault("*Boundary, op=NEW, amplitude=Ramp", "*Boundary, type=VELOCITY",
              "give displacements");
  check_fault("*Boundary, op=NEW, amplitude=Ramp", "*Boundary, op=OLD", "neither NEW nor MOD");
  check_fault("Sheet-1.Annulus, 3, 3, 0.25", "Sheet-1.Annulus, 3, 2, 0.25", "are 1 to 6");
  check_fault("definition=SMOOTH STEP", "definition=PERIODIC", "TABULAR or SMOOTH STEP");
  check_fault("Wet, P, 0.0030", "Dry, P, 0.0030", "no surface `Dry`");
  check_fault("Wet, P, 0.0030", "Wet, P, much", "`much` is not a number; a pressure");
  check_fault("Sheet-1.All_Leaflets, SPOS", "Sheet-1.All_Leaflets, TOP", "`TOP` is not a side");
  check_fault("type=ELEMENT, name=Wet", "type=NODE, name=Wet", "ELEMENT is");
  check_fault("maxratio=0.6", "maxratio=0", "MAXRATIO has to be above 0");
  check_text(toy_with("Wet, P, 0.0030", "Wet, P, 30."), 0, "the pressure is 3e+07 Pa");
}

TEST_CASE("inp_faults_of_the_whole") {
  // every node of the thick trusses is held
  check_text(toy_with("*NSET, NSET=Held\n", "*NSET, NSET=Heads, ELSET=Thick\n*NSET, NSET=Held\n"),
             toy_line("101, 901, 911"), "joins two papillary heads");
  check_text(toy_with(".8\n", "80.\n"), toy_line("*Shell Section, elset=Septal"),
             "leaflet Septal has thickness 0.08 m");
  // one node of the annulus is not prescribed
  check_text(toy_with("101, 112, 1\n", "101, 111, 1\n"), toy_line("112, 10.39"),
             "has 11 of its 12 nodes prescribed, but not node 112");
  check_text(toy_with("Sheet-1.Heads, ENCASTRE", "Sheet-1.901, ENCASTRE"),
             toy_line("103, 902, 912"), "reach no papillary head");
  // a free edge with prescribed nodes
  check_text(toy_with("Sheet-1.Heads, ENCASTRE",
                      "Sheet-1.Heads, ENCASTRE\n301, PINNED\n302, PINNED\n303, PINNED\n"
                      "304, PINNED\n305, PINNED\n306, PINNED\n307, PINNED\n308, PINNED\n"
                      "309, PINNED\n310, PINNED\n311, PINNED\n312, PINNED"),
             toy_line("301, 7.0"), "two loops of the sheet's boundary are prescribed");
  check_text("*NODE\n1, 0., 0., 0.\n", 0, "no *SHELL SECTION");
}

namespace {

// Returns a valve, or a clean error.
void check_outcome(const std::string &text) {
  try {
    const Imported imported = read_inp(text);
    CHECK(make_model(imported.loaded.valve)->node_count() > 0);
  } catch (const Error &error) {
    CHECK(error.code == MVS_E_FORMAT);
    CHECK(error.what()[0] != '\0');
  }
}

}  // namespace

TEST_CASE("inp_any_cut_or_changed_byte_gives_a_valve_or_a_clean_error") {
  const std::string text = toy_inp();
  for (size_t at = 0; at < text.size(); ++at) {
    check_outcome(text.substr(0, at));
    // one change a place, a different one from place to place
    std::string other = text;
    other[at] = "*,=0-.9 A\n"[at % 10];
    check_outcome(other);
  }
}

TEST_CASE("inp_any_missing_line_gives_a_valve_or_a_clean_error") {
  const std::string text = toy_inp();
  for (size_t at = 0; at < text.size();) {
    const size_t stop = text.find('\n', at) + 1;
    check_outcome(text.substr(0, at) + text.substr(stop));
    at = stop;
  }
}
