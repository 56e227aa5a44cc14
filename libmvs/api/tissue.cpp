// Changes the tissue of a leaflet; enumerates the constitutive laws.
#include "api/sim_call.h"
#include "api/structs.h"
#include "api/valve_desc.h"
#include "model/chord_law.h"
#include "session/commit.h"

using namespace mvs::core;

namespace {

template <typename Law>
void describe(std::span<const Law> laws, uint32_t index, mvs_law *law) {
  MVS_MUST(index < laws.size(), MVS_E_ARGUMENT, "index", "index is %u, but there are %zu laws",
           index, laws.size());
  mvs_law out = {};
  out.number = static_cast<uint32_t>(laws[index].id);
  out.word = laws[index].word;
  out.name = laws[index].name;
  for (const Constant &c : laws[index].constants) {
    out.constants[out.constant_count++] = {c.key, c.unit, c.fallback, c.low, c.high};
  }
  write_struct(law, out, "law");
}

}  // namespace

extern "C" {

uint32_t mvs_get_leaflet_law_count(void) {
  return static_cast<uint32_t>(leaflet_laws().size());
}

mvs_result mvs_get_leaflet_law(uint32_t index, mvs_law *law) {
  return at_boundary([&] { describe(leaflet_laws(), index, law); });
}

uint32_t mvs_get_chord_law_count(void) {
  return static_cast<uint32_t>(chord_laws().size());
}

mvs_result mvs_get_chord_law(uint32_t index, mvs_law *law) {
  return at_boundary([&] { describe(chord_laws(), index, law); });
}

mvs_result mvs_set_leaflet(mvs_sim *sim, mvs_id leaflet, const mvs_leaflet_desc *tissue) {
  return call_at_boundary(sim, [&](mvs_sim &s) {
    must_point(tissue, "tissue");
    const SnapshotPtr present = s.present();
    Valve valve = present->model->valve;
    std::vector<double> scale;
    bool found = false;
    for (Leaflet &part : valve.leaflets.edit()) {
      const double before = part.thickness;
      if (leaflet == 0 || part.id == leaflet) {
        found = true;
        set_tissue(part, *tissue);
      }
      scale.push_back(part.thickness / before);
    }
    MVS_MUST(found, MVS_E_ID, "leaflet", "the valve has no leaflet with the id %llu",
             static_cast<unsigned long long>(leaflet));
    for (size_t t = 0; t < valve.triangles.size(); ++t) {
      const uint32_t l = valve.triangle_leaflet[t];
      if (scale[l] != 1) valve.triangle_thickness[t] *= scale[l];
    }
    ModelPtr model = make_model(std::move(valve), present->model.get());
    State state = present->state;
    state.rest_tolerance = 0;
    replace_valve(s, {{std::move(model), std::move(state)}, {}});
  });
}

}  // extern "C"
