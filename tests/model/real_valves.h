// Real valves of other projects, if present: in the folder that MVS_TEST_DATA names, or in
// shared/data beside the checkout.
#pragma once

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "model/valve.h"

namespace mvs::core {

// Null if the file does not exist.
inline nlohmann::json read_real_valve(const std::string &file) {
  const char *folder = std::getenv("MVS_TEST_DATA");
  std::ifstream in((folder ? std::string(folder) : MVS_SOURCE_DIR "/../shared/data") + "/" + file);
  return in ? nlohmann::json::parse(in) : nlohmann::json();
}

inline Vec3 in_metres(const nlohmann::json &mm) {
  return Vec3(mm[0], mm[1], mm[2]) * 1e-3;
}

inline Chord segment(uint32_t a, uint32_t b, double rest_length_mm) {
  Chord chord;
  chord.a = a;
  chord.b = b;
  chord.rest_length = rest_length_mm * 1e-3;
  return chord;
}

// A mitral valve on a real annulus (alexkaiser/heart_valves): one leaflet sheet, branching chordae.
inline Valve kaiser_valve(const nlohmann::json &json) {
  Valve valve;
  for (const auto &p : json["vertices_relaxed"]) valve.rest.push_back(in_metres(p));
  for (const auto &t : json["faces"]) valve.triangles.push_back({t[0], t[1], t[2]});
  for (const auto &n : json["annulus"]) valve.annulus.push_back(n);
  for (const auto &c : json["chordae"]) valve.chords.push_back(segment(c[0], c[1], c[3]));
  for (const auto &n : json["papillary"]) valve.heads.push_back({0, "", n});
  valve.triangle_leaflet.assign(valve.triangles.size(), 0);
  valve.leaflets = {{0, "sheet"}};
  return valve;
}

// The case solved with FEBio: quads cut in two, straight chordae from two heads.
inline Valve febio_valve(const nlohmann::json &json) {
  Valve valve;
  for (const auto &p : json["vertices_open"]) valve.rest.push_back(in_metres(p));
  for (const auto &q : json["quads"]) {
    valve.triangles.push_back({q[0], q[1], q[2]});
    valve.triangles.push_back({q[0], q[2], q[3]});
  }
  for (const auto &n : json["annulus"]) valve.annulus.push_back(n);
  for (const auto &c : json["chords"]) {
    valve.chords.push_back(segment(c["papillary"], c["leaflet"], c["rest_length"]));
  }
  for (const auto &n : json["papillary"]) valve.heads.push_back({0, "", n});
  valve.triangle_leaflet.assign(valve.triangles.size(), 0);
  valve.leaflets = {{0, "sheet"}};
  return valve;
}

}  // namespace mvs::core
