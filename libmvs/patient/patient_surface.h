// Input of a build: leaflets and landmarks of a patient, and the options.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "base/workers.h"
#include "model/kinds.h"
#include "patient/leaflet_sheet.h"

namespace mvs::core {

enum class SurfaceKind : uint32_t { automatic = 0, mid = 1, atrial = 2, skin = 3 };

// include/mvs/build.h describes the fields; empty: not known.
struct PatientSurface {
  SurfaceKind kind = SurfaceKind::automatic;
  std::string name = "valve";
  std::vector<Vec3> points;
  std::vector<Tri> triangles;
  std::vector<LeafletLabel> label;
  std::vector<double> thickness;
  std::vector<Vec3> annulus, commissures, anterior, tips;
  std::vector<Vec3> closed_points;
  std::vector<Tri> closed_triangles;
  std::vector<Vec3> closed_annulus, closed_tips;
};

struct BuildSettings {
  // empty: bilinear, with a closed surface the law of fitted_law.h
  std::optional<LeafletLawId> law;
  double edge = 0;            // m; 0: as for 1,000 vertices
  double thickness = 0.8e-3;  // m, where it is not known per point
  bool thickness_is_given = false;
  double chord_factor = 1;
  double coaptation_length = 8e-3;
  double edge_error = 0;  // m, of the free edge, farther out or in
  double edge_lost = 0;   // m, of tissue below it that may be missing; 0: from its filled notches
  double thickness_error = 0;  // m, of the leaflets, thicker or thinner
  double closed_error = 0;     // m, of places of the closed surface; 0: `usual_closed_error`
  uint32_t chords = 100;
  bool finds_leak = true;
  Workers *workers = nullptr;                  // that close variants of the valve at the same time
  std::function<void(const char *)> on_stage;  // called with the name of each stage as it begins
};

inline void begin_stage(const BuildSettings &settings, const char *name) {
  if (settings.on_stage) settings.on_stage(name);
}

}  // namespace mvs::core
