// A strip that bends under its own weight, and what hinges make of other meshes.
//
// The table's E I for a strip of hinges: on an equilateral lattice, a hinge across the
// direction n opens by what its two far corners rise above its edge: for a curvature K that is in
// proportion to n . K n - tr K / 4. Squared and summed over the three directions,
//     W = D / 2 ((1 - nu) K : K + nu (tr K)^2)  with nu = -1/3,
// a plate with D as it was put in, E t^3 / (12 (1 - 1/4)) (bending_meshes.cpp measures it). So:
// - a strip that cannot curl across (wide: width^2 curvature / thickness >> 1) has E I = D b, which
//   is right for tissue: its plate has the same D;
// - a narrow strip that curls as it likes has E I = (1 - nu^2) D b = 8/9 D b, where tissue, with
//   nu = 1/2, has 3/4 D b = E b t^3 / 12. There hinges are 32/27 times too stiff, and the strip
//   curls the other way.
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tests/verification/balance.h"
#include "tests/verification/elastica.h"
#include "tests/verification/patch.h"
#include "tests/verification/study.h"

namespace mvs::core::verification {
namespace {

constexpr double length = 20e-3, young = 100e3;

double rigidity(double thickness) {
  return young * thickness * thickness * thickness / (12 * 0.75);
}

// A strip of rows of equilateral triangles across it. The first two rows of nodes are held, and the
// clamp is half-way between them: a hinge bends half a triangle on either side.
struct Strip {
  Model model;
  uint32_t cells, rows;
  double spacing;  // m, of the rows
  std::vector<uint32_t> held;

  uint32_t row_of(size_t node) const { return static_cast<uint32_t>(node) / (cells + 1); }
  double station(uint32_t row) const { return (row - 0.5) * spacing; }  // m from the clamp
};

Strip strip_of(uint32_t cells, uint32_t rows, double thickness, double disturbed) {
  const double spacing = length / (rows - 0.5), edge = spacing / std::sqrt(0.75);
  Valve valve;
  valve.leaflets.resize(1);
  valve.leaflets[0].law = LeafletLawId::neo_hookean;
  valve.leaflets[0].constants = {young / 3};
  valve.leaflets[0].thickness = thickness;
  test::Random random(11);
  for (uint32_t j = 0; j <= rows; ++j) {
    for (uint32_t i = 0; i <= cells; ++i) {
      const double u = random(-disturbed, disturbed), v = random(-disturbed, disturbed);
      const bool inside = i > 0 && i < cells && j > 1 && j < rows;
      valve.rest.push_back({(j - 0.5) * spacing + (inside ? u * edge : 0),
                            edge * (i + 0.5 * (j % 2)) + (inside ? v * edge : 0), 0});
    }
  }
  for (uint32_t j = 0; j < rows; ++j) {
    for (uint32_t i = 0; i < cells; ++i) {
      const uint32_t a = j * (cells + 1) + i, b = a + 1, c = a + cells + 1, d = c + 1;
      valve.triangles.push_back({a, j % 2 == 0 ? c : d, b});
      valve.triangles.push_back(j % 2 == 0 ? Tri{b, c, d} : Tri{a, c, d});
    }
  }
  Strip strip{test::model_of_sheet(valve, {}), cells, rows, spacing, {}};
  for (uint32_t n = 0; n < 2 * (cells + 1); ++n) strip.held.push_back(n);
  return strip;
}

// Dead weight by rest area, such that w L^3 / D b = g.
Positions weight(const Strip &strip, double g, double thickness) {
  Positions load;
  const double per_area = g * rigidity(thickness) / (length * length * length);
  for (const double area : strip.model.vertex_area) load.push_back(Vec3(0, 0, -per_area * area));
  return load;
}

// A start for Newton: rows in the directions of the elastica, without stretch.
Positions bent(const Strip &strip, const HeavyBeam &exact) {
  const Elastica elastica(exact);
  Positions line = {Vec3(-0.5 * strip.spacing, 0, 0), Vec3(0.5 * strip.spacing, 0, 0)};
  for (uint32_t row = 1; row < strip.rows; ++row) {
    const double theta = elastica.angle(row * strip.spacing / length);
    line.push_back(line.back() + strip.spacing * Vec3(std::cos(theta), 0, -std::sin(theta)));
  }
  Positions x = strip.model.valve.rest;
  for (Vec3 &p : x) {
    const double at = p.x() / strip.spacing + 0.5;
    const auto row = static_cast<size_t>(std::clamp(at, 0.0, strip.rows - 1.0));
    const double along = at - static_cast<double>(row);
    const Vec3 on = (1 - along) * line[row] + along * line[row + 1];
    p = Vec3(on.x(), p.y(), on.z());
  }
  return x;
}

double tip_drop(const Strip &strip, const Positions &x) {
  double sum = 0;
  for (uint32_t i = 0; i <= strip.cells; ++i) {
    sum -= x[strip.rows * (strip.cells + 1) + i].z();
  }
  return sum / (strip.cells + 1) / length;
}

// Newton in the plane: a row moves as one, along the strip and down.
class Cylinder {
 public:
  Cylinder(const Strip &strip, Positions load)
      : strip_(strip), load_(std::move(load)), membrane_(strip.model), bending_(strip.model) {
    std::vector<Edge> pairs;
    membrane_.add_pairs(pairs);
    bending_.add_pairs(pairs);
    system_.set_pattern(strip.model, pairs);
  }

