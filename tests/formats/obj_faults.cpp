// Each fault of an OBJ file is reported with its line and word.
#include <algorithm>

#include "tests/formats/samples.h"

using namespace mvs::core;

namespace {

std::string good_text() {
  static const std::string text = [] {
    const Pair pair = moving_valve();
    return write_obj(pair.model, pair.state);
  }();
  return text;
}

int32_t line_of(const std::string &text, size_t at) {
  return 1 + static_cast<int32_t>(
                 std::count(text.begin(), text.begin() + static_cast<ptrdiff_t>(at), '\n'));
}

struct Fault {
  mvs_result code = MVS_OK;
  int32_t line = 0;
  std::string message;
};

Fault fault_of(const std::string &text) {
  try {
    read_obj(text);
  } catch (const Error &error) {
    return {error.code, error.line, error.what()};
  }
  return {};
}

// Replaces the first `old`, and expects a fault in that line whose sentence contains `wanted`.
void check_fault(const std::string &old, const std::string &instead, const std::string &wanted,
                 mvs_result code = MVS_E_FORMAT) {
  std::string text = good_text();
  const size_t at = text.find(old);
  REQUIRE(at != std::string::npos);
  const int32_t line = line_of(text, at + (old[0] == '\n' ? 1 : 0));
  text.replace(at, old.size(), instead);
  const Fault fault = fault_of(text);
  CAPTURE(instead);
  CAPTURE(fault.message);
  CHECK(fault.code == code);
  CHECK(fault.line == line);
  CHECK(fault.message.find(wanted) != std::string::npos);
}

// The good text with its first vertex line replaced.
void check_vertex_fault(const std::string &line, const std::string &wanted) {
  const std::string text = good_text();
  const size_t start = text.find("\nv ") + 1;
  check_fault(text.substr(start, text.find('\n', start) - start), line, wanted);
}
void check_face_fault(const std::string &line, const std::string &wanted) {
  check_fault("f 1 2 17", line, wanted);
}

}  // namespace

TEST_CASE("invalid_coordinates_are_reported") {
  check_vertex_fault("v 1 2 1e999", "`1e999`");
  check_vertex_fault("v nan 2 3", "`nan` is not a number");
  check_vertex_fault("v 1 inf 3", "`inf`");
  check_vertex_fault("v 1,5 2 3", "the decimal mark is a point");
  check_vertex_fault("v 1 2", "the line ends where a number is needed");
  check_vertex_fault("v", "the line ends");
  check_vertex_fault("v 1 2 3 1", "3 coordinates, or these and 3 colours");
  check_vertex_fault("v 1 2 3 0 0", "3 coordinates");
  check_vertex_fault("v 1 2 3 0 0 red", "`red`");
  check_vertex_fault("v 1 2 3 0 0 0 0", "more than the line should have");
  check_vertex_fault("v 1 2 3\\", "`3\\`");
  check_vertex_fault(std::string("v 1 2 3\0", 8), "`3\\x00`");
  check_vertex_fault("v 1 2 \xff", "`\\xff`");
  check_vertex_fault("v 1 2 3\r4", "\\x0d");
  check_vertex_fault("v 1 2 " + std::string(65, '1'), "...`");
}

TEST_CASE("indices_out_of_range_are_reported") {
  check_face_fault("f 0 2 17", "`0` is not a vertex: the first one is 1");
  check_face_fault("f 1 2 69", "vertex `69` is not one of the 68 above");
  check_face_fault("f 1 2 -69", "vertex `-69` is not one");
  check_face_fault("f 1 2 4294967297", "`4294967297` is not one");
  check_face_fault("f 1 2 99999999999999999999999", "is not a vertex");
  check_face_fault("f 1 2 -9223372036854775808", "is not one of");
  check_face_fault("f 1 2", "the line ends where a vertex is needed");
  check_face_fault("f 1 2 17 18", "triangulate");
  check_face_fault("f 1 2 1.0", "`1.0` is not a vertex");
  check_face_fault("f 1 2 x", "`x` is not a vertex");
  check_face_fault("f 1/ 2 17", "`1/` is not a vertex");
  check_face_fault("f 1/2/ 2 17", "is not a vertex");
  check_face_fault("f 1/2/3/4 2 17", "is not a vertex");
  check_face_fault("f /1 2 17", "is not a vertex");
  check_face_fault("f 1//x 2 17", "is not a vertex");
  check_fault("l 65 66", "l 1", "the line ends where a vertex is needed");
  check_fault("l 65 66", "l", "the line ends");
  check_fault("l 65 66", "l 65 0", "the first one is 1");
  check_fault("#mvs annulus 1 ", "#mvs annulus 1000000000 ", "not one of the 68");
  check_fault("#mvs annulus 1 2", "#mvs annulus 1 2.", "`2.` is not a vertex");
  check_fault("node=65", "node=0", "node=0 is not one");
  check_fault("node=65", "node=69", "node=69 is not one");
  check_fault("node=65", "node=-1", "not a whole number");
  check_fault("node=65", "node=99999999999999999999", "at most 64 bits");
  check_fault(" node=65", "", "lacks node=");
}

