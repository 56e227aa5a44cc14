// Parts by their names, and places on leaflets by anatomical coordinates, as plans write them.
#pragma once

#include <algorithm>
#include <string>

#include "base/error.h"
#include "formats/text/json.h"
#include "model/model.h"
#include "surgery/leaflet/site.h"

namespace mvs::core {

// Null for a name that no part has.
template <typename Parts>
auto find_named(const Parts &parts, const std::string &name) {
  const auto found =
      std::find_if(parts.begin(), parts.end(), [&](const auto &part) { return part.name == name; });
  return found == parts.end() ? nullptr : &*found;
}

template <typename Parts>
std::string name_in(const Parts &parts, Id id) {
  for (const auto &part : parts) {
    if (part.id == id) return part.name;
  }
  fail(MVS_E_INTERNAL, "plan", "a part with id %llu is not in the valve it was used on",
       static_cast<unsigned long long>(id));
}

// Adds the scallop of a site and its shares along the annulus and of the height.
inline void set_anatomical(const Model &model, const mvs_site &site, Json &json) {
  const mvs_site place = anatomical(model, site);
  json.set("scallop", name_in(model.valve.scallops, place.scallop));
  json.set("along", place.u[0]);
  json.set("height", place.u[1]);
}

}  // namespace mvs::core
