// Takes the mesh of a level from another variant, or coarsens and keeps the level for others.
#include "anatomy/family_level.h"

#include <utility>

#include "model/mesh_family.h"

namespace mvs::core {
namespace {

// Returns the number on the coarse level of each fine node, `none` for those that are not on it.
std::vector<uint32_t> coarse_numbers(const LevelMap &map) {
  std::vector<uint32_t> number(map.place.size(), none);
  for (uint32_t c = 0; c < map.fine_of_coarse.size(); ++c) number[map.fine_of_coarse[c]] = c;
  return number;
}

// The mesh of a coarse valve with the chordae, constants and names of a fine one.
Valve with_mesh_of(const Valve &coarse, const Valve &fine, std::vector<Chord> chords,
                   const std::vector<uint32_t> &number) {
  Valve valve = fine;
  valve.rest = coarse.rest;
  valve.open = coarse.open;
  valve.loaded = coarse.loaded;
  valve.origin = coarse.origin;
  valve.triangles = coarse.triangles;
  valve.triangle_leaflet = coarse.triangle_leaflet;
  valve.triangle_scallop = coarse.triangle_scallop;
  valve.triangle_thickness = coarse.triangle_thickness;
  valve.triangle_fibre = coarse.triangle_fibre;
  valve.annulus = coarse.annulus;
  for (Head &head : valve.heads) head.node = number[head.node];
  for (Chord &chord : chords) {
    chord.a = number[chord.a];
    chord.b = number[chord.b];
  }
  valve.chords = std::move(chords);
  return valve;
}

bool has_tissue_of(const FamilyLevel &level, const Valve &valve) {
  CowVector<double> thickness = valve.triangle_thickness;
  CowVector<Vec3> fibre = valve.triangle_fibre;
  return thickness.share_with(level.thickness) && fibre.share_with(level.fibre);
}

// Returns null if the level does not serve the model.
std::shared_ptr<const Coarsened> made_after(const FamilyLevel &level, const Model &model,
                                            size_t vertices) {
  if (level.vertices != vertices || !has_tissue_of(level, model.valve)) return nullptr;
  CoarseChordae chordae(model);
  if (!chordae.repeat(level.steps)) return nullptr;
  const Coarsened &other = *level.made;
  Valve valve =
      with_mesh_of(other.model->valve, model.valve, chordae.left(), coarse_numbers(other.map));
  auto made = std::make_shared<Coarsened>();
  made->model = make_model(std::move(valve), other.model.get());
  made->map = other.map;
  made->report = other.report;
  return made;
}

}  // namespace

std::shared_ptr<const Coarsened> coarsen_in_family(const Model &model, size_t vertices) {
  const auto levels = model.family->levels();
  for (const std::shared_ptr<const FamilyLevel> &level : levels) {
    if (auto made = made_after(*level, model, vertices)) return made;
  }
  std::vector<ChordStep> steps;
  auto made = std::make_shared<const Coarsened>(coarsen(model, vertices, &steps));
  if (model.family->has_variants()) {
    const FamilyLevel level{vertices, model.valve.triangle_thickness, model.valve.triangle_fibre,
                            std::move(steps), made};
    model.family->keep(std::make_shared<const FamilyLevel>(level), levels.size());
  }
  return made;
}

}  // namespace mvs::core