TEST_CASE("unknown_words_are_reported") {
  check_fault("\ng A A2", "\nfo 1 2 3\ng A A2", "`fo` is not a statement");
  check_fault("\ng A A2", "\nB A A2", "`B` is not a statement");
  check_fault("#mvs state", "#mvs stat", "#mvs `stat` is not known");
  check_fault("#mvs state", "#mvs", "#mvs `time=0.125`");
  check_fault("boundary_fraction=0.75", "boundary_fraction=1.5", "0 (open) to 1 (loaded)");
  check_fault("boundary_fraction=0.75", "boundary_fraction=-0.1", "0 (open) to 1 (loaded)");
  check_fault("steps=125", "stops=125", "key `stops` is not known");
  check_fault("steps=125", "steps=-1", "`-1` is not a whole number");
  check_fault("steps=125", "steps", "`steps` should be key=value");
  check_fault("steps=125", "=125", "should be key=value");
  check_fault("steps=125", "steps=125 steps=125", "`steps` is given twice");
  check_fault("steps=125", "a=1 b=1 c=1 d=1 e=1 f=1 g=1 h=1 i=1 j=1 k=1 l=1 m=1 n=1 o=1 p=1",
              "too many keys");
  check_fault("kind=trunk", "kind=stem", "known are: other, marginal");
  check_fault("law=linear", "law=hooke", "`hooke` is not known");
  check_fault("law=spring", "law=rubber", "`rubber` is not known");
  check_fault("law=linear", "law=table", "lacks curve=");
  check_fault("law=linear", "law=table curve=B", "no curve `B`");
  check_fault("law=linear", "law=linear mu1=1", "`mu1` is not known");
  check_fault("law=spring", "law=fung", "`low` is not known");
  check_fault("low=100000", "low=100k", "low: `100k` is not a number");
  check_fault("low=100000", "low=1e999", "low: `1e999`");
  check_fault("low=100000", "low=1,5", "the decimal mark is a point");
  check_fault("leaflet name=A", "leaflet name=%4", "%XX");
  check_fault("leaflet name=A", "leaflet name=%zz", "%XX");
  check_fault("leaflet name=A", "leaflet name=\xc3\xa4", "%XX");
  check_fault("leaflet name=A", "leaflet nome=A", "lacks name=");
}

TEST_CASE("groups_that_are_not_leaflets_are_reported_at_their_first_face") {
  std::string text = good_text();
  const size_t at = text.find("\ng A A2");
  const int32_t face = line_of(text, at) + 2;
  const auto check = [&](const std::string &group, const std::string &wanted) {
    std::string changed = text;
    changed.replace(at, 7, group);
    const Fault fault = fault_of(changed);
    CAPTURE(fault.message);
    CHECK(fault.code == MVS_E_FORMAT);
    CHECK(fault.line == face);
    CHECK(fault.message.find(wanted) != std::string::npos);
  };
  check("\ng B A2", "group `B`, which is not a leaflet");
  check("\ng A X", "`X`, is not a scallop");
  check("\ng A", "is not a scallop");
  check("\ng", "in no group");
  check("\ns off", "in no group");
}

TEST_CASE("repeated_and_misplaced_statements_are_reported") {
  const auto twice = [](const std::string &word, const std::string &wanted) {
    std::string text = good_text();
    const size_t start = text.find("#mvs " + word);
    REQUIRE(start != std::string::npos);
    const std::string line = text.substr(start, text.find('\n', start) + 1 - start);
    text.insert(start, line);
    const Fault fault = fault_of(text);
    CAPTURE(word);
    CAPTURE(fault.message);
    CHECK(fault.code == MVS_E_FORMAT);
    CHECK(fault.line == line_of(text, start + line.size()));
    CHECK(fault.message.find(wanted) != std::string::npos);
  };
  twice("1 ", "#mvs `1` is not known");
  twice("valve", "#mvs valve is given twice");
  twice("state", "#mvs state is given twice");
  twice("leaflet", "leaflet `A` is given twice");
  twice("scallop", "scallop `A2` is given twice");
  twice("rest", "rest position of this vertex is given twice");
  twice("loaded", "loaded position of this vertex is given twice");
  twice("open", "open position of this vertex is given twice");
  twice("origin", "origin of this vertex is given twice");
  twice("velocity", "velocity of this vertex is given twice");
  twice("fibre", "fibre of this triangle is given twice");
  twice("thickness", "thickness of this triangle is given twice");
  twice("chord", "this chord is given twice");
  twice("end", "`#mvs` stands after the `#mvs end` line");
  check_fault("#mvs scallop name=A2", "#mvs rest 1 2 3\n#mvs scallop name=A2", "no `v` line above");
  check_fault("#mvs scallop name=A2", "#mvs fibre 1 0 0\n#mvs scallop name=A2", "no `f` line");
  check_fault("#mvs scallop name=A2", "#mvs chord id=1\n#mvs scallop name=A2", "no `l` line");
  check_fault("#mvs scallop name=A2", "#mvs ring_point 1 0 0\n#mvs scallop name=A2",
              "no `#mvs ring`");
  check_fault("#mvs scallop name=A2", "#mvs curve_point 1 0\n#mvs scallop name=A2",
              "no `#mvs curve`");
  check_fault("#mvs origin 4", "#mvs origin 0", "number of a vertex, or new");
  check_fault("leaflet=A", "leaflet=B", "no leaflet `B`");
  check_fault("\nl 65 66", "\n#mvs scallop name=Z leaflet=A\nl 65 66", "above the first f line");
}

