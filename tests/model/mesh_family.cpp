// Models with one mesh form a family; any other mesh is checked and derived anew.
#include "model/mesh_family.h"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>

#include "base/error.h"
#include "model/model.h"
#include "tests/model/small_valve.h"

using namespace mvs::core;

namespace {

using Change = std::function<void(Valve &)>;

// "" if the valve is valid.
std::string fault_of(const Valve &valve, const Model *parent) {
  try {
    make_model(valve, parent);
  } catch (const Error &error) {
    return error.what();
  }
  return "";
}

const Change variants[] = {
    [](Valve &) {},
    [](Valve &v) { v.chords[3].rest_length = 0.01; },
    [](Valve &v) { v.chords[2].young *= 2; },
    [](Valve &v) { v.chords[2].area *= 2; },
    [](Valve &v) { v.leaflets[0].constants[0] *= 1.1; },
    [](Valve &v) {
      v.leaflets[1].law = LeafletLawId::bilinear, v.leaflets[1].constants = {1e4, 1e6, 3.1, 0.01};
    },
    [](Valve &v) { v.triangle_thickness[5] = 2e-3; },
    [](Valve &v) { v.density = 1100, v.contact_stiffness *= 2, v.bending_scale = 0; },
    [](Valve &v) { v.name = "other", v.chords[1].name = "other", v.scallops[0].name = "A2"; },
    // left out: complete() fills in the same values
    [](Valve &v) { v.open = {}, v.loaded = {}, v.origin = {}; },
    [](Valve &v) { v.scallops = {}, v.triangle_scallop = {}; },
    [](Valve &v) { v.triangle_fibre = {}, v.triangle_thickness = {}; },
};

const Change other_meshes[] = {
    [](Valve &v) { v.rest[7][1] = std::nextafter(v.rest[7][1], 1.0); },
    [](Valve &v) { v.loaded[7][1] += 1e-3; },
    [](Valve &v) { v.open[7][1] += 1e-3; },
    [](Valve &v) { v.origin[7] = none; },
    [](Valve &v) { std::swap(v.triangles[0], v.triangles[1]); },
    [](Valve &v) { v.triangle_leaflet[0] = 1 - v.triangle_leaflet[0]; },
    [](Valve &v) { v.triangle_scallop[0] = 1 - v.triangle_scallop[0]; },
    [](Valve &v) { v.triangle_fibre[0] *= -1; },
    [](Valve &v) { std::swap(v.chords[3], v.chords[4]); },
    [](Valve &v) { v.chords[3].kind = ChordKind::basal; },
    [](Valve &v) { std::swap(v.heads[0], v.heads[1]); },
    [](Valve &v) { v.chords[3].b += 1; },
    [](Valve &v) { std::rotate(v.annulus.begin(), v.annulus.begin() + 1, v.annulus.end()); },
};

// Faults beside the mesh, and one of the mesh.
const Change faulty[] = {
    [](Valve &v) { v.chords[2].rest_length = NAN; },
    [](Valve &v) { v.chords[2].young = -1; },
    [](Valve &v) { v.chords[2].law = ChordLawId::table; },
    [](Valve &v) { v.leaflets[0].thickness = 1; },
    [](Valve &v) { v.leaflets[1].name = v.leaflets[0].name; },
    [](Valve &v) { v.triangle_thickness[5] = 0; },
    [](Valve &v) { v.triangle_thickness.pop_back(); },
    [](Valve &v) { v.contact_thickness = 1; },
    [](Valve &v) { v.triangles[5] = v.triangles[4]; },
};

}  // namespace

TEST_CASE("a_variant_joins_the_family_and_is_the_model_that_it_is_alone") {
  const ModelPtr base = make_model(small_valve());
  for (const Change &change : variants) {
    Valve valve = base->valve;
    change(valve);
    const ModelPtr alone = make_model(valve), variant = make_model(valve, base.get());
    CAPTURE(&change - variants);
    CHECK(variant->family == base->family);
    CHECK(alone->family != base->family);
    CHECK(variant->topology.hinges.buffer() == base->topology.hinges.buffer());
    CHECK(hash_of(*variant, initial_state(*variant)) == hash_of(*alone, initial_state(*alone)));
    CHECK(variant->topology.edges == alone->topology.edges);
    CHECK(variant->topology.free_edges == alone->topology.free_edges);
    CHECK(variant->rest_area == alone->rest_area);
    CHECK(variant->rest_length == alone->rest_length);
    CHECK(variant->vertex_area == alone->vertex_area);
    CHECK(variant->node_mass == alone->node_mass);
  }
}

TEST_CASE("a_valve_with_another_mesh_has_a_family_of_its_own") {
  const ModelPtr base = make_model(small_valve());
  for (const Change &change : other_meshes) {
    Valve valve = base->valve;
    change(valve);
    CAPTURE(&change - other_meshes);
    CHECK(!has_mesh_of(valve, *base));
    const std::string fault = fault_of(valve, nullptr);
    CHECK(fault_of(valve, base.get()) == fault);
    if (fault.empty()) CHECK(make_model(valve, base.get())->family != base->family);
  }
}

TEST_CASE("a_variant_with_a_fault_is_refused_as_it_is_alone") {
  const ModelPtr base = make_model(small_valve());
  for (const Change &change : faulty) {
    Valve valve = base->valve;
    change(valve);
    CAPTURE(&change - faulty);
    CHECK(fault_of(valve, base.get()) != "");
    CHECK(fault_of(valve, base.get()) == fault_of(valve, nullptr));
  }
}

TEST_CASE("a_family_of_one_keeps_nothing") {
  const ModelPtr base = make_model(small_valve());
  CHECK(!base->family->has_variants());
  Valve valve = base->valve;
  valve.density = 1100;
  make_model(valve, base.get());
  CHECK(base->family->has_variants());
}