  Positions rest(Positions x) {
    for (int k = 0; k < 200; ++k) {
      const Eigen::VectorXd force = reduced_force(x);
      // relative to the weight of a row; rounding of positions, 1e-17 m, causes 1e-6 of that
      if (force.lpNorm<Eigen::Infinity>() < 1e-5 * load_size()) return x;
      Eigen::VectorXd step = stiffness(x).partialPivLu().solve(-force);
      const double longest = step.lpNorm<Eigen::Infinity>();
      if (longest > 0.2 * strip_.spacing) step *= 0.2 * strip_.spacing / longest;
      for (size_t i = 0; i < x.size(); ++i) {
        if (strip_.row_of(i) < 2) continue;
        const Eigen::Index r = at(strip_.row_of(i));
        x[i] += Vec3(step[r], 0, step[r + 1]);
      }
    }
    throw std::runtime_error("the strip did not come to rest");
  }

 private:
  static Eigen::Index at(uint32_t row) { return 2 * (static_cast<Eigen::Index>(row) - 2); }
  Eigen::Index size() const { return at(strip_.rows) + 2; }
  double load_size() const {
    double sum = 0;
    for (const Vec3 &f : load_) sum += f.norm();
    return sum / strip_.rows;
  }

  Eigen::VectorXd reduced_force(const Positions &x) const {
    Positions g(x.size(), Vec3::Zero());
    membrane_.gradient(x, g);
    bending_.gradient(x, g);
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(size());
    for (size_t i = 0; i < x.size(); ++i) {
      if (strip_.row_of(i) < 2) continue;
      const Eigen::Index r = at(strip_.row_of(i));
      sum[r] += g[i].x() - load_[i].x();
      sum[r + 1] += g[i].z() - load_[i].z();
    }
    return sum;
  }

  Eigen::MatrixXd stiffness(const Positions &x) {
    system_.clear();
    membrane_.hessian(x, Curvature::exact, system_);
    bending_.hessian(x, Curvature::exact, system_);
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(size(), size());
    const BlockMatrix &m = system_.matrix;
    for (uint32_t c = 0; c < m.size(); ++c) {
      for (uint32_t slot = m.start[c]; slot < m.start[c + 1]; ++slot) {
        const uint32_t i = system_.node_of[m.row[slot]], j = system_.node_of[c];
        if (strip_.row_of(i) < 2 || strip_.row_of(j) < 2) continue;
        const Eigen::Index p = at(strip_.row_of(i)), q = at(strip_.row_of(j));
        const Mat3 &b = m.value[slot];
        Eigen::Matrix2d block;
        block << b(0, 0), b(0, 2), b(2, 0), b(2, 2);
        sum.block<2, 2>(p, q) += block;
        if (i != j) sum.block<2, 2>(q, p) += block.transpose();
      }
    }
    return sum;
  }

