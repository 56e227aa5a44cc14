// Mass-spring sheet: energy, gradient and Hessian of the bilinear law with Van Gelder stiffness on
// every edge of a leaflet.
//
// An edge of rest length L0 between triangles of area A and thickness t carries the force
// sigma(e) t A / L0 at strain e = L / L0 - 1, summed over its triangles: the spring constant
// k = E t sum(A) / L0^2 of Van Gelder (J. Graphics Tools 3(2), 1998) with the law of Tenenholtz et
// al. (IROS 2011), 100 kPa up to a strain of 0.25 and 6 MPa beyond. On an equilateral lattice that
// is a membrane with Poisson's ratio 1/3. The projected Hessian of a compressed spring keeps the
// stiffness along its axis and leaves out the negative one across.
#pragma once

#include <vector>

#include "energy/hessian_assembler.h"
#include "energy/term.h"
#include "model/model.h"

namespace mvs::core {

class SpringTerm {
 public:
  explicit SpringTerm(const Model &model, Elements which = Elements::moving);

  bool empty() const { return springs_.empty(); }
  double energy(const std::vector<Vec3> &x) const;
  // Adds dE/dx and returns E.
  double gradient(const std::vector<Vec3> &x, std::vector<Vec3> &g) const;
  // To a WholeGradient or a PartGradient.
  template <typename Gradient>
  void add_gradient(const std::vector<Vec3> &x, Gradient &to) const;
  // Adds to a HessianAssembler or a HessianPart.
  template <typename Assembler>
  void hessian(const std::vector<Vec3> &x, Curvature curvature, Assembler &assembler) const;
  // Elements, and the energies of elements first .. last.
  size_t size() const { return springs_.size(); }
  void energies(const std::vector<Vec3> &x, size_t first, size_t last, double *to) const;
  void add_pairs(std::vector<Edge> &pairs) const;

  // Springs whose lengths are within `slack`, m, of the kink of their law.
  struct Kink {
    Edge nodes;
    uint32_t leaflet;
    double rest_length;
    double over;  // m, beyond the kink
    double jump;  // N/m, of the stiffness
  };
  std::vector<Kink> find_kinks(const std::vector<Vec3> &x, double slack) const;

 private:
  // One law on one edge: an edge between two leaflets has two.
  struct Spring {
    uint32_t i, j, law;
    double length;                       // L0, m
    double volume;                       // t A, m3
    double per_length = 0, section = 0;  // 1 / L0, t A / L0
  };
  double energy_of(const Spring &s, const std::vector<Vec3> &x) const;  // J
  std::vector<Spring> springs_;
  std::vector<Bilinear> laws_;
};

}  // namespace mvs::core
