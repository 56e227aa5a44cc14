// Damped Newton: the exact Hessian plus a shift that grows until the step lowers the energy.
#include "tests/verification/balance.h"

#include <cmath>
#include <stdexcept>

#include "linalg/direct_solver.h"
#include "solve/nodes.h"

namespace mvs::core::verification {

struct Balance::Newton {
  const Balance &of;
  const Positions &load;
  std::unique_ptr<DirectSolver> factor = make_direct_solver(Backend::block);
  HessianAssembler system = {};
  Positions x = {}, g = {};
  double energy = 0, residual = 0, shift = 0;

  void evaluate() {
    g.assign(x.size(), Vec3::Zero());
    energy = of.gradient(x, g);
    for (size_t i = 0; i < x.size(); ++i) {
      energy -= load[i].dot(x[i]);
      g[i] -= load[i];
    }
    residual = largest_free(of.held_, g);
  }

  void begin(Positions start) {
    x = std::move(start);
    std::vector<Edge> pairs;
    of.spring_.add_pairs(pairs);
    of.membrane_.add_pairs(pairs);
    of.bending_.add_pairs(pairs);
    of.chord_.add_pairs(pairs);
    system.set_pattern(of.held_, pairs);
    factor->analyse(system.matrix);
    evaluate();
  }

  double assemble() {
    system.clear();
    of.spring_.hessian(x, Curvature::exact, system);
    of.membrane_.hessian(x, Curvature::exact, system);
    of.bending_.hessian(x, Curvature::exact, system);
    of.chord_.hessian(x, Curvature::exact, system);
    double trace = 0;
    for (uint32_t r = 0; r < system.matrix.size(); ++r) {
      trace += system.matrix.value[system.matrix.start[r]].trace();
    }
    return trace / (3 * system.matrix.size());
  }

  void add_shift(double amount) {
    for (uint32_t r = 0; r < system.matrix.size(); ++r) {
      system.matrix.value[system.matrix.start[r]].diagonal().array() += amount;
    }
  }

  // The unshifted step, if it lowers the energy or, near rest, halves the force.
  bool try_step() {
    if (!factor->factorise(system.matrix)) return false;
    Positions rows;
    for (const uint32_t node : system.node_of) rows.push_back(-g[node]);
    factor->solve(rows);
    const Positions before_x = x, before_g = g;
    const double before = energy, force = residual;
    for (size_t r = 0; r < rows.size(); ++r) x[system.node_of[r]] += rows[r];
    evaluate();
    if (std::isfinite(residual) && (energy < before || residual < 0.5 * force)) return true;
    x = before_x;
    g = before_g;
    energy = before;
    residual = force;
    return false;
  }

  void step() {
    const double size = assemble();
    double added = shift > 0 ? shift * size : 0;
    add_shift(added);
    while (!try_step()) {
      const double more = std::max(3 * added, 1e-9 * size);
      add_shift(more);
      added += more;
      if (!(added < 1e9 * size)) throw std::runtime_error("no step lowers the energy");
    }
    shift = added < 2e-9 * size ? 0 : 0.1 * added / size;
  }
};

namespace {

Model with_held(Model model, const std::vector<uint32_t> &held) {
  model.topology.fixed.assign(model.node_count(), 0);
  for (const uint32_t node : held) model.topology.fixed[node] = 1;
  return model;
}

}  // namespace

Balance::Balance(const Model &model, const std::vector<uint32_t> &held)
    : held_(with_held(model, held)),
      spring_(model),
      membrane_(model),
      bending_(model),
      chord_(held_) {}

double Balance::gradient(const Positions &x, Positions &g) const {
  double sum = spring_.gradient(x, g);
  sum += membrane_.gradient(x, g);
  sum += bending_.gradient(x, g);
  return sum + chord_.gradient(x, g);
}

Positions Balance::rest(Positions start, const Positions &load, double tolerance) const {
  Newton newton{*this, load};
  newton.begin(std::move(start));
  for (int k = 0; newton.residual > tolerance; ++k) {
    if (k == 2000) throw std::runtime_error("no rest under the dead load");
    newton.step();
  }
  return newton.x;
}

}  // namespace mvs::core::verification
