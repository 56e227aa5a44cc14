// Strains other than the one that a sheet of springs was fitted to.
//
// A lattice of equal springs has the two elastic constants of Cauchy's relations, whatever the
// springs: G = 3 E / 8 and E / (1 - nu) = 3 E / 2, where the incompressible tissue has E / 3 and
// 2 E. Hammer et al. (Ann. Biomed. Eng. 39, 2011) found about 80 % in shear with springs fitted to
// anisotropic leaflets; here both sheets carry the curve of the founding paper.
#include <mvs/valve.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tests/verification/balance.h"
#include "tests/verification/patch.h"
#include "tests/verification/study.h"

namespace mvs::core::verification {
namespace {

constexpr double strains[] = {0.001, 0.02, 0.05, 0.10, 0.15, 0.20, 0.24, 0.28, 0.30};

Mat2 shear(double e) {
  Mat2 f;
  f << 1, e, 0, 1;
  return f;
}

// F seen in axes turned by an angle.
Mat2 turned(const Mat2 &f, double angle) {
  const Eigen::Matrix2d q = Eigen::Rotation2Dd(angle).toRotationMatrix();
  return q.transpose() * f * q;
}

Mat2 in_balance(const Patch &patch, const Mat2 &f) {
  const Positions start = patch.mapped(f);
  const Positions none(start.size(), Vec3::Zero());
  double inner = 0;
  const Balance balance(patch.model(), patch.rim());
  return patch.stress(balance.rest(start, none, 1e-10), inner);
}

Study springs_beside_membrane() {
  Study s;
  s.name = "springs_shear";
  s.title = "Springs beside the membrane of the same curve";
  s.quantity = "nominal stress, Pa";
  s.x = "shear, or strain";
  s.source = "the bilinear law's published W, differentiated";
  s.expects = "nothing: it is the error of the spring sheet, on any mesh";
  const Published law = published("springs"), membrane = published("bilinear");
  const Patch even(law, 6, Patch::equilateral), odd(law, 6, Patch::irregular);
  for (const double e : strains) {
    const double exact = static_cast<double>(nominal_stress(membrane, shear(e).cast<Real>())(0, 1));
    const Mat2 across = turned(shear(e), test::pi / 6);
    const Mat2 back = turned(in_balance(even, across), -test::pi / 6);
    s.rows.push_back({"simple shear along springs", e, 0, in_balance(even, shear(e))(0, 1), exact});
    s.rows.push_back({"simple shear across springs", e, 0, back(0, 1), exact});
    s.rows.push_back(
        {"simple shear, irregular mesh", e, 0, in_balance(odd, shear(e))(0, 1), exact});
    const Mat2 both = (1 + e) * Mat2::Identity();
    s.rows.push_back({"equibiaxial", e, 0, in_balance(even, both)(0, 0),
                      static_cast<double>(nominal_stress(membrane, both.cast<Real>())(0, 0))});
  }
  return s;
}

Study small_strains() {
  Study s;
  s.name = "springs_moduli";
  s.title = "Elastic constants of an equilateral lattice";
  s.quantity = "modulus, Pa";
  s.source = "Cauchy's relations for a lattice of equal springs";
  s.expects = "exact but for the strain of 1e-6 at which it is measured";
  s.tolerance = 1e-5;
  const Patch even(published("springs"), 6, Patch::equilateral);
  const double e = 1e-6, young = 100e3;
  s.rows = {{"shear modulus, 3 E / 8", 0, 0, in_balance(even, shear(e))(0, 1) / e, 3 * young / 8},
            {"equibiaxial modulus, 3 E / 2", 0, 0,
             in_balance(even, (1 + e) * Mat2::Identity())(0, 0) / e, 1.5 * young}};
  return s;
}

}  // namespace

std::vector<Study> shear_studies() {
  return {springs_beside_membrane(), small_strains()};
}

}  // namespace mvs::core::verification
