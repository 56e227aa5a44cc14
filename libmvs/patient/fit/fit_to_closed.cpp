// Searches from several lengths, the best closure from open, the spread of those as good.
#include "patient/fit/fit_to_closed.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "measure/orifice/orifice.h"
#include "patient/checks/input_arrays.h"
#include "patient/fit/fit_report.h"
#include "patient/fit/fit_search.h"
#include "patient/fit/linear_closure.h"
#include "patient/normal_numbers.h"
#include "patient/surface/rims.h"

namespace mvs::core {

// One search: factors of groups and of chordae, and the valve closed with them from open.
struct FoundLengths {
  std::vector<double> group, group_deviation;
  std::vector<double> chord_deviation;
  FitTrial trial;  // its factors are those of chordae if they are sought one by one
  double rms = 0;
  uint32_t rounds = 0;
};

namespace {

// m, RMS: leaflets move by 3 to 5 mm as they close (median); the sides of thick ones lie 1 mm off.
constexpr double nearest_open = 1e-3;
constexpr uint64_t start_seed = 22;    // of the other starts
constexpr double usual_closures = 50;  // of a search: about so many, for its progress

// The share of a search that is done; its number of closures is not known before.
double share_after(uint32_t closures) {
  return closures / (closures + usual_closures);
}

// The model of a valve, whose annulus the surface must meet.
ModelPtr checked_model(const ClosedSurface &given, const Valve &valve) {
  MVS_MUST(!given.triangles.empty(), MVS_E_ARGUMENT, "closed_triangles",
           "the closed surface has no triangles");
  check_triangles(given.points, given.triangles, "closed_points", "closed_triangles");
  ModelPtr made = make_model(valve);
  const Model &model = *made;
  const TriangleBvh tree(given.triangles, given.points);
  double sum = 0;
  for (const uint32_t i : model.valve.annulus) sum += tree.closest(model.target(i, 1)).distance2;
  const double rms = std::sqrt(sum / static_cast<double>(model.valve.annulus.size()));
  MVS_MUST(
      rms <= farthest_annulus, MVS_E_OP, "closed_points",
      "the annulus lies %.1f mm from the closed surface, at most %.0f mm are accepted: are both "
      "in one frame (LPS or RAS), in m (--unit of a file), and of one patient? If they are "
      "displaced, register them",
      rms * 1e3, farthest_annulus * 1e3);
  // each vertex weighs as many triangles as meet there
  const std::vector<uint32_t> &start = model.topology.node_triangles.start;
  double off = 0;
  for (uint32_t i = 0; i + 1 < start.size(); ++i) {
    const uint32_t triangles = start[i + 1] - start[i];
    if (triangles > 0) off += triangles * tree.closest(model.valve.rest[i]).distance2;
  }
  off = std::sqrt(off / static_cast<double>(3 * model.valve.triangles.size()));
  MVS_MUST(off > nearest_open, MVS_E_OP, "closed_points",
           "the closed surface lies on the open one, %.2f mm away in the mean (RMS): give the "
           "leaflets closed under pressure, or leave them out",
           off * 1e3);
  return made;
}

double loss(const FoundLengths &found) {
  return loss_of(found.rms, found.trial.closed.stats.converged);
}

// Each chord of the groups as a group of its own, around the factor of its group.
FitParameters singles_of(const FitParameters &groups, const std::vector<double> &factor,
                         const FitSettings &s) {
  FitParameters singles;
  singles.deviation = s.single_prior;
  for (size_t k = 0; k < groups.groups.size(); ++k) {
    for (const uint32_t c : groups.groups[k].chords) {
      singles.groups.push_back({groups.groups[k].name, {c}});
      singles.mean.push_back(factor[k]);
    }
  }
  return singles;
}

// Searches from a closed trial. A search follows one fold; the valve is closed from open
// afterwards, and if that is another fold, which is farther from the surface, the search goes on
// from there.
FoundLengths search_from(const FitSearch &fit, const FitParameters &groups, const FitSettings &s,
                         FitTrial start) {
  FoundLengths best;
  uint32_t rounds = 0;
  for (int pass = 0; pass < 2; ++pass) {
    FoundLengths here;
    rounds += fit.improve(groups, start, here.group_deviation);
    here.group = start.factor;
    double followed = rms_distance(start.matches);
    if (s.one_by_one) {
      const FitParameters singles = singles_of(groups, here.group, s);
      FitTrial single = fit.judged(singles, singles.mean, start.closed);
      rounds += fit.improve(singles, single, here.chord_deviation);
      followed = rms_distance(single.matches);
      here.trial = fit.from_open(singles, single.factor);
    } else {
      here.trial = fit.from_open(groups, here.group);
    }
    here.rms = rms_distance(here.trial.matches);
    const bool is_better = pass == 0 || loss(here) < loss(best);
    if (is_better) best = std::move(here);
    if (!is_better || best.rms <= as_good_as(followed)) break;
    start = fit.again(groups, best.group, best.trial.closed);
  }
  best.rounds = rounds;
  return best;
}

// Starting factors: those known, then some from the prior.
std::vector<double> start_factors(const FitParameters &groups, const FitSettings &s,
                                  uint32_t start) {
  std::vector<double> factor = groups.mean;
  if (start == 0) {
    for (size_t k = 0; k < factor.size(); ++k) {
      const auto known = s.known.find(groups.groups[k].name);
      if (known != s.known.end()) factor[k] = known->second;
    }
    return factor;
  }
  NormalNumbers random(start_seed + start);
  for (double &f : factor) {
    f = std::clamp(f + groups.deviation * random.next(), s.least, s.most);
  }
  return factor;
}

double node_distance(const Model &model, const std::vector<Vec3> &a, const std::vector<Vec3> &b) {
  double sum = 0, area = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    sum += model.vertex_area[i] * (a[i] - b[i]).squaredNorm();
    area += model.vertex_area[i];
  }
  return std::sqrt(sum / area);
}

// The root of the sum of the squares of independent deviations.
double combined(double a, double b, double c = 0) {
  return std::sqrt(a * a + b * b + c * c);
}

// Puts the searches that are as good as the best one into the fit, with deviations and spread.
void collect(const std::vector<FoundLengths> &found, size_t best, const FitParameters &groups,
             const FitSettings &s, size_t chords, ChordFit &fit) {
  const FoundLengths &taken = found[best];
  const Model &model = *taken.trial.closed.model;
  const double limit = as_good_as(taken.rms);
  fit.leak = measure_orifice(model, taken.trial.closed.state.x).area;
  std::vector<double> low = taken.trial.factor, high = low;
  for (size_t k = 0; k < found.size(); ++k) {
    if (k == best || found[k].rms > limit || !found[k].trial.closed.stats.converged) continue;
    const std::vector<Vec3> &x = found[k].trial.closed.state.x;
    fit.spread = std::max(fit.spread, node_distance(model, x, taken.trial.closed.state.x));
    fit.other_leaks.push_back(measure_orifice(model, x).area);
    for (size_t i = 0; i < low.size(); ++i) {
      low[i] = std::min(low[i], found[k].trial.factor[i]);
      high[i] = std::max(high[i], found[k].trial.factor[i]);
    }
  }
  fit.groups = groups.groups;
  fit.chord_factor.assign(chords, 1);
  fit.chord_deviation.assign(chords, 0);
  for (size_t g = 0, i = 0; g < groups.groups.size(); ++g) {
    double factor = 0, half = 0;
    for (const uint32_t c : groups.groups[g].chords) {
      const size_t at = s.one_by_one ? i++ : g;
      const double open = 0.5 * (high[at] - low[at]);
      const double single = s.one_by_one ? taken.chord_deviation[at] : 0;
      fit.chord_factor[c] = taken.trial.factor[at];
      fit.chord_deviation[c] = combined(taken.group_deviation[g], single, open);
      factor += taken.trial.factor[at];
      half += open;
    }
    const double count = static_cast<double>(groups.groups[g].chords.size());
    fit.factor.push_back(factor / count);
    fit.deviation.push_back(combined(taken.group_deviation[g], half / count));
  }
}

}  // namespace