TEST_CASE("versions_units_and_spaces_that_do_not_fit_are_told") {
  check_fault("#mvs 1 units=mm", "#mvs 5 units=furlong", "version `5`", MVS_E_VERSION);
  check_fault("#mvs 1 units=mm", "#mvs 99999999999", "version `99999999999`", MVS_E_VERSION);
  check_fault("#mvs 1 units=mm", "#mvs 2 units=mm",
              "the file has version `2`, this libmvs reads version 1", MVS_E_VERSION);
  check_fault("#mvs 1 units=mm", "#mvs 0 units=mm", "version `0`", MVS_E_VERSION);
  check_fault("#mvs 1 units=mm", "#mvs x units=mm", "`#mvs 1 units=mm`");
  check_fault("#mvs 1 units=mm", "#mvs 1", "lacks units=");
  check_fault("#mvs 1 units=mm", "#mvs 1 units=m", "`m` is not known; known are: mm");
  check_fault("#mvs 1 units=mm", "#mvs 1 units=inch", "known are: mm");
  check_fault("SPACE=LPS", "SPACE=RAS", "RAS");
  CHECK(fault_of("v 0 0 0\n#mvs 1 units=mm\n").message.find("above the first v") !=
        std::string::npos);
}

TEST_CASE("wrong_counts_are_reported_without_allocating_them") {
  check_fault("end v=68", "end v=1000000000", "v=1000000000, but the file has 68 v lines");
  check_fault("end v=68", "end v=18446744073709551615", "but the file has 68");
  check_fault("end v=68", "end v=67", "lines were lost or added");
  check_fault("end v=68", "end", "lacks v=");
  check_fault("end v=68", "end v=68 x=1", "`x` is not known");
}

TEST_CASE("a_plain_obj_is_refused_with_the_missing_statement") {
  const Fault plain = fault_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  CHECK(plain.code == MVS_E_FORMAT);
  CHECK(plain.line == 4);
  for (const char *word : {"3 vertices and 1 triangles", "#mvs 1 units=mm", "annulus", "head",
                           "leaflet", "`l HEAD LEAFLET`", "FORMAT.md"}) {
    CHECK(plain.message.find(word) != std::string::npos);
  }
  CHECK(fault_of("").message.find("the file is empty") != std::string::npos);
  CHECK(fault_of("\n\n# hello\n").message.find("no vertices") != std::string::npos);
  CHECK(fault_of("v 0 0 0\n").message.find("no faces") != std::string::npos);
  CHECK(fault_of("solid ascii\n").message.find("`solid`") != std::string::npos);
  CHECK(fault_of("\x89PNG\r\n\x1a\n").message.find("`\\x89PNG`") != std::string::npos);
}

TEST_CASE("an_overlong_line_is_reported") {
  const Fault fault = fault_of("# short\nv " + std::string(100000, '1'));
  CHECK(fault.code == MVS_E_FORMAT);
  CHECK(fault.line == 2);
  CHECK(fault.message.find("the limit is 65536") != std::string::npos);
}

TEST_CASE("more_than_the_limit_is_refused") {
  std::string text = "#mvs 1 units=mm\nv 0 0 0\n", line = "#mvs annulus";
  for (int k = 0; k < 32000; ++k) line += " 1";
  while (text.size() < 9000000) text += line + "\n";
  const Fault fault = fault_of(text);
  CHECK(fault.code == MVS_E_FORMAT);
  CHECK(fault.line == 2 + 4194304 / 32000 + 1);
  CHECK(fault.message.find("the limit is 4194304") != std::string::npos);
}

TEST_CASE("a_next_id_that_leaves_no_room_is_refused") {
  std::string text = good_text();
  const size_t at = text.find("next_id=") + 8;
  text.replace(at, text.find(' ', at) - at, "18446744073709551615");
  CHECK_THROWS_WITH_AS(make_model(read_obj(text).valve), doctest::Contains("ids are below 2^62"),
                       Error);
}
