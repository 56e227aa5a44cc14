// The laws of leaflets as their papers print them, in principal terms and independent of libmvs:
// libmvs/model/law.cpp is written in derivatives by I1 and I4. Stress follows from them by
// differences, in extended precision.
#pragma once

#include <Eigen/LU>
#include <functional>
#include <string>
#include <vector>

#include "model/law.h"

namespace mvs::core::verification {

using Real = long double;
using Map2 = Eigen::Matrix<Real, 2, 2>;  // F in the plane, the first axis along the fibre

struct Published {
  std::string name;
  LeafletLawId law;
  Constants constants;                       // for libmvs
  std::function<Real(const Map2 &)> energy;  // J/m3
};

// Every law, both leaflets where a paper has two.
std::vector<Published> published_laws();
Published published(const std::string &name);

// The nominal stress dW/dF by differences of eighth order, and the Cauchy stress P F^T (det F = 1
// in space, for the thickness takes what the plane leaves).
Map2 nominal_stress(const Published &law, const Map2 &f);
Map2 cauchy_stress(const Map2 &nominal, const Map2 &f);

// The stretch across that leaves no stress across, for a stretch along `axis`.
Real free_stretch(const Published &law, int axis, Real stretch);

}  // namespace mvs::core::verification
