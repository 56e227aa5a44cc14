// Writer of extended OBJ, in the order of FORMAT.md; equal valves and states give equal bytes.
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <span>

#include "base/bit_cast.h"
#include "base/error.h"
#include "formats/formats.h"
#include "formats/obj/words.h"
#include "formats/text/decimal.h"
#include "formats/text/line.h"
#include "model/chord_law.h"

namespace mvs::core {
namespace {

bool same_bits(double a, double b) {
  return bit_cast<uint64_t>(a) == bit_cast<uint64_t>(b);
}

bool same_bits(const Vec3 &a, const Vec3 &b) {
  return same_bits(a[0], b[0]) && same_bits(a[1], b[1]) && same_bits(a[2], b[2]);
}

class ObjWriter {
 public:
  ObjWriter(const Valve &valve, const State &state);
  std::string write();

 private:
  void header();
  void solver_cache();
  void leaflets();
  void nodes();
  void annulus_and_heads();
  void rings();
  void curves();
  void triangles();
  void chords();
  void end();

  // Start a line `g `, `#mvs word`.
  void group();
  void record(std::string_view word);
  void number(double value, int shift = 0);
  // The end of a line with three numbers, and a record of three numbers.
  void vector(const Vec3 &values, int shift = obj::mm);
  void vector_record(std::string_view word, const Vec3 &values, int shift = obj::mm);
  void key(std::string_view name) { out_.append(1, ' ').append(name).append(1, '='); }
  // Starts a record with name and id of a part.
  template <typename Part>
  void part(std::string_view word, const Part &part) {
    record(word);
    key_text("name", part.name);
    key_whole("id", part.id);
  }
  void key_text(std::string_view name, std::string_view text);
  void key_number(std::string_view name, double value, int shift = 0);
  void key_whole(std::string_view name, uint64_t value);
  template <typename Values>
  void key_constants(std::span<const Constant> constants, const Values &values) {
    for (size_t k = 0; k < constants.size(); ++k) key_number(constants[k].key, values[k]);
  }
  void key_choice(std::string_view name, std::span<const std::string_view> words, uint32_t index);
  void vertices(std::initializer_list<uint32_t> nodes);

