// The patch test: an element represents a homogeneous strain exactly on any mesh, and has zero
// force under a rigid motion.
#include <cmath>

#include "tests/verification/balance.h"
#include "tests/verification/patch.h"
#include "tests/verification/study.h"

namespace mvs::core::verification {
namespace {

Mat2 some_strain() {
  Mat2 f;
  f << 1.10, 0.05, 0.02, 1.06;
  return f;
}

// Inner nodes displaced by up to a fifth of an edge, the rim at its image under the map.
double lost_after_patch_test(const Published &law, uint32_t cells, Patch::Mesh mesh) {
  const Patch patch(law, cells, mesh);
  const Positions exact = patch.mapped(some_strain()), none(exact.size(), Vec3::Zero());
  std::vector<char> rim(exact.size(), 0);
  for (const uint32_t node : patch.rim()) rim[node] = 1;
  test::Random random(5);
  Positions start = exact;
  for (size_t i = 0; i < start.size(); ++i) {
    const Vec3 away = random.vector(0.1 * patch.edge());
    if (!rim[i]) start[i] += away;
  }
  const Balance balance(patch.model(), patch.rim());
  double inner = 0;
  const double size = test::largest(patch.forces(exact));
  patch.stress(exact, inner);
  return test::farthest(balance.rest(start, none, 1e-10 * size), exact);
}

Study patch_test() {
  Study s;
  s.name = "patch_test";
  s.title = "Patch test: a homogeneous strain from disturbed starts";
  s.quantity = "largest distance of a node from the homogeneous map, m";
  s.level = "edge, m";
  s.source = "the map itself";
  s.expects = "rounding: forces of 1e-10 over the stiffness";
  s.tolerance = 1e-9;
  for (const Published &law : published_laws()) {
    if (law.law == LeafletLawId::spring) continue;
    for (const uint32_t cells : {4u, 8u}) {
      s.rows.push_back({law.name, 0, 20e-3 / cells,
                        lost_after_patch_test(law, cells, Patch::irregular), 0, 20e-3});
    }
  }
  return s;
}

Study patch_of_springs() {
  Study s = patch_test();
  s.rows.clear();
  s.name = "patch_test_springs";
  s.title = "Patch test of springs on the irregular mesh";
  s.expects = "no pass: springs know no homogeneous strain except on a lattice";
  s.tolerance = 0;
  for (const uint32_t cells : {4u, 8u}) {
    s.rows.push_back({"springs", 0, 20e-3 / cells,
                      lost_after_patch_test(published("springs"), cells, Patch::irregular), 0,
                      20e-3});
  }
  return s;
}

Study rigid_motion() {
  Study s;
  s.name = "rigid_motion";
  s.title = "A strained patch turned and moved";
  s.quantity = "largest change of a force, turned back, N";
  s.source = "frame indifference";
  s.expects = "rounding";
  s.tolerance = 1e-10;
  const test::Motion motion = test::some_motion();
  for (const Published &law : published_laws()) {
    const Patch patch(law, 6);
    const Positions x = patch.mapped(some_strain());
    Positions here = patch.forces(x);
    const double size = test::largest(here);
    for (Vec3 &force : here) force = motion.turn * force;
    s.rows.push_back({law.name, 0, 0, test::farthest(here, patch.forces(motion(x))), 0, size});
  }
  return s;
}

}  // namespace

std::vector<Study> patch_studies() {
  return {patch_test(), patch_of_springs(), rigid_motion()};
}

}  // namespace mvs::core::verification
