// Writer of extended OBJ, in the order of FORMAT.md; equal valves and states give equal bytes.
#include "base/bit_cast.h"
#include "base/error.h"
#include "formats/formats.h"
#include "formats/obj/line_writer.h"
#include "model/chord_law.h"

namespace mvs::core {
namespace obj {
namespace {

bool same_bits(double a, double b) {
  return bit_cast<uint64_t>(a) == bit_cast<uint64_t>(b);
}

bool same_bits(const Vec3 &a, const Vec3 &b) {
  return same_bits(a[0], b[0]) && same_bits(a[1], b[1]) && same_bits(a[2], b[2]);
}

void write_solver_cache(LineWriter &out, const SolverCache &cache) {
  constexpr size_t numbers_a_line = 6;
  out.record("solver_cache");
  out.key_whole("version", cache.version);
  out.key_whole("counter", cache.counter);
  out.key_whole("size", cache.data.size());
  out.end_line();
  for (size_t k = 0; k < cache.data.size(); ++k) {
    if (k % numbers_a_line == 0) out.record("solver_cache_data");
    out.number(cache.data[k]);
    if (k % numbers_a_line == numbers_a_line - 1 || k + 1 == cache.data.size()) out.end_line();
  }
}

void write_valve(LineWriter &out, const Valve &valve) {
  out.record("valve");
  out.key_text("name", valve.name);
  out.key_whole("next_id", valve.next_id);
  out.key_number("density", valve.density);
  out.key_number("contact_thickness", valve.contact_thickness, mm);
  out.key_number("contact_stiffness", valve.contact_stiffness);
  out.key_number("bending_scale", valve.bending_scale);
  out.end_line();
}

// A state with tools is not written in full: without them it is not at rest, and steps from the
// file begin without a solver cache.
void write_state(LineWriter &out, const State &state) {
  out.record("state");
  out.key_number("time", state.time);
  out.key_whole("steps", state.steps);
  out.key_number("pressure", state.load.pressure);
  out.key_number("boundary_fraction", state.load.boundary_fraction);
  if (state.is_at_rest() && state.tools.empty())
    out.key_number("rest_tolerance", state.rest_tolerance);
  if (state.tools_made > 0) out.key_whole("tools_made", state.tools_made);
  out.end_line();
  if (state.tools.empty() && !state.cache.empty()) write_solver_cache(out, state.cache);
}

void write_header(LineWriter &out, const Valve &valve, const State &state) {
  out.comment("A heart valve by libmvs; formats/FORMAT.md says what the lines mean.");
  out.comment("SPACE=LPS");
  if (!state.tools.empty()) {
    out.comment("The tools of this state are not kept here: save it as .h5");
  }
  out.record(std::to_string(version));
  out.word("units=mm");
  out.end_line();
  write_valve(out, valve);
  write_state(out, state);
}

void write_leaflets(LineWriter &out, const Valve &valve) {
  for (const Leaflet &leaflet : valve.leaflets) {
    out.part("leaflet", leaflet);
    out.key_choice("law", words_of(leaflet_laws()), static_cast<uint32_t>(leaflet.law) - 1);
    out.key_number("thickness", leaflet.thickness, mm);
    out.key_constants(find_leaflet_law(leaflet.law)->constants, leaflet.constants);
    out.end_line();
  }
  for (const Scallop &scallop : valve.scallops) {
    out.part("scallop", scallop);
    out.key_text("leaflet", valve.leaflets[scallop.leaflet].name);
    out.end_line();
  }
}

// Writes rest, open and loaded position, velocity and origin only if they differ from their
// defaults.
void write_nodes(LineWriter &out, const Valve &valve, const State &state) {
  const Vec3 still = Vec3::Zero();
  for (size_t n = 0; n < valve.rest.size(); ++n) {
    out.statement('v');
    out.vector(state.x[n]);
    if (!same_bits(valve.rest[n], state.x[n])) out.vector_record("rest", valve.rest[n]);
    if (!same_bits(valve.open[n], valve.rest[n])) out.vector_record("open", valve.open[n]);
    if (!same_bits(valve.loaded[n], valve.rest[n])) out.vector_record("loaded", valve.loaded[n]);
    if (!same_bits(state.v[n], still)) out.vector_record("velocity", state.v[n]);
    if (valve.origin[n] != n) {
      out.record("origin");
      out.word(valve.origin[n] == none ? "new" : std::to_string(uint64_t{valve.origin[n]} + 1));
      out.end_line();
    }
  }
}

void write_annulus_and_heads(LineWriter &out, const Valve &valve) {
  constexpr size_t nodes_a_line = 16;
  for (size_t k = 0; k < valve.annulus.size(); ++k) {
    if (k % nodes_a_line == 0) out.record("annulus");
    out.vertices({valve.annulus[k]});
    if (k % nodes_a_line == nodes_a_line - 1 || k + 1 == valve.annulus.size()) out.end_line();
  }
  for (const Head &head : valve.heads) {
    out.part("head", head);
    out.key_whole("node", uint64_t{head.node} + 1);
    out.end_line();
  }
}

void write_rings(LineWriter &out, const Valve &valve) {
  for (const Ring &ring : valve.rings) {
    out.part("ring", ring);
    out.key_choice("kind", ring_kinds, static_cast<uint32_t>(ring.kind) - 1);
    out.end_line();
    for (const Vec3 &point : ring.curve) out.vector_record("ring_point", point);
  }
}

void write_curves(LineWriter &out, const Valve &valve) {
  for (const ChordCurve &curve : valve.curves) {
    out.part("curve", curve);
    out.end_line();
    for (const auto &[strain, stress] : curve.points) {
      out.record("curve_point");
      out.number(strain);
      out.number(stress);
      out.end_line();
    }
  }
}

void write_triangles(LineWriter &out, const Valve &valve) {
  uint32_t leaflet = none, scallop = none;
  for (size_t t = 0; t < valve.triangles.size(); ++t) {
    if (valve.triangle_leaflet[t] != leaflet || valve.triangle_scallop[t] != scallop) {
      leaflet = valve.triangle_leaflet[t];
      scallop = valve.triangle_scallop[t];
      out.group();
      out.name(valve.leaflets[leaflet].name);
      out.name(valve.scallops[scallop].name);
      out.end_line();
    }
    const Tri &triangle = valve.triangles[t];
    out.statement('f');
    out.vertices({triangle[0], triangle[1], triangle[2]});
    out.end_line();
    const double thickness = valve.triangle_thickness[t];
    if (!same_bits(thickness, valve.leaflets[leaflet].thickness)) {
      out.record("thickness");
      out.number(thickness, mm);
      out.end_line();
    }
    out.vector_record("fibre", valve.triangle_fibre[t], 0);
  }
}

void write_chords(LineWriter &out, const Valve &valve) {
  if (!valve.chords.empty()) {
    out.group();
    out.name("chordae");
    out.end_line();
  }
  for (const Chord &chord : valve.chords) {
    out.statement('l');
    out.vertices({chord.a, chord.b});
    out.end_line();
    out.part("chord", chord);
    out.key_choice("kind", chord_kinds, static_cast<uint32_t>(chord.kind));
    out.key_choice("law", words_of(chord_laws()), static_cast<uint32_t>(chord.law) - 1);
    out.key_number("rest_length", chord.rest_length, mm);
    out.key_number("young", chord.young);
    out.key_number("area", chord.area, mm2);
    if (chord.law == ChordLawId::table) {
      out.key_text("curve", valve.curves[static_cast<size_t>(chord.constants[0])].name);
    } else {
      out.key_constants(find_chord_law(chord.law)->constants, chord.constants);
    }
    out.end_line();
  }
}

void write_end(LineWriter &out, const Valve &valve) {
  out.record("end");
  out.key_whole("v", valve.rest.size());
  out.key_whole("f", valve.triangles.size());
  out.key_whole("l", valve.chords.size());
  out.key_whole("g", out.groups());
  out.key_whole("mvs", out.records());
  out.end_line();
}

}  // namespace
}  // namespace obj

std::string write_obj(const Model &model, const State &state) {
  MVS_MUST(state.x.size() == model.node_count() && state.v.size() == model.node_count(),
           MVS_E_INTERNAL, "state", "the state has %zu positions and %zu velocities for %zu nodes",
           state.x.size(), state.v.size(), model.node_count());
  const Valve &valve = model.valve;
  obj::LineWriter out(valve.name);
  out.reserve(512 + 256 * valve.rest.size() + 128 * valve.triangles.size());
  obj::write_header(out, valve, state);
  obj::write_leaflets(out, valve);
  obj::write_nodes(out, valve, state);
  obj::write_annulus_and_heads(out, valve);
  obj::write_rings(out, valve);
  obj::write_curves(out, valve);
  obj::write_triangles(out, valve);
  obj::write_chords(out, valve);
  obj::write_end(out, valve);
  return out.take();
}

}  // namespace mvs::core
