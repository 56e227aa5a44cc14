// tinyobjloader, if Debian's libtinyobjloader-dev is installed, reads the same valve from our OBJ.
#if __has_include(<tiny_obj_loader.h>)
#define TINYOBJLOADER_IMPLEMENTATION
#define TINYOBJLOADER_USE_DOUBLE
#include <tiny_obj_loader.h>

#include <limits>

#include "tests/formats/samples.h"

using namespace mvs::core;

TEST_CASE("tinyobjloader_reads_nodes_faces_groups_and_chordae") {
  const Pair pair = moving_valve();
  const Valve &valve = pair.model.valve;
  tinyobj::ObjReader reader;
  REQUIRE(reader.ParseFromString(write_obj(pair.model, pair.state), ""));
  CHECK(reader.Warning() == "");
  const std::vector<double> &places = reader.GetAttrib().vertices;
  REQUIRE(places.size() == 3 * valve.rest.size());
  for (size_t k = 0; k < places.size(); ++k) {
    // its own decimal parser is accurate to a few units in the last place
    const double wanted = pair.state.x[k / 3][static_cast<int>(k % 3)] * 1e3;
    CHECK(std::abs(places[k] - wanted) <=
          8 * std::numeric_limits<double>::epsilon() * std::abs(wanted));
  }
  size_t t = 0, c = 0;
  for (const tinyobj::shape_t &shape : reader.GetShapes()) {
    for (size_t k = 0; k < shape.mesh.indices.size(); k += 3, ++t) {
      for (size_t corner = 0; corner < 3; ++corner) {
        CHECK(shape.mesh.indices[k + corner].vertex_index ==
              static_cast<int>(valve.triangles[t][corner]));
      }
      CHECK(shape.name == valve.leaflets[valve.triangle_leaflet[t]].name + " " +
                              valve.scallops[valve.triangle_scallop[t]].name);
    }
    for (size_t k = 0; k < shape.lines.indices.size(); k += 2, ++c) {
      CHECK(shape.lines.indices[k].vertex_index == static_cast<int>(valve.chords[c].a));
      CHECK(shape.lines.indices[k + 1].vertex_index == static_cast<int>(valve.chords[c].b));
    }
  }
  CHECK(t == valve.triangles.size());
  CHECK(c == valve.chords.size());
}
#endif
