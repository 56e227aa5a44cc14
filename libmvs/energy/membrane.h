// Finite-element membrane of a leaflet: energy, gradient and Hessian of constant-strain triangles,
// plane stress, incompressible, total Lagrangian, for every law of model/law.h but the spring.
//
// The energy of a triangle is t A W(a, b, c), see model/membrane.h. Its Hessian has two parts. One
// comes from the curvature of W, which is convex: positive semidefinite as it is. The other is the
// stress times the second derivative of the strain: negative under compression, where the sheet
// would buckle below the size of the triangle. Projected, the compressive part of the stress is
// left out, which makes the whole positive semidefinite without an eigenvalue problem per triangle.
//
// Compression is kept as it is, not relaxed by a tension field: the shells of FEBio and Abaqus on
// the same mesh do the same, wrinkles that the mesh can show are held by bending, and a tension
// field has no stiffness at all in slack tissue, which most of an unloaded valve is.
#pragma once

#include <vector>

#include "energy/hessian_assembler.h"
#include "energy/term.h"
#include "model/membrane.h"

namespace mvs::core {

class MembraneTerm {
 public:
  explicit MembraneTerm(const Model &model, Elements which = Elements::moving);

  bool empty() const { return triangles_.empty(); }
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
  size_t size() const { return triangles_.size(); }
  void energies(const std::vector<Vec3> &x, size_t first, size_t last, double *to) const;
  void add_pairs(std::vector<Edge> &pairs) const;

 private:
  struct Triangle {
    Tri nodes;
    uint32_t law;
    double volume;  // t A, m3
    Mat2 inverse;   // of the rest sides: row k - 1 is the weight of corner k in F
  };
  struct Tissue {
    Response (*response)(const Constants &, double i1, double i4);
    Constants constants;
  };
  struct Deformed;

  Deformed deform(const Triangle &triangle, const std::vector<Vec3> &x) const;

  std::vector<Triangle> triangles_;
  std::vector<Tissue> tissues_;  // by leaflet
};

}  // namespace mvs::core
