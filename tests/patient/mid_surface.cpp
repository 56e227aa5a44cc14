// Mid-surfaces beside those from which sides and skins were made.
#include "patient/mid_surface.h"

#include <doctest/doctest.h>

#include "base/error.h"
#include "base/math.h"
#include "geometry/bvh.h"
#include "geometry/intersect.h"
#include "model/sides.h"
#include "patient/boundary.h"
#include "patient/clean_surface.h"
#include "tests/patient/parametric_sheet.h"
#include "tests/patient/surfaces.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

// A mid-surface with normals into the atrium.
struct Tissue {
  LeafletSheet sheet;
  SheetRims rims;
};

Tissue tissue_of(const Surface &s) {
  Tissue made;
  Findings findings;
  made.sheet = clean_surface(s.x, s.triangles, {}, {}, findings);
  made.rims = find_rims(made.sheet, {}, findings);
  return made;
}

// 0.8 to 1.6 mm, twice around the valve.
double thickness_at(const Vec3 &p) {
  const double angle = math::atan2(p.y(), p.x());
  return 1.2e-3 + 0.4e-3 * math::sin(2 * angle) * math::cos(p.z() / 4e-3);
}

std::vector<Vec3> vertex_normals(const LeafletSheet &sheet) {
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
Surface skin_of(const Tissue &tissue, uint32_t rows) {
  const LeafletSheet &mid = tissue.sheet;
  const uint32_t n = static_cast<uint32_t>(mid.x.size());
  const std::vector<Vec3> normal = vertex_normals(mid);
  Surface s;
  for (const double side : {0.5, -0.5}) {
    for (uint32_t i = 0; i < n; ++i) {
      s.x.push_back(mid.x[i] + side * thickness_at(mid.x[i]) * normal[i]);
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
        const double angle = 3.14159265358979 * r / rows, half = 0.5 * thickness_at(mid.x[i]);
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

MidError error_of(const LeafletSheet &found, const LeafletSheet &truth) {
  const TriangleBvh bvh(truth.triangles, truth.x);
  MidError e;
  double all = 0, whole = 0;
  for (const Tri &t : found.triangles) {
    const double area = triangle_area(found.x, t);
    all += area;
    for (const uint32_t i : t) {
      const TriangleBvh::Hit hit = bvh.closest(found.x[i]);
      const double thickness = thickness_at(hit.point), off = std::sqrt(hit.distance2) / thickness;
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

LeafletSheet mid_of(const Surface &s, Findings &findings) {
  const LeafletSheet skin = clean_surface(s.x, s.triangles, {}, {}, findings);
  return mid_of_skin(skin, {}, findings);
}

}  // namespace

TEST_CASE("mid_of_skin_finds_the_mid_surface_and_the_thickness") {
  const Tissue tissue = tissue_of(surface_of(parametric_sheet(1600).sheet));
  for (const uint32_t rows : {1u, 2u, 4u}) {
    for (const bool inside_out : {false, true}) {
      Surface s = renumbered(skin_of(tissue, rows), 11);
      if (inside_out) s = flipped(s, 1);
      Findings findings;
      LeafletSheet mid = mid_of(soup(s), findings);
      const MidError e = error_of(mid, tissue.sheet);
      CAPTURE(rows);
      MESSAGE(e.rms, " ", e.worst, " ", e.right_thickness, " ", e.covered);
      CHECK(e.rms < 0.15);
      CHECK(e.right_thickness > 0.95);
      CHECK(e.covered > 0.9);
      REQUIRE(find(findings, "thickness"));
      CHECK(find(findings, "thickness")->value[0] == doctest::Approx(1.2e-3).epsilon(0.1));
      Findings rim_findings;
      const SheetRims rims = find_rims(mid, {}, rim_findings);
      CHECK(shape_of(mid, rims.annulus).length ==
            doctest::Approx(shape_of(tissue.sheet, tissue.rims.annulus).length).epsilon(0.05));
      CHECK(find_intersections(mid.x, mid.triangles).empty());
    }
  }
}
