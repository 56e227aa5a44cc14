// Golden files: the writers produce the checked-in bytes, and the document states the defaults of
// the code.
#include "formats/text/decimal.h"
#include "tests/formats/samples.h"

using namespace mvs::core;

namespace {

const std::string data = MVS_SOURCE_DIR "/tests/formats/data/";

std::string decimal(double value, int shift = 0) {
  std::string text;
  append_decimal(text, value, shift);
  return text;
}

}  // namespace

// valve.obj is in_motion() as the writer first wrote it; a change of these bytes is a change of the
// format.
TEST_CASE("the_writers_produce_the_golden_files") {
  const std::string text = read_whole_file(data + "valve.obj");
  const Pair pair = complete(read_obj(text));
  CHECK(write_obj(pair.model, pair.state) == text);
  write_golden(data + "valve.vtp", [&] { return write_vtp(pair.model, pair.state, {}); });
  CHECK(write_vtp(pair.model, pair.state, {}) == read_whole_file(data + "valve.vtp"));
}

TEST_CASE("the_defaults_of_the_document_are_those_of_the_code") {
  const std::string document = read_whole_file(MVS_SOURCE_DIR "/formats/FORMAT.md");
  const Valve valve;
  const Leaflet leaflet;
  const Chord chord;
  for (const std::string &said :
       {"`name` " + valve.name + ";", "`next_id` " + std::to_string(valve.next_id) + ",",
        "`density` kg/m3, " + decimal(valve.density) + ";",
        "`contact_thickness` mm, " + decimal(valve.contact_thickness, 3) + ";",
        "`contact_stiffness` Pa, " + decimal(valve.contact_stiffness) + ";",
        "`bending_scale` " + decimal(valve.bending_scale) + " ",
        "`thickness` mm, " + decimal(leaflet.thickness, 3) + ";",
        "`low` Pa, " + decimal(leaflet.constants[0]) + ";",
        "`high` Pa, " + decimal(leaflet.constants[1]) + ";",
        "`kink` strain, " + decimal(leaflet.constants[2]) + ";",
        "`young` Pa, " + decimal(chord.young) + ";",
        "`area` mm2, " + decimal(chord.area, 6) + " "}) {
    CAPTURE(said);
    CHECK(document.find(said) != std::string::npos);
  }
}
