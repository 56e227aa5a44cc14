// A patch of tissue with a prescribed rim: the stress of the assembled triangles.
#pragma once

#include "model/membrane.h"
#include "tests/solve/bench.h"
#include "tests/verification/published.h"

namespace mvs::core::verification {

using mvs::core::test::Positions;

// A square of 20 mm of irregular triangles, whose fibre runs askew to the mesh, or a rhombus of
// equilateral ones with the fibre along springs; turned somehow in space.
class Patch {
 public:
  enum Mesh { irregular, equilateral };
  Patch(const Published &law, uint32_t cells, Mesh mesh);
  // Springs on the lattice on which they are a homogeneous sheet, everything else on any mesh.
  Patch(const Published &law, uint32_t cells);

  // Every node at its image under a homogeneous map; f in the axes of the fibre.
  Positions mapped(const Mat2 &f) const;
  // dE/dx of the leaflet at x.
  Positions forces(const Positions &x) const;

  // The nominal stress that the forces on the rim make, in the axes of the fibre; `inner` is the
  // largest force left on an inner node, relative to the largest on the rim.
  Mat2 stress(const Positions &x, double &inner) const;

  const Model &model() const { return model_; }
  const std::vector<uint32_t> &rim() const { return rim_; }
  double edge() const;  // m, mean

 private:
  Eigen::Vector2d in_fibre_axes(const Vec3 &v) const;

  Model model_;  // without prescribed nodes, so that every triangle counts
  std::vector<uint32_t> rim_;
  Vec3 fibre_, across_;
  double volume_ = 0;  // m3
};

}  // namespace mvs::core::verification