  const Valve &valve_;
  const State &state_;
  const bool has_cache_;
  std::string out_;
  uint64_t groups_ = 0, records_ = 0;
};

// A state with tools is not written in full, so steps from the file begin without a solver cache.
ObjWriter::ObjWriter(const Valve &valve, const State &state)
    : valve_(valve), state_(state), has_cache_(state.tools.empty() && !state.cache.empty()) {}

std::string ObjWriter::write() {
  out_.reserve(512 + 256 * valve_.rest.size() + 128 * valve_.triangles.size());
  header();
  leaflets();
  nodes();
  annulus_and_heads();
  rings();
  curves();
  triangles();
  chords();
  end();
  return std::move(out_);
}

void ObjWriter::header() {
  out_ += "# A heart valve by libmvs; formats/FORMAT.md says what the lines mean.\n# SPACE=LPS\n";
  if (!state_.tools.empty())
    out_ += "# The tools of this state are not kept here: save it as .h5\n";
  record(std::to_string(obj::version));
  out_ += " units=mm\n";
  record("valve");
  key_text("name", valve_.name);
  key_whole("next_id", valve_.next_id);
  key_number("density", valve_.density);
  key_number("contact_thickness", valve_.contact_thickness, obj::mm);
  key_number("contact_stiffness", valve_.contact_stiffness);
  key_number("bending_scale", valve_.bending_scale);
  out_ += '\n';
  record("state");
  key_number("time", state_.time);
  key_whole("steps", state_.steps);
  key_number("pressure", state_.load.pressure);
  key_number("boundary_fraction", state_.load.boundary_fraction);
  if (state_.is_at_rest()) key_number("rest_tolerance", state_.rest_tolerance);
  out_ += '\n';
  solver_cache();
}

void ObjWriter::solver_cache() {
  if (!has_cache_) return;
  constexpr size_t numbers_a_line = 6;
  const SolverCache &cache = state_.cache;
  record("solver_cache");
  key_whole("version", cache.version);
  key_whole("counter", cache.counter);
  key_whole("size", cache.data.size());
  out_ += '\n';
  for (size_t k = 0; k < cache.data.size(); ++k) {
    if (k % numbers_a_line == 0) record("solver_cache_data");
    out_ += ' ';
    number(cache.data[k]);
    if (k % numbers_a_line == numbers_a_line - 1 || k + 1 == cache.data.size()) out_ += '\n';
  }
}

void ObjWriter::leaflets() {
  for (const Leaflet &leaflet : valve_.leaflets) {
    part("leaflet", leaflet);
    key_choice("law", obj::words_of(leaflet_laws()), static_cast<uint32_t>(leaflet.law) - 1);
    key_number("thickness", leaflet.thickness, obj::mm);
    key_constants(find_leaflet_law(leaflet.law)->constants, leaflet.constants);
    out_ += '\n';
  }
  for (const Scallop &scallop : valve_.scallops) {
    part("scallop", scallop);
    key_text("leaflet", valve_.leaflets[scallop.leaflet].name);
    out_ += '\n';
  }
}

// Writes rest, open and loaded position, velocity and origin only if they differ from their
// defaults.
void ObjWriter::nodes() {
  const Vec3 still = Vec3::Zero();
  for (size_t n = 0; n < valve_.rest.size(); ++n) {
    out_ += 'v';
    vector(state_.x[n]);
    if (!same_bits(valve_.rest[n], state_.x[n])) vector_record("rest", valve_.rest[n]);
    if (!same_bits(valve_.open[n], valve_.rest[n])) vector_record("open", valve_.open[n]);
    if (!same_bits(valve_.loaded[n], valve_.rest[n])) vector_record("loaded", valve_.loaded[n]);
    if (!same_bits(state_.v[n], still)) vector_record("velocity", state_.v[n]);
    if (valve_.origin[n] != n) {
      record("origin ");
      out_ += valve_.origin[n] == none ? "new" : std::to_string(uint64_t{valve_.origin[n]} + 1);
      out_ += '\n';
    }
  }
}

void ObjWriter::annulus_and_heads() {
  constexpr size_t nodes_a_line = 16;
  for (size_t k = 0; k < valve_.annulus.size(); ++k) {
    if (k % nodes_a_line == 0) record("annulus");
    vertices({valve_.annulus[k]});
    if (k % nodes_a_line == nodes_a_line - 1 || k + 1 == valve_.annulus.size()) out_ += '\n';
  }
  for (const Head &head : valve_.heads) {
    part("head", head);
    key_whole("node", uint64_t{head.node} + 1);
    out_ += '\n';
  }
}

void ObjWriter::rings() {
  for (const Ring &ring : valve_.rings) {
    part("ring", ring);
    key_choice("kind", obj::ring_kinds, static_cast<uint32_t>(ring.kind) - 1);
    out_ += '\n';
    for (const Vec3 &point : ring.curve) vector_record("ring_point", point);
  }
}

void ObjWriter::curves() {
  for (const ChordCurve &curve : valve_.curves) {
    part("curve", curve);
    out_ += '\n';
    for (const auto &[strain, stress] : curve.points) {
      record("curve_point");
      out_ += ' ';
      number(strain);
      out_ += ' ';
      number(stress);
      out_ += '\n';
    }
  }
}

void ObjWriter::triangles() {
  uint32_t leaflet = none, scallop = none;
  for (size_t t = 0; t < valve_.triangles.size(); ++t) {
    if (valve_.triangle_leaflet[t] != leaflet || valve_.triangle_scallop[t] != scallop) {
      leaflet = valve_.triangle_leaflet[t];
      scallop = valve_.triangle_scallop[t];
      group();
      append_text(out_, valve_.leaflets[leaflet].name);
      out_ += ' ';
      append_text(out_, valve_.scallops[scallop].name);
      out_ += '\n';
    }
    const Tri &triangle = valve_.triangles[t];
    out_ += 'f';
    vertices({triangle[0], triangle[1], triangle[2]});
    out_ += '\n';
    const double thickness = valve_.triangle_thickness[t];
    if (!same_bits(thickness, valve_.leaflets[leaflet].thickness)) {
      record("thickness");
      out_ += ' ';
      number(thickness, obj::mm);
      out_ += '\n';
    }
    vector_record("fibre", valve_.triangle_fibre[t], 0);
  }
}

void ObjWriter::chords() {
  if (!valve_.chords.empty()) {
    group();
    out_ += "chordae\n";
  }
  for (const Chord &chord : valve_.chords) {
    out_ += 'l';
    vertices({chord.a, chord.b});
    out_ += '\n';
    part("chord", chord);
    key_choice("kind", obj::chord_kinds, static_cast<uint32_t>(chord.kind));
    key_choice("law", obj::words_of(chord_laws()), static_cast<uint32_t>(chord.law) - 1);
    key_number("rest_length", chord.rest_length, obj::mm);
    key_number("young", chord.young);
    key_number("area", chord.area, obj::mm2);
    if (chord.law == ChordLawId::table) {
      key_text("curve", valve_.curves[static_cast<size_t>(chord.constants[0])].name);
    } else {
      key_constants(find_chord_law(chord.law)->constants, chord.constants);
    }
    out_ += '\n';
  }
}

void ObjWriter::end() {
  record("end");
  key_whole("v", valve_.rest.size());
  key_whole("f", valve_.triangles.size());
  key_whole("l", valve_.chords.size());
  key_whole("g", groups_);
  key_whole("mvs", records_);
  out_ += '\n';
}

void ObjWriter::group() {
  out_ += "g ";
  ++groups_;
}

void ObjWriter::record(std::string_view word) {
  out_.append("#mvs ").append(word);
  ++records_;
}

void ObjWriter::number(double value, int shift) {
  MVS_MUST(std::isfinite(value), MVS_E_DIVERGED, valve_.name,
           "a number of the valve or its state is not finite: go back to an earlier state and save "
           "that");
  append_decimal(out_, value, shift);
}

void ObjWriter::vector(const Vec3 &values, int shift) {
  for (int k = 0; k < 3; ++k) {
    out_ += ' ';
    number(values[k], shift);
  }
  out_ += '\n';
}

void ObjWriter::vector_record(std::string_view word, const Vec3 &values, int shift) {
  record(word);
  vector(values, shift);
}

void ObjWriter::key_text(std::string_view name, std::string_view text) {
  key(name);
  append_text(out_, text);
}

void ObjWriter::key_number(std::string_view name, double value, int shift) {
  key(name);
  number(value, shift);
}

void ObjWriter::key_whole(std::string_view name, uint64_t value) {
  key(name);
  out_ += std::to_string(value);
}

void ObjWriter::key_choice(std::string_view name, std::span<const std::string_view> words,
                           uint32_t index) {
  MVS_MUST(index < words.size(), MVS_E_INTERNAL, std::string(name),
           "the OBJ writer has no word for %.*s %u", static_cast<int>(name.size()), name.data(),
           index);
  key(name);
  out_ += words[index];
}

void ObjWriter::vertices(std::initializer_list<uint32_t> nodes) {
  for (const uint32_t node : nodes) {
    char text[16];
    out_.append(1, ' ').append(text, std::to_chars(text, text + sizeof text, node + 1).ptr);
  }
}

}  // namespace

std::string write_obj(const Model &model, const State &state) {
  MVS_MUST(state.x.size() == model.node_count() && state.v.size() == model.node_count(),
           MVS_E_INTERNAL, "state", "the state has %zu positions and %zu velocities for %zu nodes",
           state.x.size(), state.v.size(), model.node_count());
  return ObjWriter(model.valve, state).write();
}

}  // namespace mvs::core
