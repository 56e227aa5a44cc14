#include "patient/mend_crossings.h"

#include <cstdio>
#include "geometry/intersect.h"
#include "tests/patient/sheets.h"
using namespace mvs::core;
using namespace mvs::core::test;
static void probe(const char *name, LeafletSheet s, const SheetRims &r) {
  const clock_t t0 = clock();
  const CrossingReport c = mend_crossings(s, r);
  std::printf("%-20s %zu -> %zu  move %.3f mm  %.3f s\n", name, c.before, c.after, c.largest_move * 1e3, double(clock() - t0) / CLOCKS_PER_SEC);
}
TEST_CASE("probe_mend") {
  const SheetWithRims r = real_sheet();
  if (!r.sheet.x.empty()) probe("real", r.sheet, r.rims);
  for (double deep : {0.4e-3, 0.6e-3, 1e-3, 1.5e-3}) {
    SheetWithRims w = double_wall(0.3e-3, 0.5e-3);
    // a vertex half way down the outer wall
    const uint32_t columns = static_cast<uint32_t>(w.rims.annulus.size());
    Vec3 &p = w.sheet.x[8 * columns + 7];
    const Vec3 radial = Vec3(p.x(), p.y(), 0).normalized();
    p -= deep * radial;
    probe("poked", w.sheet, w.rims);
    for (uint32_t k = 8; k < 11; ++k) w.sheet.x[8 * columns + k] -= deep * radial;
    probe("poked 4", w.sheet, w.rims);
  }
  for (double gap : {0.3e-3, 0.6e-3})
  for (double wide : {1e-3, 2e-3, 4e-3}) for (double deep : {0.5e-3, 0.8e-3}) {
    SheetWithRims w = double_wall(gap, 0.5e-3);
    const uint32_t columns = static_cast<uint32_t>(w.rims.annulus.size());
    const Vec3 c = w.sheet.x[8 * columns + 7];
    const Vec3 radial = Vec3(c.x(), c.y(), 0).normalized();
    for (size_t v = 0; v < w.sheet.x.size() / 2; ++v) {
      const double r2 = (w.sheet.x[v] - c).squaredNorm() / (wide * wide);
      w.sheet.x[v] -= deep * radial * std::max(0.0, 1 - r2);
    }
    std::printf("gap %.1f wide %.0f deep %.1f ", gap * 1e3, wide * 1e3, deep * 1e3);
    probe("bump", w.sheet, w.rims);
  }
  for (uint32_t n : {430u, 1600u}) {
    ParametricSheet p = parametric_sheet(n);
    const std::vector<uint8_t> a = marks_of(p.rims.annulus, p.sheet.x.size()), f = marks_of(p.rims.free_edge, p.sheet.x.size());
    const Rows stars = rows_of(p.sheet.x.size(), p.sheet.triangles);
    int done = 0;
    for (uint32_t v = 0; v < p.sheet.x.size() && done < 8; v += 41) {
      if (a[v] || f[v]) continue;
      ++done;
      // pulled past a neighbour
      const uint32_t w = neighbours_in(p.sheet.triangles, stars[v], v)[2];
      const Vec3 old = p.sheet.x[v];
      p.sheet.x[v] += 1.7 * (p.sheet.x[w] - p.sheet.x[v]) + Vec3(1e-5, 2e-5, 3e-5);
      if (done < 6) probe("pulled", p.sheet, p.rims);
      if (done < 6) p.sheet.x[v] = old;
    }
    probe("pulled 3", p.sheet, p.rims);
    disturb(p.sheet, 0.7 * mean_edge(p.sheet), 3);
    probe("wild noise", p.sheet, p.rims);
  }
}
