// Another tissue for a leaflet, and what laws say of themselves.
#include "api/sim_call.h"
#include "api/structs.h"
#include "api/valve_desc.h"
#include "model/chord_law.h"
#include "session/commit.h"

using namespace mvs::core;

namespace {

template <typename Law>
void describe(const Law *law, uint32_t number, const char *kind, mvs_law *description) {
  MVS_MUST(law, MVS_E_ARGUMENT, "law", "there is no law %u of %s", number, kind);
  mvs_law out = {};
  out.word = law->word;
  out.name = law->name;
  for (const Constant &c : law->constants) {
    out.constants[out.constant_count++] = {c.key, c.unit, c.fallback, c.low, c.high};
  }
  write_struct(description, out, "description");
}

}  // namespace

extern "C" {

mvs_result mvs_get_leaflet_law(uint32_t law, mvs_law *description) {
  return guarded([&] { describe(find_leaflet_law(law), law, "leaflets", description); });
}

mvs_result mvs_get_chord_law(uint32_t law, mvs_law *description) {
  return guarded([&] { describe(find_chord_law(law), law, "chordae", description); });
}

mvs_result mvs_set_leaflet(mvs_sim *sim, mvs_id leaflet, const mvs_leaflet_desc *tissue) {
  return guarded_call(sim, [&](mvs_sim &s) {
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
    replace_valve(s, {{std::move(model), present->state}, {}});
  });
}

}  // extern "C"
