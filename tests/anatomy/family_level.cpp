// Coarser levels of variants are those that each variant has alone, bit for bit, whether they take
// the mesh of another variant or not.
#include "anatomy/family_level.h"

#include <functional>

#include "model/mesh_family.h"
#include "tests/anatomy/levels.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

bool same_places(const LevelMap &a, const LevelMap &b) {
  return a.fine_of_coarse == b.fine_of_coarse &&
         std::equal(a.place.begin(), a.place.end(), b.place.begin(), b.place.end(),
                    [](const LevelPlace &p, const LevelPlace &q) {
                      return p.nodes == q.nodes && p.weight == q.weight && p.height == q.height;
                    });
}

// Checks the level of a variant in its family, and returns how many levels the family then keeps.
size_t levels_after(const ModelPtr &base, size_t vertices,
                    const std::function<void(Valve &)> &change) {
  Valve valve = base->valve;
  change(valve);
  const ModelPtr variant = make_model(std::move(valve), base.get());
  const auto found = coarsen_in_family(*variant, vertices);
  const Coarsened alone = coarsen(*variant, vertices);
  CHECK(hash_of(*found->model, initial_state(*found->model)) ==
        hash_of(*alone.model, initial_state(*alone.model)));
  CHECK(found->model->topology.hinges == alone.model->topology.hinges);
  CHECK(found->model->rest_area == alone.model->rest_area);
  CHECK(found->model->node_mass == alone.model->node_mass);
  CHECK(same_places(found->map, alone.map));
  CHECK(found->report.chords_merged == alone.report.chords_merged);
  return base->family->levels().size();
}

void soften_all(Valve &valve) {
  for (Chord &chord : valve.chords) chord.young *= 0.9;
}

}  // namespace

TEST_CASE("levels_of_variants_are_those_of_each_alone") {
  for (const size_t vertices : {size_t{250}, size_t{130}}) {
    CAPTURE(vertices);
    const ModelPtr base = parametric(700);
    const bool merges = vertices == 130;
    CHECK((coarsen(*base, vertices).report.chords_merged > 0) == merges);
    coarsen_in_family(*base, vertices);
    CHECK(base->family->levels().empty());  // it has no variant yet
    const auto after = [&](const std::function<void(Valve &)> &change) {
      return levels_after(base, vertices, change);
    };
    CHECK(after([](Valve &) {}) == 1);
    CHECK(after(soften_all) == 1);
    CHECK(after([](Valve &v) {
            for (size_t c = 0; c < v.chords.size(); ++c) {
              v.chords[c].rest_length *= c % 2 == 0 ? 0.98 : 1.03;
            }
          }) == 1);
    CHECK(after([](Valve &v) { v.leaflets[0].constants[0] *= 1.2, v.name = "soft"; }) == 1);
    // these need meshes of their own
    CHECK(after([](Valve &v) { v.triangle_thickness[3] *= 1.1; }) == 2);
    CHECK(levels_after(base, vertices + 50, [](Valve &) {}) == 3);
    // chordae of unlike tissue are not merged
    const auto unlike = [](Valve &v) {
      for (size_t c = 0; c < v.chords.size(); ++c) {
        v.chords[c].young *= 1 + 0.001 * static_cast<double>(c);
      }
    };
    CHECK(after(unlike) == (merges ? 4 : 3));
    CHECK(after([](Valve &v) { v.chords[0].rest_length *= 0.99; }) == (merges ? 4 : 3));
    levels_after(base, vertices + 60, [](Valve &) {});
    CHECK(levels_after(base, vertices + 70, [](Valve &) {}) == 4);  // as many as a family keeps
  }
}

TEST_CASE("levels_of_levels_are_shared_too") {
  const ModelPtr base = parametric(900);
  const auto coarse_of = [](const ModelPtr &model, size_t vertices) {
    return coarsen_in_family(*model, vertices)->model;
  };
  const auto variant = [&] {
    Valve valve = base->valve;
    soften_all(valve);
    return make_model(std::move(valve), base.get());
  };
  const ModelPtr first = coarse_of(variant(), 450), second = coarse_of(variant(), 450);
  CHECK(first->family == second->family);
  CHECK(hash_of(*coarse_of(first, 250), initial_state(*coarse_of(first, 250))) ==
        hash_of(*coarse_of(second, 250), initial_state(*coarse_of(second, 250))));
  CHECK(first->family->levels().size() == 1);
}
