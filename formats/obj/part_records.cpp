// Reader of extended OBJ: the #mvs lines of parts of the valve. Some belong to the last v, f or l
// line above.
#include "formats/obj/reader.h"
#include "model/chord_law.h"
#include "model/plausible.h"

namespace mvs::core {
namespace {

void follows(const char *statement, bool is_there, const Line &line) {
  if (!is_there) line.fail("there is no `%s` line above to which this line belongs", statement);
}

// Reads the constants of a law, one key each.
template <typename Values>
void read_constants(Fields &fields, std::span<const Constant> constants, Values &values) {
  for (size_t k = 0; k < constants.size(); ++k) {
    values[k] = constants[k].fallback;
    fields.number(constants[k].key, values[k]);
  }
}

// The name and id of a part that other lines refer to by its name.
template <typename Part>
void read_named(Fields &fields, Part &part) {
  fields.need(fields.text("name", part.name), "name");
  fields.whole("id", part.id);
}

}  // namespace

void ObjReader::leaflet(Line &line) {
  Valve &valve = out_.valve;
  check_room(valve.leaflets, line);
  Leaflet leaflet;
  uint32_t law = 0;
  Fields fields(line);
  read_named(fields, leaflet);
  if (fields.choice("law", law, obj::words_of(leaflet_laws())))
    leaflet.law = static_cast<LeafletLawId>(law + 1);
  fields.number("thickness", leaflet.thickness, obj::mm);
  leaflet.constants = {};
  read_constants(fields, find_leaflet_law(leaflet.law)->constants, leaflet.constants);
  fields.end();
  const auto index = static_cast<uint32_t>(valve.leaflets.size());
  if (!leaflets_.emplace(leaflet.name, index).second) {
    line.fail("leaflet %s is given twice", quoted(leaflet.name).c_str());
  }
  valve.leaflets.push_back(std::move(leaflet));
}

void ObjReader::scallop(Line &line) {
  Valve &valve = out_.valve;
  check_room(valve.scallops, line);
  if (counts_.faces > 0) line.fail("scallops have to be given above the first f line");
  Scallop scallop;
  std::string of;
  Fields fields(line);
  read_named(fields, scallop);
  fields.need(fields.text("leaflet", of), "leaflet");
  fields.end();
  const auto leaflet = leaflets_.find(of);
  if (leaflet == leaflets_.end()) {
    line.fail("there is no leaflet %s above this line", quoted(of).c_str());
  }
  scallop.leaflet = leaflet->second;
  const auto index = static_cast<uint32_t>(valve.scallops.size());
  if (!scallops_.emplace(scallop.name, index).second) {
    line.fail("scallop %s is given twice", quoted(scallop.name).c_str());
  }
  valve.scallops.push_back(std::move(scallop));
}

// Reads x y z of the last vertex, once per kind of vector.
const Vec3 &ObjReader::vector_of_vertex(ObjAttribute attribute, const char *what,
                                        CowVector<Vec3> &vectors, Line &line) {
  follows("v", counts_.vertices > 0, line);
  given_.add(attribute, what, line);
  const Vec3 vector = read_place(line);
  line.end();
  return vectors.back() = vector;
}

void ObjReader::rest(Line &line) {
  Valve &valve = out_.valve;
  const Vec3 rest =
      vector_of_vertex(ObjAttribute::rest, "the rest position of this vertex", valve.rest, line);
  if (!is_near_rest(out_.state.x.back(), rest)) {
    line.fail("the position of this vertex, its `v` line, is over %g m from its rest position",
              most_from_rest);
  }
  if (!given_.has(ObjAttribute::open)) valve.open.back() = rest;
  if (!given_.has(ObjAttribute::loaded)) valve.loaded.back() = rest;
}

void ObjReader::loaded(Line &line) {
  vector_of_vertex(ObjAttribute::loaded, "the loaded position of this vertex", out_.valve.loaded,
                   line);
}

void ObjReader::open(Line &line) {
  vector_of_vertex(ObjAttribute::open, "the open position of this vertex", out_.valve.open, line);
}

// `#mvs origin 17`, or `#mvs origin new` for a node that an operation made.
void ObjReader::origin(Line &line) {
  follows("v", counts_.vertices > 0, line);
  given_.add(ObjAttribute::origin, "the origin of this vertex", line);
  const std::string_view word = line.word();
  uint64_t number = 0;
  if (word == "new") {
    out_.valve.origin.back() = none;
  } else if (parse_whole(word, number) && number >= 1 && number < none) {
    out_.valve.origin.back() = static_cast<uint32_t>(number - 1);
  } else {
    line.fail("the origin is %s: it has to be the number of a vertex, or new",
              quoted(word).c_str());
  }
  line.end();
}

void ObjReader::velocity(Line &line) {
  const Vec3 velocity =
      vector_of_vertex(ObjAttribute::velocity, "the velocity of this vertex", out_.state.v, line);
  if (!is_speed(velocity)) line.fail("the speed of this vertex is over %g m/s", most_speed);
}

void ObjReader::annulus(Line &line) {
  Valve &valve = out_.valve;
  do {
    check_room(valve.annulus, line);
    valve.annulus.push_back(line.vertex(valve.rest.size()));
  } while (!line.at_end());
}

void ObjReader::head(Line &line) {
  Valve &valve = out_.valve;
  check_room(valve.heads, line);
  Head head;
  uint64_t node = 0;
  Fields fields(line);
  fields.text("name", head.name);
  fields.whole("id", head.id);
  fields.need(fields.whole("node", node), "node");
  fields.end();
  if (node < 1 || node > valve.rest.size()) {
    line.fail("node=%llu is not one of the %zu vertices above this line",
              static_cast<unsigned long long>(node), valve.rest.size());
  }
  head.node = static_cast<uint32_t>(node - 1);
  valve.heads.push_back(std::move(head));
}

void ObjReader::ring(Line &line) {
  Valve &valve = out_.valve;
  check_room(valve.rings, line);
  Ring ring;
  uint32_t kind = 0;
  Fields fields(line);
  read_named(fields, ring);
  if (fields.choice("kind", kind, obj::ring_kinds)) ring.kind = static_cast<RingKind>(kind + 1);
  fields.end();
  valve.rings.push_back(std::move(ring));
}

void ObjReader::ring_point(Line &line) {
  follows("#mvs ring", !out_.valve.rings.empty(), line);
  check_room(out_.valve.rings.back().curve, line);
  out_.valve.rings.back().curve.push_back(read_place(line));
  line.end();
}

void ObjReader::curve(Line &line) {
  Valve &valve = out_.valve;
  check_room(valve.curves, line);
  ChordCurve curve;
  Fields fields(line);
  read_named(fields, curve);
  fields.end();
  curves_.emplace(curve.name, static_cast<uint32_t>(valve.curves.size()));
  valve.curves.push_back(std::move(curve));
}

void ObjReader::curve_point(Line &line) {
  follows("#mvs curve", !out_.valve.curves.empty(), line);
  check_room(out_.valve.curves.back().points, line);
  const double strain = line.number(), stress = line.number();
  out_.valve.curves.back().points.push_back({strain, stress});
  line.end();
}

void ObjReader::thickness(Line &line) {
  follows("f", counts_.faces > 0, line);
  given_.add(ObjAttribute::thickness, "the thickness of this triangle", line);
  out_.valve.triangle_thickness.back() = line.number(obj::mm);
  line.end();
}

void ObjReader::fibre(Line &line) {
  Valve &valve = out_.valve;
  follows("f", counts_.faces > 0, line);
  if (valve.triangle_fibre.size() == valve.triangles.size()) {
    line.fail("the fibre of this triangle is given twice");
  }
  if (valve.triangle_fibre.size() + 1 < valve.triangles.size()) {
    line.fail("a triangle above has no fibre: give one to each triangle, or omit all");
  }
  const double x = line.number(), y = line.number(), z = line.number();
  valve.triangle_fibre.push_back({x, y, z});
  line.end();
}

// Returns the index of the curve of a chord.
uint32_t ObjReader::curve_of(Fields &fields, const Line &line) const {
  std::string name;
  fields.need(fields.text("curve", name), "curve");
  if (const auto found = curves_.find(name); found != curves_.end()) return found->second;
  line.fail("there is no curve %s above this line", quoted(name).c_str());
}

void ObjReader::chord(Line &line) {
  follows("l", counts_.lines > 0, line);
  given_.add(ObjAttribute::chord, "this chord", line);
  if (segments_in_line_ != 1) {
    line.fail("the l line above has %zu segments: write an l line for each", segments_in_line_);
  }
  Chord &chord = out_.valve.chords.back();
  uint32_t kind = 0, law = 0;
  Fields fields(line);
  fields.text("name", chord.name);
  fields.whole("id", chord.id);
  if (fields.choice("kind", kind, obj::chord_kinds)) chord.kind = static_cast<ChordKind>(kind);
  if (fields.choice("law", law, obj::words_of(chord_laws())))
    chord.law = static_cast<ChordLawId>(law + 1);
  fields.number("rest_length", chord.rest_length, obj::mm);
  fields.number("young", chord.young);
  fields.number("area", chord.area, obj::mm2);
  if (chord.law == ChordLawId::table) {
    chord.constants[0] = curve_of(fields, line);
  } else {
    read_constants(fields, find_chord_law(chord.law)->constants, chord.constants);
  }
  fields.end();
}

}  // namespace mvs::core
