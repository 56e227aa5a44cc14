// Certificate by a factorisation, then the two extreme eigenvalues with that factor.
#include "solve/stability.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "linalg/cholesky.h"
#include "linalg/spmv.h"
#include "solve/settings.h"
#include "solve/tools/tool_points.h"

namespace mvs::core {
namespace {

namespace set = settings::stability;

// N s/m per row: the damping of overdamped motion.
std::vector<double> damping_of(const Model &model, const HessianAssembler &system) {
  std::vector<double> damping;
  for (const uint32_t i : system.node_of) damping.push_back(set::damping * model.node_mass[i]);
  return damping;
}

// Whether all eigenvalues of a symmetric block are above a bound (Sylvester's criterion).
bool is_above(Mat3 block, double bound) {
  block.diagonal().array() -= bound;
  const double minor = block(0, 0) * block(1, 1) - block(1, 0) * block(1, 0);
  return block(0, 0) > 0 && minor > 0 && block.determinant() > 0;
}

// Rows of branch points whose chordae are slack, or nearly so. They have no place to return to, and
// say nothing about the others.
std::vector<uint8_t> loose_rows(const Model &model, const HessianAssembler &system) {
  const BlockMatrix &matrix = system.matrix;
  std::vector<uint8_t> is_loose(matrix.size(), 0);
  for (uint32_t r = 0; r < matrix.size(); ++r) {
    const bool is_branch_point = model.vertex_area[system.node_of[r]] == 0;
    is_loose[r] = is_branch_point && !is_above(matrix.value[matrix.start[r]], set::loose_stiffness);
  }
  return is_loose;
}

// The elimination of a loose row with this block takes this from the block of a row that is coupled
// to it: all that its chord adds there, where no other chord of the loose row is tight.
Mat3 taken(const Mat3 &coupling, Mat3 block) {
  block.diagonal().array() += set::loose_stiffness;
  if (!is_above(block, 0)) return Mat3::Zero();  // the point of a tool that slides
  return coupling * block.inverse() * coupling.transpose();
}

// Fixes loose rows where they are, without the stiffness that their chordae would get from that: a
// chord to a point that nothing else holds has none. The rows are eliminated, but for the coupling
// of other rows by them; chordae between two of them are cut.
void fix_loose_rows(const std::vector<uint8_t> &is_loose, BlockMatrix &matrix) {
  std::vector<Mat3> own(matrix.size());
  for (uint32_t c = 0; c < matrix.size(); ++c) own[c] = matrix.value[matrix.start[c]];
  const auto for_couplings = [&](auto use) {
    for (uint32_t c = 0; c < matrix.size(); ++c) {
      for (uint32_t k = matrix.start[c] + 1; k < matrix.start[c + 1]; ++k) {
        const uint32_t r = matrix.row[k];
        if (is_loose[c] || is_loose[r]) use(r, c, matrix.value[k]);
      }
    }
  };
  for_couplings([&](uint32_t r, uint32_t c, const Mat3 &block) {
    if (!is_loose[r] || !is_loose[c]) return;
    own[r] += block;  // of a chord: minus its stiffness
    own[c] += block.transpose();
  });
  for_couplings([&](uint32_t r, uint32_t c, Mat3 &block) {
    if (!is_loose[c]) matrix.value[matrix.start[c]] -= taken(block.transpose(), own[r]);
    if (!is_loose[r]) matrix.value[matrix.start[r]] -= taken(block, own[c]);
    block.setZero();
  });
  for (uint32_t c = 0; c < matrix.size(); ++c) {
    if (is_loose[c]) matrix.value[matrix.start[c]] = Mat3::Identity();
  }
}

// The same vector on every machine, with a share of every mode: numbers of a linear congruential
// generator (Knuth, MMIX).
BlockVector start_vector(const std::vector<uint8_t> &is_loose) {
  BlockVector start(is_loose.size(), Vec3::Zero());
  uint64_t seed = 1;
  for (size_t r = 0; r < start.size(); ++r) {
    for (int k = 0; k < 3; ++k) {
      seed = 6364136223846793005u * seed + 1442695040888963407u;
      if (!is_loose[r]) start[r][k] = static_cast<double>(seed >> 11) * 0x1p-53 - 0.5;
    }
  }
  return start;
}

// By node, with a longest displacement of length 1.
std::vector<Vec3> mode_of(const BlockVector &rows, const HessianAssembler &system, size_t nodes) {
  double longest = 0;
  for (const Vec3 &v : rows) longest = std::max(longest, v.squaredNorm());
  std::vector<Vec3> mode(nodes, Vec3::Zero());
  if (longest == 0) return mode;
  for (size_t r = 0; r < rows.size(); ++r) mode[system.node_of[r]] = rows[r] / std::sqrt(longest);
  return mode;
}

}  // namespace

StabilityCheck::StabilityCheck() : factor_(make_block_factor()) {}

// Factorises a matrix plus a diagonal; false if that is not positive definite.
bool StabilityCheck::factorise(const BlockMatrix &matrix, const std::vector<double> &added,
                               SolveStats &stats) {
  const PhaseTimer timer(stats.work, MVS_PHASE_FACTOR);
  const bool same_pattern =
      is_analysed_ && matrix_.start == matrix.start && matrix_.row == matrix.row;
  matrix_ = matrix;
  for (uint32_t r = 0; r < matrix_.size(); ++r) {
    matrix_.value[matrix_.start[r]].diagonal().array() += added[r];
  }
  poll_();
  if (!same_pattern) factor_->analyse(matrix_);
  is_analysed_ = true;
  ++stats.factorisations;
  return factor_->factorise(matrix_);
}

Stability StabilityCheck::check(const Model &model, const TotalEnergy &total_energy,
                                const std::vector<Vec3> &x, const HessianAssembler &system,
                                bool margins, SolveStats &stats) {
  Stability found;
  const std::vector<double> damping = damping_of(model, system);
  std::vector<double> added = damping;
  for (double &number : added) number *= set::max_rate;
  const std::vector<uint8_t> is_loose = loose_rows(model, system);
  BlockMatrix stiffness = system.matrix;
  fix_loose_rows(is_loose, stiffness);
  const bool is_definite = factorise(stiffness, added, stats);
  if (is_definite && !margins) {
    last_shift_ = 0;
    return found;
  }
  double shift = is_definite ? 0 : last_shift_ / (set::shift_growth * set::shift_growth);
  while (!is_definite) {
    shift = std::max(set::shift_growth * shift, set::min_shift);
    MVS_MUST(shift < set::max_shift, MVS_E_DIVERGED, "settle",
             "the stiffness matrix is not finite; check the materials");
    const std::vector<double> everywhere(added.size(), shift);
    if (factorise(stiffness, everywhere, stats)) break;
  }
  last_shift_ = shift;
  const PhaseTimer timer(stats.work, MVS_PHASE_SOLVE);
  BlockSpmv product;
  const LinearMap solve = [&](const BlockVector &v, BlockVector &y) {
    poll_();
    y = v;
    factor_->solve(y);
  };
  std::vector<Vec3> by_node(x.size(), Vec3::Zero()), skew(x.size(), Vec3::Zero());
  const LinearMap multiply = [&](const BlockVector &v, BlockVector &y) {
    product.multiply(stiffness, v, y);
    for (size_t r = 0; r < v.size(); ++r) by_node[system.node_of[r]] = v[r];
    std::fill(skew.begin(), skew.end(), Vec3::Zero());
    total_energy.add_skew(x, by_node, skew);
    for (size_t r = 0; r < v.size(); ++r) {
      if (is_loose[r]) {
        y[r].setZero();
      } else {
        y[r] += skew[system.node_of[r]];
      }
    }
  };
  std::vector<BlockVector> basis;
  const BlockVector start = start_vector(is_loose);
  const Eigenpair symmetric =
      smallest_eigenvalue(solve, start, {set::error, set::most_iterations}, basis);
  found.stiffness = symmetric.real - shift;
  const Eigenpair leaving = leftmost_eigenvalue(
      multiply, solve, damping, std::move(basis),
      {is_definite ? set::rate_error : set::error, set::most_iterations, set::max_rate});
  stats.work.linear_iterations += symmetric.iterations + leaving.iterations;
  found.rate = is_definite ? std::min(-leaving.real, 0.0) : -leaving.real;
  found.is_stable = is_definite || found.rate <= set::max_rate;
  found.mode = mode_of(leaving.vector, system, x.size());
  return found;
}

Stability check_stability(const Model &model, State &state, ContactLaw law, bool leaves,
                          bool margins) {
  const std::vector<Vec3> &x = state.x;
  TotalEnergy total_energy(model, law);
  SolveStats unseen;
  std::vector<Vec3> gradient;
  total_energy.use_verlet_list(false);
  total_energy.set_pressure(state.load.pressure);
  total_energy.set_tools(state.tools);
  total_energy.prepare(x, x, 0, unseen.work);
  total_energy.gradient(x, gradient, unseen.work);
  HessianAssembler system;
  system.place = &x;
  total_energy.hessian(x, Curvature::exact, system, unseen.work);
  Stability found = StabilityCheck().check(model, total_energy, x, system, margins, unseen);
  if (!found.is_stable && leaves) {
    std::vector<Vec3> step = found.mode;
    for (Vec3 &d : step) d *= set::leave_by;
    total_energy.limit_step(x, 0, step, unseen.work);
    std::vector<Vec3> &moved = state.x.edit();
    for (size_t i = 0; i < moved.size(); ++i) moved[i] += step[i];
  }
  return found;
}

Stability check_stability(const Model &valve, const State &valve_state) {
  ToolPoints points;
  const Model &model = points.extend(valve, tool_points(valve_state.tools));
  State state = ToolPoints::extended(valve_state);
  Stability found = check_stability(model, state, ContactLaw::barrier, false, true);
  found.mode.resize(valve_state.x.size());
  return found;
}

}  // namespace mvs::core
