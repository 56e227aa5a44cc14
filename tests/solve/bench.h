// Fixtures of the solver tests: small sheets, random states, derivatives by finite differences.
#pragma once

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <functional>
#include <numbers>
#include <random>
#include <string>

#include "energy/hessian_assembler.h"
#include "energy/term.h"
#include "model/model.h"
#include "solve/solver.h"
#include "tests/about.h"

namespace mvs::core::test {

inline constexpr double pi = std::numbers::pi;
using Positions = std::vector<Vec3>;

// The rows below the heading of a table of the shared data. If the table does not exist: no rows,
// and a line on stderr.
using Cells = std::vector<std::string>;
std::vector<Cells> reference_table(const std::string &file);

// The same numbers on every machine, unlike the distributions of the standard library.
class Random {
 public:
  explicit Random(uint64_t seed) : engine_(seed) {}
  double operator()(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  Vec3 vector(double size) {
    const double x = (*this)(-size, size), y = (*this)(-size, size), z = (*this)(-size, size);
    return {x, y, z};
  }
  Positions vectors(size_t count, double size);

 private:
  std::mt19937_64 engine_;
};

// A model of any sheet, which need not be a valve: a plate, a sphere, two plates. `fixed` nodes are
// prescribed. Omitted fields have their defaults.
Model model_of_sheet(Valve valve, const std::vector<uint32_t> &fixed);

// Adds a grid of nu x nv cells, each cut in two along the diagonal that makes an equilateral
// lattice of place(u, v) = (u + v / 2, sqrt(3) / 2 v). Returns its first node; node (i, j) is
// first + j * (nu + 1) + i.
uint32_t add_grid(Valve &valve, uint32_t nu, uint32_t nv,
                  const std::function<Vec3(double u, double v)> &place);
// The outline of such a grid.
std::vector<uint32_t> rim_of_grid(uint32_t first, uint32_t nu, uint32_t nv);

// A flat disc at z = 0, facing up, its rim fixed: node 0 in the middle, 6 k nodes on ring k. The
// hexagon is an equilateral lattice.
Model clamped_hexagon(uint32_t rings, double radius, const std::function<void(Valve &)> &change);
Model clamped_disc(uint32_t rings, double radius, const std::function<void(Valve &)> &change);

// Two plates of side `side` that face each other across the gap, the lower one first. Pressure
// presses them together. The upper one has one cell more a side, so that no nodes match. At most
// their rims are fixed.
struct Plates {
  Model model;
  uint32_t upper;                  // its first node
  uint32_t lower_cells;            // a side
  uint32_t upper_cells;            // a side
  Positions at(double gap) const;  // translated to this gap without bending
};
Plates two_plates(uint32_t cells, double side, double gap, bool fixed_rims,
                  const std::function<void(Valve &)> &change);

struct Motion {
  Mat3 turn;
  Vec3 shift;
  Vec3 operator()(const Vec3 &p) const { return turn * p + shift; }
  Positions operator()(const Positions &x) const;
};
Motion some_motion();

using Gradient = std::function<Positions(const Positions &)>;
// Central differences of an energy, and of a gradient (column 3 i + k: along axis k of node i).
Positions differences(const std::function<double(const Positions &)> &energy, Positions x,
                      double h);
Eigen::MatrixXd differences(const Gradient &gradient, Positions x, double h);

// A system in the order of the nodes; rows of prescribed nodes are zero.
Eigen::MatrixXd dense(const HessianAssembler &system);
Eigen::VectorXd flat(const Positions &x);
double largest(const Positions &x);
double farthest(const Positions &x, const Positions &y);

// Kinetic plus potential energy. Its differences are exact on a sheet without free edge or without
// pressure.
double total_energy(const Model &model, const State &state);

// Settles from a state and returns the final state.
struct Settled {
  State state;
  SolveStats stats;
};
Settled settle(const Model &model, const State &from, const SolveOptions &options = {});
Settled settle(const Model &model, double pressure, double fraction = 0,
               const SolveOptions &options = {});
// At rest at systole, with its boundary loaded; the test fails if it does not converge.
State closed(const Model &model);

}  // namespace mvs::core::test
