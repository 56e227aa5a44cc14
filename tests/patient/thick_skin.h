// Skins of valves of known thickness, and distances of a found mid-surface from the true one.
#pragma once

#include "base/math.h"
#include "geometry/triangle_bvh.h"
#include "model/sides.h"
#include "patient/findings.h"
#include "patient/skin/mid_surface.h"
#include "patient/surface/clean_surface.h"
#include "patient/surface/rims.h"
#include "tests/patient/parametric_sheet.h"
#include "tests/patient/surfaces.h"

namespace mvs::core::test {

// A mid-surface with normals into the atrium.
struct Tissue {
  LeafletSheet sheet;
  SheetRims rims;
};

inline Tissue tissue_of(const Surface &s) {
  Tissue made;
  Findings findings;
  made.sheet = clean_surface(s.x, s.triangles, {}, {}, findings);
  made.rims = find_rims(made.sheet, {}, findings);
  return made;
}

inline const Tissue &fine_tissue() {
  static const Tissue made = tissue_of(surface_of(parametric_sheet(1600).sheet));
  return made;
}

// 0.8 to 1.6 mm, twice around the valve.
inline double thickness_at(const Vec3 &p) {
  const double angle = math::atan2(p.y(), p.x());
  return 1.2e-3 + 0.4e-3 * math::sin(2 * angle) * math::cos(p.z() / 4e-3);
}

inline double evenly_thick(const Vec3 &) {
  return 1.5e-3;
}

// From 1.6 mm at z = 0 to a sharp edge of 0.2 mm at z = -12 mm, of a funnel.
inline double tapered(const Vec3 &p) {
  return 1.6e-3 + 1.4e-3 * p.z() / 12e-3;
}

using ThicknessField = double (*)(const Vec3 &);

inline std::vector<Vec3> vertex_normals(const LeafletSheet &sheet) {
  std::vector<Vec3> normal(sheet.x.size(), Vec3::Zero());
  for (const Tri &t : sheet.triangles) {
    const Vec3 area = (sheet.x[t[1]] - sheet.x[t[0]]).cross(sheet.x[t[2]] - sheet.x[t[0]]);
    for (const uint32_t i : t) normal[i] += area;
  }
  for (Vec3 &n : normal) n.normalize();
  return normal;
}

// Both sides, half a thickness from the mid-surface, sewn at the rims by a round band of `rows`
// rows of quads; one row makes a flat band.
inline Surface skin_of(const Tissue &tissue, uint32_t rows,
                       ThicknessField thickness = thickness_at) {
  const LeafletSheet &mid = tissue.sheet;
  const uint32_t n = static_cast<uint32_t>(mid.x.size());
  const std::vector<Vec3> normal = vertex_normals(mid);
  Surface s;
  for (const double side : {0.5, -0.5}) {
    for (uint32_t i = 0; i < n; ++i) {
      s.x.push_back(mid.x[i] + side * thickness(mid.x[i]) * normal[i]);
    }
  }
  for (const Tri &t : mid.triangles) {
    s.triangles.push_back(t);
    s.triangles.push_back({t[0] + n, t[2] + n, t[1] + n});
  }
  for (const std::vector<uint32_t> &loop : {tissue.rims.annulus, tissue.rims.free_edge}) {
    const size_t m = loop.size();
    std::vector<uint32_t> row = loop;  // the atrial side first
    for (uint32_t r = 1; r <= rows; ++r) {
      std::vector<uint32_t> next(m);
      for (size_t k = 0; k < m; ++k) {
        const uint32_t i = loop[k];
        next[k] = i + n;
        if (r == rows) continue;
        const Vec3 along = mid.x[loop[(k + 1) % m]] - mid.x[loop[(k + m - 1) % m]];
        const Vec3 out = along.cross(normal[i]).normalized();
        const double angle = 3.14159265358979 * r / rows, half = 0.5 * thickness(mid.x[i]);
        next[k] = static_cast<uint32_t>(s.x.size());
        s.x.push_back(mid.x[i] + half * (math::cos(angle) * normal[i] + math::sin(angle) * out));
      }
      for (size_t k = 0; k < m; ++k) {
        const size_t q = (k + 1) % m;
        s.triangles.push_back({row[q], row[k], next[k]});
        s.triangles.push_back({row[q], next[k], next[q]});
      }
      row = next;
    }
  }
  return s;
}

// Distances from the true mid-surface over the local thickness, and the share of the area with a
// thickness within 15 %.
struct MidError {
  double rms = 0, worst = 0, right_thickness = 0, covered = 0;
};

inline MidError error_of(const LeafletSheet &found, const LeafletSheet &truth,
                         ThicknessField field = thickness_at) {
  const TriangleBvh bvh(truth.triangles, truth.x);
  MidError e;
  double all = 0, whole = 0;
  for (const Tri &t : found.triangles) {
    const double area = triangle_area(found.x, t);
    all += area;
    for (const uint32_t i : t) {
      const TriangleBvh::Hit hit = bvh.closest(found.x[i]);
      const double thickness = field(hit.point), off = std::sqrt(hit.distance2) / thickness;
      e.rms += area / 3 * off * off;
      e.worst = std::max(e.worst, off);
      if (std::abs(found.thickness[i] / thickness - 1) < 0.15) e.right_thickness += area / 3;
    }
  }
  for (const Tri &t : truth.triangles) whole += triangle_area(truth.x, t);
  e.rms = std::sqrt(e.rms / all);
  e.right_thickness /= all;
  e.covered = all / whole;
  return e;
}

inline LeafletSheet mid_of(const Surface &s, Findings &findings) {
  const LeafletSheet skin = clean_surface(s.x, s.triangles, {}, {}, findings);
  return mid_of_skin(skin, {}, findings);
}

}  // namespace mvs::core::test
