// Bending of the sheet (discrete shells): energy, gradient and Hessian of a torsion spring on every
// inner edge.
//
// E = k (theta - theta0)^2 / 2 with k = D |e|^2 / (A1 + A2), all from the rest shape, and
// D = E t^3 / (12 (1 - nu^2)), nu = 1/2, with the small-strain modulus of the leaflet. On a lattice
// of equilateral triangles this k gives the energy D kappa^2 / 2 per area of a cylinder bent along
// or across an edge direction exactly. Discrete shells: Grinspun et al., SCA 2003. The modulus is
// Young's modulus at rest or, for a law without stiffness there, the secant of its uniaxial curve
// at a strain of 0.1.
//
// Bent in both directions the same lattice is a plate with Poisson's ratio -1/3: tissue, 1/2, is
// 9/4 times as stiff in a dome and 3/8 times as stiff in a saddle. On irregular triangles a
// cylinder costs about 8 % too much at any size (tests/verification, bending_plate,
// bending_meshes). The projected Hessian is the Gauss-Newton part, k grad(theta) grad(theta)^T.
#pragma once

#include <vector>

#include "energy/hessian_assembler.h"
#include "energy/term.h"
#include "model/model.h"

namespace mvs::core {

class BendingTerm {
 public:
  explicit BendingTerm(const Model &model, Elements which = Elements::moving);

  bool empty() const { return hinges_.empty(); }
  double energy(const std::vector<Vec3> &x) const;
  double gradient(const std::vector<Vec3> &x, std::vector<Vec3> &g) const;
  // To a WholeGradient or a PartGradient.
  template <typename Gradient>
  void add_gradient(const std::vector<Vec3> &x, Gradient &to) const;
  // Adds to a HessianAssembler or a HessianPart.
  template <typename Assembler>
  void hessian(const std::vector<Vec3> &x, Curvature curvature, Assembler &assembler) const;
  // Elements, and the energies of elements first .. last.
  size_t size() const { return hinges_.size(); }
  void energies(const std::vector<Vec3> &x, size_t first, size_t last, double *to) const;
  // The sum of energies of all elements in the order of gradient(), by batches.
  double sum_by_batches(const double *energies) const;
  void add_pairs(std::vector<Edge> &pairs) const;

 private:
  struct Hinge {
    std::array<uint32_t, 4> node;  // the edge, then the corners on both sides
    double stiffness;              // N m
    double rest_angle;             // rad
  };
  static double energy_of(const Hinge &h, const std::vector<Vec3> &x);  // J
  static double energy_at(const Hinge &h, double angle);
  // Calls use() with the indices of hinges that takes() accepts, batch by batch.
  template <typename Takes, typename Use>
  void for_batches(const Takes &takes, const Use &use) const;
  template <typename Gradient>
  void add_batch(const uint32_t *hinge, size_t count, const std::vector<Vec3> &x,
                 Gradient &to) const;
  template <typename Assembler>
  void add_exact(const std::vector<Vec3> &x, Assembler &assembler) const;
  template <typename Assembler>
  void add_exact_batch(const uint32_t *hinge, size_t count, const std::vector<Vec3> &x,
                       Assembler &assembler) const;
  template <typename Assembler>
  void add_projected(const std::vector<Vec3> &x, Assembler &assembler) const;

  std::vector<Hinge> hinges_;
};

// The angle between the two triangles of a hinge, 0 when flat, in (-pi, pi].
double hinge_angle(const Vec3 &x0, const Vec3 &x1, const Vec3 &x2, const Vec3 &x3);

}  // namespace mvs::core