  const Strip &strip_;
  Positions load_;
  MembraneTerm membrane_;
  BendingTerm bending_;
  HessianAssembler system_;
};

Study study_of(const std::string &name, const std::string &title) {
  Study s;
  s.name = name;
  s.title = title;
  s.quantity = "drop of the tip over the length";
  s.x = "w L^3 / D b";
  s.level = "edge, m";
  s.source = "shared/data/verification/e_heavy_cantilever.csv with E I = D b";
  return s;
}

bool is_looked_at(double g) {
  return g == 1 || g == 5 || g == 20;
}

Study cylindrical() {
  Study s = study_of("heavy_cantilever", "A wide strip under its weight, bent to a cylinder");
  s.expects = "2: a polygon of hinges";
  s.tolerance = 0.01;
  s.order_low = 1.8;
  s.order_high = 2.2;
  const double thickness = 0.1e-3;
  for (const HeavyBeam &exact : heavy_beams()) {
    if (!is_looked_at(exact.g)) continue;
    for (const uint32_t rows : {5u, 10u, 20u, 40u}) {
      const Strip strip = strip_of(3, rows, thickness, 0);
      const Positions load = weight(strip, exact.g, thickness);
      const Positions x = Cylinder(strip, load).rest(bent(strip, exact));
      s.rows.push_back({"drop", exact.g, mean_edge(strip.model), tip_drop(strip, x), exact.drop});
    }
  }
  return s;
}

// All nodes free: also to curl across. On irregular meshes stretch resists, since a sheet of
// triangles bends without stretching only along its edges.
Row free_strip(const std::string &name, const HeavyBeam &exact, double g, uint32_t cells,
               uint32_t rows, double thickness, double disturbed) {
  const Strip strip = strip_of(cells, rows, thickness, disturbed);
  const Positions load = weight(strip, g, thickness);
  double total = 0;
  for (const Vec3 &f : load) total += f.norm();
  const Positions x = Balance(strip.model, strip.held).rest(bent(strip, exact), load, 1e-6 * total);
  return {name, exact.g, mean_edge(strip.model), tip_drop(strip, x), exact.drop};
}

Study narrow() {
  Study s = study_of("narrow_cantilever", "A narrow strip under its weight, free to curl");
  s.x = "w L^3 / E I";
  s.source =
      "shared/data/verification/e_heavy_cantilever.csv with E I = 8/9 D b, which leaves out "
      "that the clamp keeps the strip from curling near it";
  s.expects =
      "none: tends to about 1 % above that stiffness, for the width is a ninth of the "
      "length";
  for (const HeavyBeam &exact : heavy_beams()) {
    if (exact.g != 1) continue;
    for (const uint32_t cells : {2u, 4u, 8u}) {
      s.rows.push_back(
          free_strip("rows across", exact, exact.g * 8 / 9, cells, 10 * cells, 0.5e-3, 0));
    }
  }
  return s;
}

Study irregular() {
  Study s = study_of("irregular_cantilever", "A free strip on even and on irregular triangles");
  s.expects =
      "none: hinges are consistent on equilateral meshes only, and triangles that do not "
      "lie along the fold must stretch; curling near the sides is in both";
  for (const HeavyBeam &exact : heavy_beams()) {
    if (exact.g != 5) continue;
    for (const uint32_t cells : {4u, 8u, 16u}) {
      for (const double mm : {1.0, 0.2}) {
        const std::string thick = mm == 1 ? ", 1 mm thick" : ", 0.2 mm thick";
        s.rows.push_back(
            free_strip("equilateral" + thick, exact, exact.g, cells, 2 * cells, 1e-3 * mm, 0));
        s.rows.push_back(
            free_strip("irregular" + thick, exact, exact.g, cells, 2 * cells, 1e-3 * mm, 0.2));
      }
    }
  }
  return s;
}

}  // namespace

std::vector<Study> mesh_studies();  // bending_meshes.cpp

std::vector<Study> bending_studies() {
  std::vector<Study> all = {cylindrical(), narrow(), irregular()};
  for (Study &study : mesh_studies()) all.push_back(std::move(study));
  return all;
}

}  // namespace mvs::core::verification