struct FitSearches::Work {
  Valve valve;
  FitSettings settings;
  ClosedJacobian jacobian;
  Solver solver{Backend::fastest};
  ClosedValve first;  // as it is given
  SurfaceMatcher matcher;
  FitParameters groups;
  FitTrial as_it_is;
  std::vector<FoundLengths> found;  // of the searches that did not diverge
  size_t best = 0;
  uint32_t begun = 0;  // searches

  Work(Valve given_valve, const ClosedSurface &given, const FitSettings &s, ClosedJacobian j)
      : valve(std::move(given_valve)),
        settings(s),
        jacobian(j ? std::move(j) : jacobian_by_linearisation()),
        first(close_open(solver, checked_model(given, valve), s.pressure)),
        matcher(given, *first.model, first.state.x),
        groups{chord_groups(*first.model, s.grouping), {}, s.prior} {
    groups.mean.assign(groups.groups.size(), 1);
    const FitSearch from(valve, matcher, settings, solver, jacobian, {});
    as_it_is = from.judged(groups, groups.mean, first);
  }

  // The search number `start`, from 0.
  FoundLengths search(uint32_t start, const TellShare &tell) const {
    uint32_t closures = 0;
    const auto before_closure = [&] { tell(share_after(closures++)); };
    Solver own(Backend::fastest);
    const FitSearch from(valve, matcher, settings, own, jacobian, before_closure);
    FitTrial begin = start == 0 && settings.known.empty()
                         ? as_it_is
                         : from.from_open(groups, start_factors(groups, settings, start));
    return search_from(from, groups, settings, std::move(begin));
  }

