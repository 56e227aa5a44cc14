// Gauss-Newton rounds: match, differentiate, solve with bounds, backtrack.
#include "patient/fit/fit_to_closed.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/math.h"
#include "patient/fit/normal_equations.h"

namespace mvs::core {
namespace {

// Step of the differences: 0.15 mm of a chord of 15 mm, far above the error of a settled valve.
constexpr double difference = 0.01;
// m2: errors of a segmented surface are alike within about 5 mm, so that a patch counts once.
constexpr double patch = 25e-6;
// m: matches count less beyond this distance (Cauchy's weight), as the given surface may lack parts
// of the leaflets.
constexpr double robust_distance = 3e-3;
// The fit ends where no factor changes by more than this, or the misfit falls by less than a share.
constexpr double least_step = 1e-3, least_gain = 0.01;
constexpr int most_halvings = 3;
// By how much a group without influence is shortened at a time.
constexpr double slack_probe = 0.05;
// m, RMS distance of the annulus from the given surface: more is another frame or patient.
constexpr double farthest_annulus = 8e-3;
// A factor is not determined by the surface if its deviation is at least this share of the prior's.
constexpr double undetermined_share = 0.7;

// 1 over the variance, times the number of patches.
double match_weight(const SurfaceMatch &m, const FitSettings &s) {
  const double far = m.distance / robust_distance;
  // both ways count half
  return 0.5 * m.area / patch / (s.noise * s.noise * (1 + far * far));
}

// Minus twice the logarithm of the posterior, whose gradient has the weights above.
double misfit_of(const std::vector<SurfaceMatch> &matches, const std::vector<double> &factor,
                 const FitSettings &s) {
  double sum = 0;
  for (const SurfaceMatch &m : matches) {
    const double far = m.distance / robust_distance, scale = robust_distance / s.noise;
    sum += 0.5 * m.area / patch * scale * scale * math::log(1 + far * far);
  }
  for (const double f : factor) sum += (f - 1) * (f - 1) / (s.prior * s.prior);
  return sum;
}

// A closed valve with given factors.
struct Trial {
  std::vector<double> factor;
  ClosedValve closed;
  std::vector<SurfaceMatch> matches;
  double misfit = 0;
};

struct Normal {
  DenseMatrix h;
  std::vector<double> right;
};
Normal normal_equations(const Trial &now, const std::vector<std::vector<double>> &jacobian,
                        const FitSettings &s) {
  const size_t n = now.factor.size();
  Normal normal{DenseMatrix(n), std::vector<double>(n, 0)};
  for (size_t m = 0; m < now.matches.size(); ++m) {
    const double w = match_weight(now.matches[m], s);
    const double r = now.matches[m].residual(now.closed.state.x);
    for (size_t i = 0; i < n; ++i) {
      normal.right[i] -= w * jacobian[i][m] * r;
      for (size_t j = 0; j < n; ++j) normal.h.at(i, j) += w * jacobian[i][m] * jacobian[j][m];
    }
  }
  for (size_t i = 0; i < n; ++i) {
    normal.h.at(i, i) += 1 / (s.prior * s.prior);
    normal.right[i] -= (now.factor[i] - 1) / (s.prior * s.prior);
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

void check_surface(const ClosedSurface &given, const Model &model) {
  MVS_MUST(!given.triangles.empty(), MVS_E_ARGUMENT, "closed_triangles",
           "the closed surface has no triangles");
  for (const Tri &t : given.triangles) {
    for (const uint32_t i : t) {
      MVS_MUST(i < given.points.size(), MVS_E_ARGUMENT, "closed_triangles",
               "the closed surface names point %u of %zu", i, given.points.size());
    }
  }
  const TriangleBvh tree(given.triangles, given.points);
  double sum = 0;
  for (const uint32_t i : model.valve.annulus) sum += tree.closest(model.target(i, 1)).distance2;
  const double rms = std::sqrt(sum / static_cast<double>(model.valve.annulus.size()));
  MVS_MUST(
      rms <= farthest_annulus, MVS_E_OP, "closed_points",
      "the annulus lies %.1f mm from the closed surface, at most %.0f mm are accepted: are both "
      "in one frame (LPS or RAS), and of one patient?",
      rms * 1e3, farthest_annulus * 1e3);
}

Valve scaled(const Valve &valve, const std::vector<ChordGroup> &groups,
             const std::vector<double> &factor) {
  Valve changed = valve;
  scale_groups(changed, groups, factor);
  return changed;
}

// The best trial so far, and the ways to a better one.
struct Fit {
  const Valve &valve;
  const FitSettings &settings;
  Solver &solver;
  ClosedValve first;
  SurfaceMatcher matcher;
  std::vector<ChordGroup> groups;
  Trial now;

  Fit(const Valve &valve_in, const ClosedSurface &given, const FitSettings &s, Solver &solver_in)
      : valve(valve_in),
        settings(s),
        solver(solver_in),
        first(close_open(solver, valve, s.pressure)),
        matcher(given, *first.model, first.state.x),
        groups(chord_groups(*first.model, s.grouping)) {
    now = judged(std::vector<double>(groups.size(), 1), first);
  }

  Trial judged(std::vector<double> factor, ClosedValve closed) const {
    std::vector<SurfaceMatch> matches = matcher.match(*closed.model, closed.state.x);
    const double misfit = misfit_of(matches, factor, settings);
    return {std::move(factor), std::move(closed), std::move(matches), misfit};
  }

  // Takes the factors if the valve comes to rest with a smaller misfit.
  bool accept(const std::vector<double> &factor) {
    Trial there = judged(factor, close_again(solver, now.closed, scaled(valve, groups, factor)));
    if (!there.closed.stats.converged || there.misfit >= now.misfit) return false;
    now = std::move(there);
    return true;
  }

  // Backtracks from a whole step.
  bool step_along(std::vector<double> step) {
    for (int trial = 0; trial <= most_halvings; ++trial) {
      double largest = 0;
      std::vector<double> next = now.factor;
      for (size_t k = 0; k < next.size(); ++k) {
        next[k] += step[k];
        largest = std::max(largest, std::abs(step[k]));
        step[k] *= 0.5;
      }
      if (largest < least_step) return false;
      if (accept(next)) return true;
    }
    return false;
  }

  // A slack group changes nothing until it is short enough to be taut.
  bool shorten(size_t group) {
    std::vector<double> next = now.factor;
    next[group] = std::max(settings.least, next[group] - slack_probe);
    return next[group] < now.factor[group] && accept(next);
  }
};

void report(const ChordFit &fit, const FitSettings &s, Findings &findings) {
  std::string open, bound;
  for (size_t k = 0; k < fit.groups.size(); ++k) {
    if (fit.deviation[k] >= undetermined_share * s.prior) {
      open += (open.empty() ? "" : "; ") + fit.groups[k].name;
    }
    if (fit.factor[k] <= s.least || fit.factor[k] >= s.most) {
      bound += (bound.empty() ? "" : "; ") + fit.groups[k].name;
    }
  }
  // 0.5 mm: two segmentations of one valve differ by as much; 2 mm: a fit that failed
  const double confidence = std::clamp(0.9 * (2e-3 - fit.rms) / 1.5e-3, 0.1, 0.9);
  findings.push_back(
      {"closed_fit",
       FindingSource::measured,
       confidence,
       format("chordae fitted in %u rounds: the closed valve is %.2f mm (RMS) from the given "
              "surface, %.2f mm before%s%s",
              fit.rounds, fit.rms * 1e3, fit.rms_before * 1e3,
              bound.empty() ? "" : "; factors at their limit, are tips and rest shape right? ",
              bound.c_str()),
       {fit.rms, fit.rms_before},
       "m"});
  findings.push_back(
      {"chord_factors", FindingSource::measured, open.empty() ? confidence : 0.5 * confidence,
       open.empty() ? std::string("factors of all groups of chordae follow from the closed surface")
                    : "the closed surface does not determine the lengths of these chordae: " + open,
       fit.factor, ""});
}

}  // namespace

ClosedJacobian jacobian_by_differences(Solver &solver) {
  return [&solver](const ClosedValve &closed, const std::vector<ChordGroup> &groups,
                   const std::vector<SurfaceMatch> &matches) {
    std::vector<std::vector<double>> jacobian;
    for (size_t k = 0; k < groups.size(); ++k) {
      std::vector<double> factor(groups.size(), 1);
      factor[k] += difference;
      const ClosedValve moved =
          close_again(solver, closed, scaled(closed.model->valve, groups, factor));
      std::vector<double> column;
      column.reserve(matches.size());
      for (const SurfaceMatch &m : matches) {
        column.push_back((m.residual(moved.state.x) - m.residual(closed.state.x)) / difference);
      }
      jacobian.push_back(std::move(column));
    }
    return jacobian;
  };
}

ChordFit fit_to_closed(Valve &valve, const ClosedSurface &given, const FitSettings &s,
                       Findings &findings, ClosedJacobian jacobian) {
  Solver solver(Backend::fastest);
  if (!jacobian) jacobian = jacobian_by_differences(solver);
  check_surface(given, *make_model(valve));
  Fit fit(valve, given, s, solver);
  const size_t n = fit.groups.size();
  std::vector<uint8_t> probed(n, 0);
  std::vector<double> deviation(n, s.prior);
  const double rms_before = rms_distance(fit.now.matches);
  uint32_t rounds = 0;
  for (bool improves = true; improves && rounds < s.rounds; ++rounds) {
    const double before = fit.now.misfit;
    std::vector<std::vector<double>> columns =
        jacobian(fit.now.closed, fit.groups, fit.now.matches);
    for (size_t k = 0; k < n; ++k) {
      for (double &c : columns[k]) c /= fit.now.factor[k];
    }
    const Normal normal = normal_equations(fit.now, columns, s);
    const std::vector<double> variance = inverse_diagonal(normal.h);
    for (size_t k = 0; k < n; ++k) deviation[k] = std::sqrt(variance[k]);
    fit.step_along(bounded_step(normal, fit.now.factor, s));
    for (size_t k = 0; k < n; ++k) {
      if (deviation[k] < undetermined_share * s.prior || probed[k]) continue;
      probed[k] = fit.shorten(k) ? 0 : 1;
    }
    improves = fit.now.misfit < (1 - least_gain) * before;
  }
  scale_groups(valve, fit.groups, fit.now.factor);
  ChordFit done{
      std::move(fit.groups),         fit.now.factor, std::move(deviation),          rms_before,
      rms_distance(fit.now.matches), rounds,         fit.now.closed.stats.converged};
  report(done, s, findings);
  return done;
}

}  // namespace mvs::core
