// Clamped discs under pressure: Hencky's linear membrane, and finite inflation of tissue, closed by
// the library's own Newton from flat.
#include <mvs/valve.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tests/verification/patch.h"
#include "tests/verification/study.h"

namespace mvs::core::verification {
namespace {

constexpr double radius = 10e-3;

// Radii of the rings of nodes are in the table of profiles: 2, 1, 0.5 and in long runs 0.25 mm
// apart.
std::vector<uint32_t> levels() {
  return long_runs() ? std::vector<uint32_t>{5, 10, 20, 40} : std::vector<uint32_t>{5, 10, 20};
}

struct Disc {
  Model model;
  Positions x;
  double edge;  // m, radius over rings
  uint32_t rings;
};

enum Mesh { rings_of_triangles, irregular };

// Inner nodes moved within the plane by up to a quarter of the distance of the rings; node 0, whose
// height is compared, stays.
void disturb(Valve &valve, uint32_t rings) {
  test::Random random(7);
  const uint32_t inner = 1 + 3 * rings * (rings - 1);
  for (uint32_t i = 1; i < inner; ++i) {
    const double u = random(-0.25, 0.25), v = random(-0.25, 0.25);
    valve.rest[i] += radius / rings * Vec3(u, v, 0);
  }
}

Disc inflated(const Published &law, uint32_t rings, double pressure, Mesh mesh) {
  Disc disc;
  disc.rings = rings;
  disc.edge = radius / rings;
  disc.model = test::clamped_disc(rings, radius, [&](Valve &valve) {
    valve.leaflets.resize(1);
    valve.leaflets[0].law = law.law;
    valve.leaflets[0].constants = law.constants;
    valve.bending_scale = 0;
    if (mesh == irregular) disturb(valve, rings);
  });
  SolveOptions options;
  // relative to the force of the pressure on a node
  options.residual = 1e-5 * pressure * disc.edge * disc.edge;
  const test::Settled settled = test::settle(disc.model, pressure, 0, options);
  if (!settled.stats.converged) throw std::runtime_error("a disc did not come to rest");
  disc.x = settled.state.x;
  return disc;
}

double height(const Disc &disc) {
  return disc.x[0].z();
}

// A profile of shared/data/verification/b_finite_membrane_profiles.csv: rest radius, r and w in m.
struct Profile {
  std::vector<double> s, r, w;
};
Profile profile(const std::string &material, double pressure_kpa) {
  Profile p;
  for (const test::Cells &row : test::reference_table("b_finite_membrane_profiles.csv")) {
    if (row[0] != material || std::stod(row[1]) != pressure_kpa) continue;
    p.s.push_back(1e-3 * std::stod(row[2]));
    p.r.push_back(1e-3 * std::stod(row[3]));
    p.w.push_back(1e-3 * std::stod(row[4]));
  }
  return p;
}

// Root mean square over the nodes of the distance from the profile; each node is on a ring.
double distance_from(const Profile &p, const Disc &disc) {
  double sum = 0;
  size_t node = 0;
  for (uint32_t ring = 0; ring <= disc.rings; ++ring) {
    const double s = radius * ring / disc.rings;
    const size_t at = static_cast<size_t>(std::lround(s / 0.25e-3));
    for (uint32_t k = 0; k < std::max(6 * ring, 1u); ++k, ++node) {
      const Vec3 &x = disc.x[node];
      const double off = std::hypot(x.head<2>().norm() - (ring > 0 ? p.r[at] : 0), x.z() - p.w[at]);
      sum += off * off;
    }
  }
  return std::sqrt(sum / static_cast<double>(disc.x.size()));
}

// The larger principal stretch, mean over the triangles with a side on the rim, and its value at
// the rim itself: the slope of the profile by one-sided differences of fourth order.
double stretch_at_rim(const Disc &disc) {
  double sum = 0;
  uint32_t count = 0;
  const uint32_t first = 1 + 3 * disc.rings * (disc.rings - 1);
  for (size_t t = 0; t < disc.model.valve.triangles.size(); ++t) {
    const Tri &n = disc.model.valve.triangles[t];
    if (std::count_if(n.begin(), n.end(), [&](uint32_t i) { return i >= first; }) < 2) continue;
    Eigen::Matrix<double, 3, 2> sides;
    sides << disc.x[n[1]] - disc.x[n[0]], disc.x[n[2]] - disc.x[n[0]];
    const Eigen::Matrix<double, 3, 2> f = sides * rest_inverse(disc.model.valve, t);
    const Mat2 c = f.transpose() * f;
    const double half = 0.5 * c.trace();
    sum += std::sqrt(half + std::sqrt(half * half - c.determinant()));
    ++count;
  }
  return sum / count;
}

double slope_at_end(const std::vector<double> &y, double h) {
  const size_t n = y.size();
  return (25 * y[n - 1] - 48 * y[n - 2] + 36 * y[n - 3] - 16 * y[n - 4] + 3 * y[n - 5]) / (12 * h);
}

Study study_of(const std::string &name, const std::string &title) {
  Study s;
  s.name = name;
  s.title = title;
  s.quantity = "height of the centre, m";
  s.level = "edge, m";
  s.expects = "2: linear triangles";
  s.tolerance = 0.01;
  s.order_low = 1.7;
  s.order_high = 2.3;
  return s;
}

// Strains of 1.6e-5, so that the law is Hencky's linear tissue to 1.4e-5 of the height, a tenth of
// the error of the finest mesh; nu = 1/2. Forces round to 1.7e-10 N, a quarter of the residual
// there: with 1e11 Pa they round to 6e-10 N, the residual itself.
Study hencky() {
  Study s = study_of("hencky_disc", "Hencky's disc");
  s.source =
      "shared/data/verification/b_hencky_disc.csv, nu 0.5: w0 = 0.594879 a (p a / E h)^(1/3)";
  const double pressure = 1e3, young = 3e10;
  for (const test::Cells &row : test::reference_table("b_hencky_disc.csv")) {
    if (std::stod(row[0]) != 0.5 || std::stod(row[4]) != 1e-5) continue;
    // p a / E h = 1e-3 in that row
    const double exact =
        std::stod(row[6]) * 10 * radius * std::cbrt(pressure * radius / young / 1e-3);
    Published law = published("neo-Hookean");
    law.constants[0] = young / 3;
    for (const uint32_t rings : levels()) {
      for (const Mesh mesh : {rings_of_triangles, irregular}) {
        const Disc disc = inflated(law, rings, pressure, mesh);
        s.rows.push_back({mesh == irregular ? "irregular triangles" : "rings of triangles", 0,
                          disc.edge, height(disc), exact});
      }
    }
  }
  return s;
}

// Springs on the same meshes: each converges, but not to the tissue's deflection.
Study hencky_of_springs() {
  Study s = study_of("hencky_disc_springs", "Hencky's disc of springs");
  s.source = "as for the membrane, nu = 1/3: what an equilateral lattice has";
  s.expects = "none: rings of triangles are no lattice, and refinement does not make them one";
  s.tolerance = s.order_low = s.order_high = 0;
  const double pressure = 1e3, young = 3e10;
  Published law = published("springs");
  law.constants = {young, young, 10};
  for (const test::Cells &row : test::reference_table("b_hencky_disc.csv")) {
    if (std::abs(std::stod(row[0]) - 1. / 3) > 1e-6 || std::stod(row[4]) != 1e-5) continue;
    const double exact =
        std::stod(row[6]) * 10 * radius * std::cbrt(pressure * radius / young / 1e-3);
    for (const uint32_t rings : {5u, 10u, 20u}) {
      for (const Mesh mesh : {rings_of_triangles, irregular}) {
        const Disc disc = inflated(law, rings, pressure, mesh);
        s.rows.push_back({mesh == irregular ? "irregular triangles" : "rings of triangles", 0,
                          disc.edge, height(disc), exact});
      }
    }
  }
  return s;
}

struct Inflation {
  const char *material;  // of the table
  const char *law;
  double pressure_kpa;
  bool has_profile;
};
const Inflation inflations[] = {{"neoHooke_mu33.333kPa(E=100kPa)", "neo-Hookean", 1, true},
                                {"bilinear_fit", "bilinear", 1, true},
                                {"bilinear_fit", "bilinear", 4, false},
                                {"bilinear_fit", "bilinear", 15.9987, true}};

double centre_in_table(const Inflation &inflation) {
  for (const test::Cells &row : test::reference_table("b_finite_membrane_disc.csv")) {
    if (row[0] == inflation.material && std::stod(row[3]) == inflation.pressure_kpa) {
      return 1e-3 * std::stod(row[4]);
    }
  }
  return 0;
}

void add_inflation(const Inflation &inflation, Study &centre, Study &shape, Study &rim) {
  const double exact = centre_in_table(inflation);
  if (exact == 0) return;
  const Profile p = profile(inflation.material, inflation.pressure_kpa);
  for (const uint32_t rings : levels()) {
    const Disc disc =
        inflated(published(inflation.law), rings, 1e3 * inflation.pressure_kpa, rings_of_triangles);
    const double kpa = inflation.pressure_kpa;
    centre.rows.push_back({inflation.law, kpa, disc.edge, height(disc), exact});
    if (!inflation.has_profile) continue;
    shape.rows.push_back({inflation.law, kpa, disc.edge, distance_from(p, disc), 0, exact});
    const double slope = std::hypot(slope_at_end(p.r, 0.25e-3), slope_at_end(p.w, 0.25e-3));
    rim.rows.push_back({inflation.law, kpa, disc.edge, stretch_at_rim(disc) - 1, slope - 1});
  }
}

}  // namespace

std::vector<Study> disc_studies() {
  Study centre = study_of("finite_disc", "Finite inflation of a disc");
  centre.x = "pressure, kPa";
  centre.source =
      "shared/data/verification/b_finite_membrane_disc.csv, shooting on the ODE of the membrane";
  Study shape = centre;
  shape.name = "finite_disc_profile";
  shape.title = "Finite inflation of a disc, the whole profile";
  shape.quantity = "distance of nodes from the profile, root mean square, m";
  shape.source = "shared/data/verification/b_finite_membrane_profiles.csv";
  Study rim = shape;
  rim.name = "finite_disc_stretch";
  rim.title = "Finite inflation of a disc, strain at the rim";
  rim.quantity = "larger principal strain of the triangles on the rim";
  rim.expects = "1: strain is constant in a triangle, and the rim is its border";
  rim.order_low = 0.7;
  rim.order_high = 1.3;
  for (const Inflation &inflation : inflations) add_inflation(inflation, centre, shape, rim);
  return {hencky(), hencky_of_springs(), centre, shape, rim};
}

}  // namespace mvs::core::verification