  void add(FoundLengths lengths) {
    found.push_back(std::move(lengths));
    if (loss(found.back()) < loss(found[best])) best = found.size() - 1;
  }
};

FitSearches::FitSearches(Valve valve, const ClosedSurface &given, const FitSettings &settings,
                         ClosedJacobian jacobian)
    : work_(std::make_unique<Work>(std::move(valve), given, settings, std::move(jacobian))) {}

FitSearches::~FitSearches() = default;

void FitSearches::search(uint32_t count, const TellShare &tell) {
  const uint32_t first = work_->begun;
  work_->begun += count;
  std::vector<std::optional<FoundLengths>> found(count);
  run_tasks(work_->settings.workers, count, tell, [&](uint32_t k, const TellShare &tell_search) {
    without_divergence([&] {
      found[k] = work_->search(first + k, tell_search);
      return true;
    });
  });
  for (std::optional<FoundLengths> &lengths : found) {
    if (lengths) work_->add(std::move(*lengths));
  }
  MVS_MUST(!work_->found.empty(), MVS_E_DIVERGED, "chordae",
           "the valve diverges with every length of its chordae that was tried; check the tissue "
           "and the closed surface");
}

const ClosedValve &FitSearches::closed() const {
  return work_->found[work_->best].trial.closed;
}

ChordFit FitSearches::fit() const {
  const Work &w = *work_;
  ChordFit made;
  made.rms_before = rms_distance(w.as_it_is.matches);
  for (const FoundLengths &found : w.found) made.rounds += found.rounds;
  collect(w.found, w.best, w.groups, w.settings, w.valve.chords.size(), made);
  made.rms = w.found[w.best].rms;
  made.at_rest = closed().stats.converged;
  return made;
}

ChordFit fit_to_closed(Valve &valve, const ClosedSurface &given, const FitSettings &s,
                       Findings &findings, ClosedJacobian jacobian, const TellShare &tell) {
  FitSearches searches(valve, given, s, std::move(jacobian));
  searches.search(std::max(1u, s.starts), tell);
  ChordFit done = searches.fit();
  for (size_t c = 0; c < valve.chords.size(); ++c)
    valve.chords[c].rest_length *= done.chord_factor[c];
  report_fit(done, s, findings);
  return done;
}

}  // namespace mvs::core
