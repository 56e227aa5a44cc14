// Writer, strict reader and search of places of grasps.
#include "formats/plan/grasp.h"

#include <algorithm>

#include "base/error.h"
#include "formats/plan/named.h"
#include "model/part_names.h"

namespace mvs::core {
namespace {

// A vertex on the edge between two scallops belongs to that of the first triangle which has it, as
// for the site of an operation.
bool is_in_scallop(const Valve &valve, uint32_t node) {
  if (valve.triangle_scallop.size() != valve.triangles.size()) return false;
  for (size_t t = 0; t < valve.triangles.size(); ++t) {
    const Tri &tri = valve.triangles[t];
    if (std::find(tri.begin(), tri.end(), node) == tri.end()) continue;
    return valve.triangle_scallop[t] < valve.scallops.size();
  }
  return false;
}

double share_at(const Json &place, const char *key) {
  MVS_MUST(place.has(key) && place[key].is_number() && place[key].number() >= 0 &&
               place[key].number() <= 1,
           MVS_E_FORMAT, "plan", "place: %s has to be a number from 0 to 1", key);
  return place[key].number();
}

template <typename Parts>
const auto &part_at_place(const Parts &parts, const std::string &name, const char *word) {
  const auto *found = find_named(parts, name);
  MVS_MUST(found != nullptr, MVS_E_ID, name,
           "the grasp is at the %s \"%.63s\", which the valve does not have%s", word, name.c_str(),
           near_names(name, parts).c_str());
  return *found;
}

}  // namespace

Json place_json(const Model &model, uint32_t node) {
  const Valve &valve = model.valve;
  if (is_in_scallop(valve, node)) {
    mvs_site site = {};
    site.how = MVS_SITE_NODE;
    site.index = node;
    Json place;
    set_anatomical(model, site, place);
    return place;
  }
  for (const Chord &chord : valve.chords) {
    if (chord.b == node) return Json::object({{"chord", chord.name}});
  }
  return {};
}

void check_place(const Json &place) {
  constexpr const char *wanted =
      "place has to be an object with scallop, along and height, or chord";
  MVS_MUST(place.is_object(), MVS_E_FORMAT, "plan", "%s", wanted);
  const bool is_chord = place.has("chord");
  const char *const word = is_chord ? "chord" : "scallop";
  MVS_MUST(place.has(word) && place[word].is_text(), MVS_E_FORMAT, "plan", "%s", wanted);
  MVS_MUST(place.members().size() == (is_chord ? 1u : 3u), MVS_E_FORMAT, "plan", "%s", wanted);
  if (is_chord) return;
  share_at(place, "along");
  share_at(place, "height");
}

uint32_t node_at_place(const Model &model, const Json &place) {
  const Valve &valve = model.valve;
  if (place.has("chord")) {
    return part_at_place(valve.chords.get(), place["chord"].text(), "chord").b;
  }
  mvs_site site = {};
  site.how = MVS_SITE_ANATOMICAL;
  site.scallop = part_at_place(valve.scallops.get(), place["scallop"].text(), "scallop").id;
  site.u[0] = share_at(place, "along");
  site.u[1] = share_at(place, "height");
  return vertex_at(model, site);
}

}  // namespace mvs::core
