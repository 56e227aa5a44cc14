// Follower pressure: the ventricular pressure on the sheet, along the deformed normal. Returns
// exact forces and the symmetric part of their derivative.
//
// Each triangle pushes p A n / 3 on its corners. Away from the free edge that is the gradient of
// -p V, V the volume swept by the sheet, for any prescribed boundary. At a free edge the follower
// force has no potential: the difference, (p / 6) a x b on both ends of each free edge (a, b), is
// kept as a constant force in the energy between calls of freeze(). Forces are exact; differences
// of the energy are exact to first order around the frozen shape.
#pragma once

#include <vector>

#include "energy/hessian_assembler.h"
#include "energy/term.h"
#include "model/model.h"

namespace mvs::core {

class FollowerPressureTerm {
 public:
  explicit FollowerPressureTerm(const Model &model);

  void set_pressure(double pressure) { pressure_ = pressure; }
  // Without pressure all functions but freeze() return at once.
  bool empty() const { return pressure_ == 0; }
  // Sets the shape around which the energy of the free edge is exact. Call it before each line
  // search.
  void freeze(const std::vector<Vec3> &x);

  double energy(const std::vector<Vec3> &x) const;
  // Adds minus the follower force; returns energy(x).
  double gradient(const std::vector<Vec3> &x, std::vector<Vec3> &g) const;
  // To a WholeGradient or a PartGradient.
  template <typename Gradient>
  void add_gradient(const std::vector<Vec3> &x, Gradient &to) const;
  // Adds the symmetric part of the derivative. It is indefinite and has no projected form.
  template <typename Assembler>
  void hessian(const std::vector<Vec3> &x, Assembler &assembler) const;
  // Triangles, the volumes that triangles first .. last enclose with the origin, and the energy
  // from the volumes of all.
  size_t size() const { return triangles_.size(); }
  void volumes(const std::vector<Vec3> &x, size_t first, size_t last, double *to) const;
  double energy_of(const std::vector<Vec3> &x, const double *volumes) const;
  // Adds to y the skew part of the derivative, which the free edge has, times v.
  void add_skew(const std::vector<Vec3> &x, const std::vector<Vec3> &v, std::vector<Vec3> &y) const;
  void add_pairs(std::vector<Edge> &pairs) const;

 private:
  struct FreeEdge {
    uint32_t a, b;  // in the order of its triangle
  };
  struct Slope {
    uint32_t i, j, left, right;  // d2E/dx_i dx_j from the corners opposite edge (i, j)
  };
  double volume_of(const Tri &t, const std::vector<Vec3> &x) const;
  double with_edges(double volume, const std::vector<Vec3> &x) const;

  std::vector<Tri> triangles_;
  std::vector<FreeEdge> free_edges_;
  std::vector<Slope> slopes_;
  std::vector<Vec3> frozen_;  // per free edge: the constant force over p
  Vec3 origin_;
  double pressure_ = 0;
};

}  // namespace mvs::core
