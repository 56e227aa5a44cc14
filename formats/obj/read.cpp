// Reader of extended OBJ: lines and the statements of plain OBJ.
#include <algorithm>

#include "base/utf8.h"
#include "formats/obj/reader.h"

namespace mvs::core {

Loaded ObjReader::read(std::string_view text) {
  constexpr size_t longest_line = 64 * 1024;
  Line line;
  int32_t number = 0;
  while (!text.empty()) {
    const std::string_view content = take_line(text);
    line = Line(content, ++number);
    if (content.size() > longest_line) {
      line.fail("the line has %zu bytes, the limit is %zu", content.size(), longest_line);
    }
    statement(content, line);
  }
  check_complete(line);
  return std::move(out_);
}

void ObjReader::statement(std::string_view content, Line &line) {
  using namespace std::string_view_literals;
  // statements of other programs that a valve does not use
  static constexpr std::array harmless = {"vn"sv,     "vt"sv, "vp"sv,     "o"sv,      "s"sv,
                                          "usemtl"sv, "mg"sv, "mtllib"sv, "usemap"sv, "maplib"sv};
  const std::string_view word = line.word();
  if (word.empty()) return;
  if (word.starts_with('#') && word != "#mvs") return comment(content, line);
  if (has_end_) line.fail("%s stands after the `#mvs end` line", quoted(word).c_str());
  if (word == "#mvs") return record(line);
  if (word == "v") return vertex(line);
  if (word == "f") return face(line);
  if (word == "l") return segments(line);
  if (word == "g") return group(line);
  if (std::find(harmless.begin(), harmless.end(), word) != harmless.end()) return;
  line.fail("%s is not a statement this reader knows", quoted(word).c_str());
}

// 3D Slicer writes its coordinate system into a comment.
void ObjReader::comment(std::string_view text, const Line &line) {
  if (text.find("SPACE=RAS") == std::string_view::npos) return;
  line.fail(
      "the file is in RAS coordinates, a valve is in LPS: export it as LPS, or change the "
      "sign of every x and y and write SPACE=LPS");
}

void ObjReader::vertex(Line &line) {
  const Vec3 x = read_place(line);
  if (!line.at_end()) {
    // x y z r g b: colours are checked and ignored
    for (int k = 0; k < 3; ++k) {
      if (line.at_end()) line.fail("a vertex has 3 coordinates, or these and 3 colours");
      line.number();
    }
    line.end();
  }
  check_room(out_.state.x, line);
  ++counts_.vertices;
  out_.state.x.push_back(x);
  out_.state.v.push_back(Vec3::Zero());
  out_.valve.rest.push_back(x);
  out_.valve.open.push_back(x);
  out_.valve.loaded.push_back(x);
  out_.valve.origin.push_back(static_cast<uint32_t>(out_.valve.origin.size()));
  given_ = {};
}

void ObjReader::group(Line &line) {
  ++counts_.groups;
  group_ = {line.word(), line.word()};
}

// Looks up the leaflet and scallop of the present group at its first face. A group without faces
// may have any name.
void ObjReader::enter_group(const Line &line) {
  if (group_.leaflet_word.empty()) {
    line.fail("the face is in no group: put `g` and the name of its leaflet above it");
  }
  const auto leaflet = leaflets_.find(decoded(group_.leaflet_word, line));
  if (leaflet == leaflets_.end()) {
    line.fail(
        "the face is in group %s, which is not a leaflet: put `#mvs leaflet name=...` above it",
        quoted(group_.leaflet_word).c_str());
  }
  group_.leaflet = leaflet->second;
  if (scallops_.empty()) return;
  const auto scallop = scallops_.find(decoded(group_.scallop_word, line));
  if (scallop == scallops_.end()) {
    line.fail(
        "the second word of the face's group, %s, is not a scallop: write `g LEAFLET SCALLOP`",
        quoted(group_.scallop_word).c_str());
  }
  group_.scallop = scallop->second;
}

void ObjReader::face(Line &line) {
  Valve &valve = out_.valve;
  check_room(valve.triangles, line);
  Tri triangle;
  for (uint32_t &node : triangle) node = line.vertex(valve.rest.size());
  if (!line.at_end()) line.fail("the face has more than 3 corners: triangulate the mesh");
  ++counts_.faces;
  valve.triangles.push_back(triangle);
  given_.drop(ObjAttribute::thickness);
  // a plain OBJ is read to its end, so that one message can list all missing lines
  if (!has_version_) return;
  if (group_.leaflet == none) enter_group(line);
  valve.triangle_leaflet.push_back(group_.leaflet);
  valve.triangle_thickness.push_back(valve.leaflets[group_.leaflet].thickness);
  if (group_.scallop != none) valve.triangle_scallop.push_back(group_.scallop);
}

void ObjReader::segments(Line &line) {
  Valve &valve = out_.valve;
  Chord chord;
  chord.a = line.vertex(valve.rest.size());
  segments_in_line_ = 0;
  do {
    check_room(valve.chords, line);
    chord.b = line.vertex(valve.rest.size());
    valve.chords.push_back(chord);
    chord.a = chord.b;
    ++segments_in_line_;
  } while (!line.at_end());
  ++counts_.lines;
  given_.drop(ObjAttribute::chord);
}

void ObjReader::check_complete(const Line &last) const {
  if (has_end_) return;
  if (has_version_) last.fail("the file is cut short: its `#mvs end` line is missing");
  if (counts_.vertices == 0 || counts_.faces == 0) {
    last.fail("the file has %s: a valve is a mesh of triangles",
              counts_.vertices == 0 ? "no vertices (v lines)" : "no faces (f lines)");
  }
  last.fail(
      "a plain OBJ of %llu vertices and %llu triangles does not say what they are: add `#mvs %u "
      "units=mm`, `#mvs leaflet name=A`, `#mvs annulus 1 2 ...`, `#mvs head node=N`, chordae as `l "
      "HEAD LEAFLET`, groups `g A` and `#mvs end` as in formats/FORMAT.md",
      static_cast<unsigned long long>(counts_.vertices),
      static_cast<unsigned long long>(counts_.faces), obj::version);
}

Loaded read_obj(std::string_view text) {
  MVS_MUST(!text.empty(), MVS_E_FORMAT, "", "the file is empty");
  MVS_MUST(!text.starts_with("\x89MVS") && !text.starts_with("\x89HDF"), MVS_E_FORMAT, "",
           "the file is HDF5, not OBJ: give it the ending .h5, or load it as MVS_FORMAT_H5");
  if (text.size() > max_file_bytes) {
    throw Error(MVS_E_FORMAT, "",
                format("the file has %zu bytes, the limit is %zu", text.size(), max_file_bytes));
  }
  return ObjReader().read(without_byte_order_mark(text));
}

}  // namespace mvs::core
