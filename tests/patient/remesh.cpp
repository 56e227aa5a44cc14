#include <cstdio>
#include <ctime>
#include "patient/remesh_sheet.h"
#include "tests/patient/sheets.h"
using namespace mvs::core;
using namespace mvs::core::test;
static void probe(const char *name, const LeafletSheet &s, const SheetRims &r, double edge) {
  const clock_t t0 = clock();
  RemeshedSheet m;
  try {
    m = remesh_sheet(s, r, {edge, 10});
  } catch (std::exception &e) {
    std::printf("%s: %s\n", name, e.what());
    return;
  }
  const double cpu = double(clock() - t0) / CLOCKS_PER_SEC;
  std::printf(
      "%-22s edge %.2f tri %zu -> %zu  worst %.1f  mean/edge %.3f short %.2f long %.2f off %.3f mm "
      "cross %zu area %.4f ann %.4f free %.4f  %.2f s\n",
      name, edge * 1e3, s.triangles.size(), m.sheet.triangles.size(),
      m.report.worst_angle * 57.29578, m.report.mean_edge / edge, m.report.shortest / edge,
      m.report.longest / edge, m.report.largest_distance * 1e3, m.report.crossings,
      sheet_area(m.sheet) / sheet_area(s),
      loop_length(m.sheet, m.rims.annulus) / loop_length(s, r.annulus),
      loop_length(m.sheet, m.rims.free_edge) / loop_length(s, r.free_edge), cpu);
      for (const auto &t : m.sheet.triangles) {
        const Vec3 &a = m.sheet.x[t[0]], &b = m.sheet.x[t[1]], &c = m.sheet.x[t[2]];
        double l = std::max({(a-b).norm(), (b-c).norm(), (c-a).norm()}) / edge;
        double sh = std::min({(a-b).norm(), (b-c).norm(), (c-a).norm()}) / edge;
        double ar = (b-a).cross(c-a).norm();
        double h = ar / l / edge; double sn = 0;
        for (auto [p,q,w] : {std::array{a,b,c}, std::array{b,c,a}, std::array{c,a,b}}) { double cc = (q-p).dot(w-p)/(q-p).norm()/(w-p).norm(); sn = std::max(sn, cc); }
        (void)h;
        if (l > 1.5 || sh < 0.5 || sn > std::cos(30/57.3)) { std::printf("   long %.2f short %.2f angle %.1f: ", l, sh, std::acos(sn)*57.3);
          for (uint32_t v : t) { bool A = std::find(m.rims.annulus.begin(), m.rims.annulus.end(), v) != m.rims.annulus.end(); bool F = std::find(m.rims.free_edge.begin(), m.rims.free_edge.end(), v) != m.rims.free_edge.end(); std::printf(" %u%s (%.2f %.2f %.2f)", v, A ? "A" : F ? "F" : "", m.sheet.x[v].x()*1e3, m.sheet.x[v].y()*1e3, m.sheet.x[v].z()*1e3); }
          std::printf("\n"); }
      }
}
TEST_CASE("probe") {
  for (uint32_t n : {430u, 1600u, 2600u}) {
    ParametricSheet p = parametric_sheet(n);
    const double e = mean_edge(p.sheet);
    for (double f : {0.7, 1.0, 1.5}) {
      probe("parametric", p.sheet, p.rims, f * e);
    }
    SheetWithRims q = renumbered(p.sheet, p.rims, 5);
    probe("renumbered", q.sheet, q.rims, e);
    disturb(p.sheet, 0.2e-3, 7);
    probe("noisy", p.sheet, p.rims, e);
  }
  for (double e : {0.5e-3, 1e-3}) {
    SheetWithRims w = double_wall(0.3e-3, 0.5e-3);
    probe("double wall", w.sheet, w.rims, e);
  }
  SheetWithRims real = real_sheet();
  if (!real.sheet.x.empty())
    for (double e : {1e-3, 1.3e-3, 1.7e-3}) probe("real", real.sheet, real.rims, e);
}

TEST_CASE("stress") {
  for (double gap : {0.1e-3, 0.3e-3}) for (double edge : {0.4e-3, 0.8e-3, 1.5e-3, 2.5e-3}) {
    // hairpin: a half circle of the gap's width
    std::vector<std::array<double, 2>> profile;
    for (int k = 16; k > 0; --k) profile.push_back({14e-3 + 0.5 * gap, k * 0.5e-3});
    for (int k = 0; k <= 4; ++k) profile.push_back({14e-3 + 0.5 * gap * std::cos(k * 0.785398), -0.5 * gap * std::sin(k * 0.785398)});
    for (int k = 1; k <= 16; ++k) profile.push_back({14e-3 - 0.5 * gap, k * 0.5e-3});
    SheetWithRims w = revolved(profile, 176);
    std::printf("gap %.1f ", gap * 1e3);
    probe("hairpin", w.sheet, w.rims, edge);
    disturb(w.sheet, gap * 0.2, 3);
    probe("noisy hairpin", w.sheet, w.rims, edge);
    SheetWithRims b = double_wall(gap, 0.5e-3);
    probe("wall", b.sheet, b.rims, edge);
  }
  for (uint32_t n : {430u, 1600u}) for (double f : {0.4, 3.0, 5.0}) {
    ParametricSheet p = parametric_sheet(n);
    const double e = mean_edge(p.sheet);
    probe("parametric", p.sheet, p.rims, e * f);
  }
}
