// The laws as their papers print them.
#include "tests/verification/published.h"

#include <cmath>
#include <stdexcept>

namespace mvs::core::verification {
namespace {

// I1 and I4 of an incompressible sheet.
struct Invariants {
  Real i1, i4;
};
Invariants invariants(const Map2 &f) {
  const Map2 c = f.transpose() * f;
  return {c.trace() + 1 / c.determinant(), c(0, 0)};
}

using Law = std::function<Real(Real i1, Real i4)>;

std::function<Real(const Map2 &)> of_invariants(const Law &w) {
  return [w](const Map2 &f) {
    const auto [i1, i4] = invariants(f);
    return w(i1, i4);
  };
}

// Tenenholtz et al. 2011: 100 kPa up to a strain of 0.25, 6 MPa beyond.
Real spring(Real e) {
  const Real low = 100e3L, high = 6e6L, kink = 0.25L;
  if (e <= kink) return low * e * e / 2;
  return low * kink * kink / 2 + (e - kink) * (low * kink + high * (e - kink) / 2);
}

// Springs along the three directions of an equilateral lattice fill the sheet: each has twice a
// triangle of tissue, and there is one of each direction a pair of triangles.
Real lattice(const Map2 &f) {
  Real sum = 0;
  for (int k = 0; k < 3; ++k) {
    const Real angle = k * std::acos(Real(-1)) / 3;
    const Eigen::Matrix<Real, 2, 1> along(std::cos(angle), std::sin(angle));
    sum += spring((f * along).norm() - 1);
  }
  return sum;
}

// shared/model.md, section 2: a smooth isotropic fit, dW/dI1 = c + a (x + sqrt(x^2 + s^2)) / 2,
// x = I1 - Ic; the integral through asinh.
Real bilinear(Real i1, Real) {
  const Real c = 18.49e3L, a = 3146e3L, ic = 3.1611L, s = 0.006L;
  const auto integral = [&](Real x) {
    return x * x / 4 + x * std::sqrt(x * x + s * s) / 4 + s * s * std::asinh(x / s) / 4;
  };
  return c * (i1 - 3) + a * (integral(i1 - ic) - integral(3 - ic));
}

// Mathur et al. 2022, constants of the anterior leaflet of the Texas TriValve 1.1.
Real fung(Real i1, Real) {
  return 1e3L / 2 * (i1 - 3) + 124.0L / 2 * std::expm1(4.568202L * (i1 - 3) * (i1 - 3));
}

Law may_newman_yin(Real c0, Real c1, Real c2) {
  return [=](Real i1, Real i4) {
    return c0 * std::expm1(c1 * std::pow(i1 - 3, 2) + c2 * std::pow(std::sqrt(i4) - 1, 4));
  };
}

Law prot(Real c0, Real c1, Real c2) {
  return [=](Real i1, Real i4) {
    return c0 * std::expm1(c1 * std::pow(i1 - 3, 2) + c2 * std::pow(i4 - 1, 2));
  };
}

Real neo_hookean(Real i1, Real) {
  return 1e5L / 3 / 2 * (i1 - 3);
}

}  // namespace

std::vector<Published> published_laws() {
  return {{"springs", LeafletLawId::spring, {100e3, 6e6, 0.25}, lattice},
          {"bilinear",
           LeafletLawId::bilinear,
           {18.49e3, 3146e3, 3.1611, 0.006},
           of_invariants(bilinear)},
          {"Fung, Texas anterior", LeafletLawId::fung, {1e3, 124, 4.568202}, of_invariants(fung)},
          {"May-Newman and Yin, anterior",
           LeafletLawId::may_newman_yin,
           {399, 4.325, 1446.5},
           of_invariants(may_newman_yin(399, 4.325L, 1446.5L))},
          {"May-Newman and Yin, posterior",
           LeafletLawId::may_newman_yin,
           {414, 4.848, 305.4},
           of_invariants(may_newman_yin(414, 4.848L, 305.4L))},
          {"Prot, anterior",
           LeafletLawId::prot,
           {52, 4.63, 22.6},
           of_invariants(prot(52, 4.63L, 22.6L))},
          {"Prot, posterior",
           LeafletLawId::prot,
           {171, 5.28, 6.46},
           of_invariants(prot(171, 5.28L, 6.46L))},
          {"neo-Hookean", LeafletLawId::neo_hookean, {1e5 / 3}, of_invariants(neo_hookean)}};
}

Published published(const std::string &name) {
  for (const Published &law : published_laws()) {
    if (law.name == name) return law;
  }
  throw std::invalid_argument("no law is called " + name);
}

Map2 nominal_stress(const Published &law, const Map2 &f) {
  // small beside 0.006, within which the bilinear fit turns
  const Real h = 2e-5L;
  constexpr Real weight[] = {4.0L / 5, -1.0L / 5, 4.0L / 105, -1.0L / 280};
  Map2 p;
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      Real slope = 0;
      for (int k = 1; k <= 4; ++k) {
        Map2 up = f, down = f;
        up(i, j) += k * h;
        down(i, j) -= k * h;
        slope += weight[k - 1] * (law.energy(up) - law.energy(down));
      }
      p(i, j) = slope / h;
    }
  }
  return p;
}

Map2 cauchy_stress(const Map2 &nominal, const Map2 &f) {
  return nominal * f.transpose();
}

Real free_stretch(const Published &law, int axis, Real stretch) {
  const int across = 1 - axis;
  Real low = 0.3L, high = 1.5L;
  for (int k = 0; k < 60; ++k) {
    Map2 f = Map2::Zero();
    f(axis, axis) = stretch;
    f(across, across) = (low + high) / 2;
    (nominal_stress(law, f)(across, across) > 0 ? high : low) = f(across, across);
  }
  return (low + high) / 2;
}

}  // namespace mvs::core::verification
