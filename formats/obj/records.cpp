// Reader of extended OBJ: the #mvs lines. Each belongs to the valve, or to the last v, f or l line
// above.
#include "formats/obj/reader.h"
#include "model/chord_law.h"

namespace mvs::core {
namespace {

void once(bool &given, const char *word, const Line &line) {
  if (given) line.fail("%s is given twice", word);
  given = true;
}

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

}  // namespace

void ObjReader::record(Line &line) {
  struct Record {
    std::string_view word;
    void (ObjReader::*read)(Line &);
  };
  static constexpr std::array records = {Record{"fibre", &ObjReader::fibre},
                                         Record{"rest", &ObjReader::rest},
                                         Record{"velocity", &ObjReader::velocity},
                                         Record{"loaded", &ObjReader::loaded},
                                         Record{"open", &ObjReader::open},
                                         Record{"origin", &ObjReader::origin},
                                         Record{"ring", &ObjReader::ring},
                                         Record{"ring_point", &ObjReader::ring_point},
                                         Record{"curve", &ObjReader::curve},
                                         Record{"curve_point", &ObjReader::curve_point},
                                         Record{"thickness", &ObjReader::thickness},
                                         Record{"chord", &ObjReader::chord},
                                         Record{"annulus", &ObjReader::annulus},
                                         Record{"head", &ObjReader::head},
                                         Record{"scallop", &ObjReader::scallop},
                                         Record{"leaflet", &ObjReader::leaflet},
                                         Record{"state", &ObjReader::state},
                                         Record{"valve", &ObjReader::valve},
                                         Record{"solver_cache", &ObjReader::solver_cache},
                                         Record{"solver_cache_data", &ObjReader::solver_cache_data},
                                         Record{"end", &ObjReader::end}};
  ++counts_.records;
  const std::string_view word = line.word();
  if (!has_version_) return version(word, line);
  for (const Record &candidate : records) {
    if (candidate.word == word) return (this->*candidate.read)(line);
  }
  line.fail("#mvs %s is not known in version %u of the format", quoted(word).c_str(), obj::version);
}

// `#mvs 1 units=mm`, the first record.
void ObjReader::version(std::string_view word, Line &line) {
  uint64_t number = 0;
  if (!parse_whole(word, number)) {
    line.fail("the first #mvs line has to be `#mvs %u units=mm`, not #mvs %s", obj::version,
              quoted(word).c_str());
  }
  if (number != obj::version) {
    throw Error(MVS_E_VERSION, "",
                format("the file has version %s, this libmvs reads version %u",
                       quoted(word).c_str(), obj::version),
                line.number_of_line());
  }
  if (counts_.vertices + counts_.faces + counts_.lines > 0) {
    line.fail("this line has to stand above the first v, f and l line");
  }
  has_version_ = true;
  static constexpr std::array<std::string_view, 1> units = {"mm"};
  uint32_t unit = 0;
  Fields fields(line);
  fields.need(fields.choice("units", unit, units), "units");
  fields.end();
}

void ObjReader::valve(Line &line) {
  once(has_valve_, "#mvs valve", line);
  Valve &valve = out_.valve;
  Fields fields(line);
  fields.text("name", valve.name);
  fields.whole("next_id", valve.next_id);
  fields.number("density", valve.density);
  fields.number("contact_thickness", valve.contact_thickness, obj::mm);
  fields.number("contact_stiffness", valve.contact_stiffness);
  fields.number("bending_scale", valve.bending_scale);
  fields.end();
}

void ObjReader::state(Line &line) {
  once(has_state_, "#mvs state", line);
  State &state = out_.state;
  Fields fields(line);
  fields.number("time", state.time);
  fields.whole("steps", state.steps);
  fields.number("pressure", state.load.pressure);
  fields.number("boundary_fraction", state.load.boundary_fraction);
  fields.number("rest_tolerance", state.rest_tolerance);
  fields.end();
  if (!(state.load.boundary_fraction >= 0 && state.load.boundary_fraction <= 1)) {
    line.fail("boundary_fraction is %g: it has to be 0 (open) to 1 (loaded)",
              state.load.boundary_fraction);
  }
  if (!(state.rest_tolerance >= 0)) {
    line.fail("rest_tolerance is %g: it has to be a force in N, or 0", state.rest_tolerance);
  }
}

void ObjReader::solver_cache(Line &line) {
  if (cache_size_ > 0) line.fail("#mvs solver_cache is given twice");
  SolverCache &cache = out_.state.cache;
  uint64_t version = 0;
  Fields fields(line);
  fields.need(fields.whole("version", version), "version");
  fields.need(fields.whole("counter", cache.counter), "counter");
  fields.need(fields.whole("size", cache_size_), "size");
  fields.end();
  if (version > UINT32_MAX) line.fail("version is too large");
  if (cache_size_ == 0) line.fail("size is 0: a state without a cache has no such line");
  cache.version = static_cast<uint32_t>(version);
}

void ObjReader::solver_cache_data(Line &line) {
  CowVector<double> &data = out_.state.cache.data;
  while (!line.at_end()) {
    if (data.size() >= cache_size_) {
      line.fail("the solver cache has more numbers than the %llu of its `#mvs solver_cache` line",
                static_cast<unsigned long long>(cache_size_));
    }
    data.push_back(line.number());
  }
}

void ObjReader::leaflet(Line &line) {
  Valve &valve = out_.valve;
  check_room(valve.leaflets, line);
  Leaflet leaflet;
  uint32_t law = 0;
  Fields fields(line);
  fields.need(fields.text("name", leaflet.name), "name");
  fields.whole("id", leaflet.id);
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
  fields.need(fields.text("name", scallop.name), "name");
  fields.whole("id", scallop.id);
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
const Vec3 &ObjReader::vector_of_vertex(bool &given, const char *what, CowVector<Vec3> &vectors,
                                        Line &line) {
  follows("v", counts_.vertices > 0, line);
  once(given, what, line);
  const Vec3 vector = read_place(line);
  line.end();
  return vectors.back() = vector;
}

void ObjReader::rest(Line &line) {
  Valve &valve = out_.valve;
  const Vec3 rest =
      vector_of_vertex(given_.rest, "the rest position of this vertex", valve.rest, line);
  if (!given_.open) valve.open.back() = rest;
  if (!given_.loaded) valve.loaded.back() = rest;
}

void ObjReader::loaded(Line &line) {
  vector_of_vertex(given_.loaded, "the loaded position of this vertex", out_.valve.loaded, line);
}

void ObjReader::open(Line &line) {
  vector_of_vertex(given_.open, "the open position of this vertex", out_.valve.open, line);
}

// `#mvs origin 17`, or `#mvs origin new` for a node that an operation made.
void ObjReader::origin(Line &line) {
  follows("v", counts_.vertices > 0, line);
  once(given_.origin, "the origin of this vertex", line);
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
  vector_of_vertex(given_.velocity, "the velocity of this vertex", out_.state.v, line);
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
  fields.need(fields.text("name", ring.name), "name");
  fields.whole("id", ring.id);
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
  fields.need(fields.text("name", curve.name), "name");
  fields.whole("id", curve.id);
  fields.end();
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
  once(given_.thickness, "the thickness of this triangle", line);
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
  const auto &curves = out_.valve.curves.get();
  for (uint32_t c = 0; c < curves.size(); ++c) {
    if (curves[c].name == name) return c;
  }
  line.fail("there is no curve %s above this line", quoted(name).c_str());
}

void ObjReader::chord(Line &line) {
  follows("l", counts_.lines > 0, line);
  once(given_.chord, "this chord", line);
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

void ObjCounts::check(Fields &fields, const Line &line) const {
  const auto compare = [&](const char *key, uint64_t found, const char *what) {
    uint64_t claimed = 0;
    fields.need(fields.whole(key, claimed), key);
    if (claimed == found) return;
    line.fail("%s=%llu, but the file has %llu %s lines: lines were lost or added", key,
              static_cast<unsigned long long>(claimed), static_cast<unsigned long long>(found),
              what);
  };
  compare("v", vertices, "v");
  compare("f", faces, "f");
  compare("l", lines, "l");
  compare("g", groups, "g");
  compare("mvs", records, "#mvs");
}

// Checks the line counts, which detect lost or added lines.
void ObjReader::end(Line &line) {
  const Valve &valve = out_.valve;
  Fields fields(line);
  counts_.check(fields, line);
  fields.end();
  if (!valve.triangle_fibre.empty() && valve.triangle_fibre.size() < valve.triangles.size()) {
    line.fail("only %zu of %zu triangles have a fibre: give one to each triangle, or omit all",
              valve.triangle_fibre.size(), valve.triangles.size());
  }
  const size_t cached = out_.state.cache.data.size();
  if (cached != cache_size_) {
    line.fail("the solver cache has %zu of its %llu numbers: lines were lost", cached,
              static_cast<unsigned long long>(cache_size_));
  }
  has_end_ = true;
}

}  // namespace mvs::core
