// Checks of an energy term: gradient and Hessian against differences, invariance under rigid
// motion.
#pragma once

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <functional>

#include "energy/hessian_assembler.h"
#include "tests/dense.h"
#include "tests/model/small_valve.h"
#include "tests/solve/bench.h"

namespace mvs::core::test {

// A term as functions of the positions alone.
struct Probe {
  std::function<double(const Positions &)> energy;
  Gradient gradient;
  std::function<Eigen::MatrixXd(const Positions &, Curvature)> hessian;
};

template <typename Term>
Probe probe_of(const Model &model, const Term &term) {
  Probe probe;
  probe.energy = [&term](const Positions &x) { return term.energy(x); };
  probe.gradient = [&term](const Positions &x) {
    Positions g(x.size(), Vec3::Zero());
    const double found = term.gradient(x, g);
    // the sums run in the same order, or at least over the same numbers
    CHECK(found == about(term.energy(x), 1e-14));
    return g;
  };
  probe.hessian = [&model, &term](const Positions &x, Curvature curvature) {
    HessianAssembler system;
    std::vector<Edge> pairs;
    term.add_pairs(pairs);
    system.set_pattern(model, pairs);
    system.clear();
    term.hessian(x, curvature, system);
    return dense(system);
  };
  return probe;
}

// The small valve without prescribed nodes, so that every block is compared.
inline Model free_valve() {
  return model_of_sheet(small_valve(), {});
}

// The same valve with leaflets of one membrane law.
inline Model free_membrane(const LeafletLaw &law) {
  Valve valve = small_valve();
  for (size_t l = 0; l < valve.leaflets.size(); ++l) {
    valve.leaflets[l].law = law.id;
    valve.leaflets[l].constants = default_constants(law.constants);
  }
  return model_of_sheet(valve, {});
}

// Strains up to about +-0.3: both branches of the bilinear law, slack and taut chordae, folds.
inline Positions crumpled(const Model &model, uint64_t seed, double size = 0.8e-3) {
  Random random(seed);
  Positions x = model.valve.rest;
  for (Vec3 &p : x) p += random.vector(size);
  return x;
}

inline void check_gradient(const Probe &probe, const Positions &x) {
  const Positions g = probe.gradient(x);
  REQUIRE(largest(g) > 0);
  // (h / length)^2 of a central difference at 2e-8 of 5e-3 m, a hundred times that where the
  // bilinear membrane turns within a strain of 0.006, and 1e-16 / 4e-6 of rounding
  CHECK(farthest(g, differences(probe.energy, x, 2e-8)) < 1e-6 * largest(g));
}

inline void check_hessian(const Probe &probe, const Positions &x) {
  const Eigen::MatrixXd h = probe.hessian(x, Curvature::exact);
  const double size = h.cwiseAbs().maxCoeff();
  REQUIRE(size > 0);
  // as above
  CHECK((h - differences(probe.gradient, x, 2e-8)).cwiseAbs().maxCoeff() < 1e-6 * size);
}

inline void check_projected(const Probe &probe, const Positions &x) {
  const Eigen::MatrixXd h = probe.hessian(x, Curvature::projected);
  const Eigen::VectorXd values = symmetric_eigenvalues(h);
  // rounding of the eigenvalues themselves
  CHECK(values.minCoeff() > -1e-12 * values.maxCoeff());
  CHECK(values.maxCoeff() > 0);
}

// A term of the sheet's own shape is invariant under rotation and translation.
inline void check_invariance(const Probe &probe, const Positions &x) {
  const Motion motion = some_motion();
  const Positions moved = motion(x);
  // 1e-16 of 0.3 m over edges of 5e-3 m, then strain over its own size
  CHECK(probe.energy(moved) == about(probe.energy(x), 1e-11));
  Positions turned = probe.gradient(x);
  for (Vec3 &f : turned) f = motion.turn * f;
  CHECK(farthest(turned, probe.gradient(moved)) < 1e-11 * largest(turned));
}

template <typename Term>
void check_term(const Model &model, const Term &term, double size = 0.8e-3) {
  const Probe probe = probe_of(model, term);
  for (const uint64_t seed : {1u, 2u, 3u}) {
    const Positions x = crumpled(model, seed, size);
    check_gradient(probe, x);
    check_hessian(probe, x);
    check_projected(probe, x);
    check_invariance(probe, x);
  }
}

inline Vec3 sum_of(const Positions &g) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3 &f : g) sum += f;
  return sum;
}

inline Vec3 moment_of(const Positions &x, const Positions &g) {
  Vec3 sum = Vec3::Zero();
  for (size_t i = 0; i < x.size(); ++i) sum += x[i].cross(g[i]);
  return sum;
}

}  // namespace mvs::core::test
