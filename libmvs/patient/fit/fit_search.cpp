// Normal equations with a prior and bounds, halved steps, probes of slack groups.
#include "patient/fit/fit_search.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"

namespace mvs::core {
namespace {

// m2: errors of a segmented surface are alike within about 5 mm, so that a patch counts once.
constexpr double patch = 25e-6;
// m: matches count less beyond this distance (Cauchy's weight), as the given surface may lack parts
// of the leaflets.
constexpr double robust_distance = 3e-3;
// The search ends where no factor changes by more than this, or the misfit falls by less than a
// share.
constexpr double least_step = 1e-3, least_gain = 0.01;
constexpr int most_halvings = 3;
// By how much a group without influence is shortened at a time.
constexpr double slack_probe = 0.05;
// Groups are probed if there are at most so many: each probe is a closure.
constexpr size_t most_probed = 20;

// 1 over the variance, times the number of patches.
double match_weight(const SurfaceMatch &m, const FitSettings &s) {
  const double far = m.distance / robust_distance;
  // both ways count half
  return 0.5 * m.area / patch / (s.noise * s.noise * (1 + far * far));
}

// Minus twice the logarithm of the posterior, whose gradient has the weights above.
double log_misfit_of(const FitParameters &p, const std::vector<SurfaceMatch> &matches,
                     const std::vector<double> &factor, const FitSettings &s) {
  double sum = 0;
  for (const SurfaceMatch &m : matches) {
    const double far = m.distance / robust_distance, scale = robust_distance / s.noise;
    sum += 0.5 * m.area / patch * scale * scale * math::log(1 + far * far);
  }
  for (size_t k = 0; k < factor.size(); ++k) {
    const double off = (factor[k] - p.mean[k]) / p.deviation;
    sum += off * off;
  }
  return sum;
}

struct Normal {
  DenseMatrix h;
  std::vector<double> right;
};
Normal normal_equations(const FitParameters &p, const FitTrial &now,
                        const std::vector<std::vector<double>> &jacobian, const FitSettings &s) {
  const size_t n = now.factor.size();
  Normal normal{DenseMatrix(n), std::vector<double>(n, 0)};
  std::vector<double> row(n);
  for (size_t m = 0; m < now.matches.size(); ++m) {
    const double w = match_weight(now.matches[m], s);
    const double r = now.matches[m].residual(now.closed.state.x);
    for (size_t i = 0; i < n; ++i) row[i] = jacobian[i][m];
    for (size_t i = 0; i < n; ++i) {
      normal.right[i] -= w * row[i] * r;
      for (size_t j = 0; j <= i; ++j) normal.h.at(i, j) += w * row[i] * row[j];
    }
  }
  for (size_t i = 0; i < n; ++i) {
    for (size_t j = 0; j < i; ++j) normal.h.at(j, i) = normal.h.at(i, j);
    normal.h.at(i, i) += 1 / (p.deviation * p.deviation);
    normal.right[i] -= (now.factor[i] - p.mean[i]) / (p.deviation * p.deviation);
  }
  return normal;
}

std::vector<double> bounded_step(const Normal &normal, const std::vector<double> &factor,
                                 const FitSettings &s) {
  std::vector<double> low, high;
  for (const double f : factor) {
    low.push_back(s.least - f);
    high.push_back(s.most - f);
  }
  return solve_bounded(normal.h, normal.right, low, high);
}

}  // namespace

Valve FitSearch::scaled(const FitParameters &p, const std::vector<double> &factor) const {
  Valve changed = valve_;
  scale_groups(changed, p.groups, factor);
  return changed;
}

FitTrial FitSearch::judged(const FitParameters &p, std::vector<double> factor,
                           ClosedValve closed) const {
  std::vector<SurfaceMatch> matches = matcher_.match(*closed.model, closed.state.x);
  const double misfit = log_misfit_of(p, matches, factor, s_);
  return {std::move(factor), std::move(closed), std::move(matches), misfit};
}

FitTrial FitSearch::from_open(const FitParameters &p, std::vector<double> factor) const {
  before_closure_();
  ClosedValve closed = close_open(solver_, make_model(scaled(p, factor)), s_.pressure);
  return judged(p, std::move(factor), std::move(closed));
}

FitTrial FitSearch::again(const FitParameters &p, std::vector<double> factor,
                          const ClosedValve &from) const {
  before_closure_();
  ClosedValve closed = close_again(solver_, from, scaled(p, factor));
  return judged(p, std::move(factor), std::move(closed));
}

// Takes the factors if the valve comes to rest, does not diverge, and has a smaller misfit.
bool FitSearch::accept(const FitParameters &p, const std::vector<double> &factor,
                       FitTrial &now) const {
  return without_divergence([&] {
    FitTrial there = again(p, factor, now.closed);
    if (!there.closed.stats.converged || there.misfit >= now.misfit) return false;
    now = std::move(there);
    return true;
  });
}

// Backtracks from a whole step.
void FitSearch::step_along(const FitParameters &p, std::vector<double> step, FitTrial &now) const {
  for (int trial = 0; trial <= most_halvings; ++trial) {
    double largest = 0;
    std::vector<double> next = now.factor;
    for (size_t k = 0; k < next.size(); ++k) {
      next[k] += step[k];
      largest = std::max(largest, std::abs(step[k]));
      step[k] *= 0.5;
    }
    if (largest < least_step || accept(p, next, now)) return;
  }
}

// A slack group changes nothing until it is short enough to be taut.
bool FitSearch::shorten(const FitParameters &p, size_t group, FitTrial &now) const {
  std::vector<double> next = now.factor;
  next[group] = std::max(s_.least, next[group] - slack_probe);
  return next[group] < now.factor[group] && accept(p, next, now);
}

uint32_t FitSearch::improve(const FitParameters &p, FitTrial &now,
                            std::vector<double> &deviation) const {
  const size_t n = p.groups.size();
  std::vector<uint8_t> probed(n, n > most_probed ? 1 : 0);
  uint32_t rounds = 0;
  for (bool improves = true; improves && rounds < s_.rounds; ++rounds) {
    const double before = now.misfit;
    std::vector<std::vector<double>> columns = jacobian_(now.closed, p.groups, now.matches);
    for (size_t k = 0; k < n; ++k) {
      for (double &c : columns[k]) c /= now.factor[k];
    }
    const Normal normal = normal_equations(p, now, columns, s_);
    deviation = inverse_diagonal(normal.h);
    for (double &d : deviation) d = std::sqrt(d);
    step_along(p, bounded_step(normal, now.factor, s_), now);
    for (size_t k = 0; k < n; ++k) {
      if (deviation[k] < undetermined_share * p.deviation || probed[k]) continue;
      probed[k] = shorten(p, k, now) ? 0 : 1;
    }
    improves = now.misfit < (1 - least_gain) * before;
  }
  return rounds;
}

}  // namespace mvs::core
