// Fits with several laws, and the choice among them.
#include "patient/fit/fitted_law.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/error.h"
#include "geometry/intersect.h"
#include "model/law.h"
#include "patient/fit/extend_free_edge.h"
#include "patient/fit/shape_error.h"

namespace mvs::core {
namespace {

// A law is clearly nearer than another if its misfit is at most this share: two segmentations of
// one valve, or two folds of one closure, differ by a tenth.
constexpr double clearly_nearer = 0.9;
// A law may be that of the patient if its misfit is at most this many times the least: misfits
// contain the errors of the surface, and a law whose own error is three quarters of theirs has 1.25
// times their misfit.
constexpr double plausible = 1.25;
// m, of the free edge of the open surface as networks draw it.
constexpr double edge_error = 1.4e-3;
// Errors are independent over some 5 mm: 26 places along 130 mm of free edge, 60 on 1,500 mm2 of
// leaflets, whose squares the distance averages.
constexpr double edge_places = 26.0 / 60.0;

const char *word_of(LeafletLawId law) {
  return find_leaflet_law(law)->word;
}

// A law is given up when its misfit after as many searches is more than this many times the least
// one. A second and third search lowered misfits to 0.8 at the least, but for searches whose first
// step led nowhere, whose law came to a quarter (phantoms.py --seed 501).
constexpr double far_behind = 2.5;

// A law, and the searches with it.
struct Candidate {
  LawFit fit;
  std::unique_ptr<FitSearches> searches;
  bool valid = false;    // neither diverged nor crossed
  bool stalled = false;  // no search so far got farther than its first rounds
};

// The best search so far; false: its closed valve crosses itself.
bool judge(const ClosedSurface &given, uint32_t searches, Candidate &c) {
  const ChordFit fit = c.searches->fit();
  const ClosedValve &closed = c.searches->closed();
  const std::vector<Vec3> &x = closed.state.x;
  for (size_t k = 0; k < fit.groups.size(); ++k) c.fit.factor[fit.groups[k].name] = fit.factor[k];
  c.fit.rms = fit.rms;
  c.fit.distance = distance_from_valve(given, *closed.model, x);
  c.fit.at_rest = fit.at_rest;
  c.fit.leak = fit.leak;
  c.stalled = fit.rounds <= 2 * searches;  // one of groups and one of chordae in each
  return find_intersections(x, closed.model->valve.triangles).empty();
}

void give_up_far_behind(std::vector<Candidate> &all) {
  double least = HUGE_VAL;
  for (const Candidate &c : all) {
    if (c.valid && c.fit.at_rest) least = std::min(least, misfit_of(c.fit));
  }
  for (Candidate &c : all) {
    if (!c.valid || !c.fit.at_rest || c.stalled || misfit_of(c.fit) <= far_behind * least) continue;
    c.fit.given_up = true;
    c.searches.reset();
  }
}

std::string words_of(const LawFit &fit) {
  std::string words = format("%s %.2f mm", word_of(fit.law), fit.distance * 1e3);
  if (!fit.at_rest) words += " (not at rest)";
  if (fit.given_up) words += " (given up)";
  if (fit.edge > 0) words += format(" and %.2f mm", fit.edge * 1e3);
  return words;
}

}  // namespace

std::vector<LawFit> fit_laws(std::vector<Valve> valves, const PatientGeometry &g,
                             const ClosedSurface &given, bool edge_is_exact, const TellShare &tell,
                             Workers *workers) {
  const FitSettings settings;
  const uint32_t n = static_cast<uint32_t>(valves.size());
  const auto tell_round = [&](uint32_t round) {
    return [&, round](double share) { tell((round + share) / (1 + settings.starts)); };
  };
  std::vector<Candidate> all(n);
  run_tasks(workers, n, tell_round(0), [&](uint32_t k, const TellShare &tell_law) {
    all[k].fit.law = valves[k].leaflets[0].law;
    all[k].valid = without_divergence([&] {
      PatientGeometry own = g;
      Findings unused;
      tell_law(0);
      if (!edge_is_exact)
        all[k].fit.edge = extend_free_edge(valves[k], own, given, {}, unused, tell_law);
      all[k].searches = std::make_unique<FitSearches>(std::move(valves[k]), given, settings);
      return true;
    });
  });
  for (uint32_t start = 0; start < settings.starts; ++start) {
    run_tasks(workers, n, tell_round(1 + start), [&](uint32_t k, const TellShare &tell_law) {
      Candidate &c = all[k];
      if (!c.valid || c.fit.given_up) return;
      c.valid = without_divergence([&] {
        c.searches->search(1, tell_law);
        return judge(given, start + 1, c);
      });
    });
    if (start + 1 < settings.starts) give_up_far_behind(all);
  }
  std::vector<LawFit> fits;
  for (Candidate &c : all) {
    if (c.valid) fits.push_back(std::move(c.fit));
  }
  return fits;
}

double misfit_of(const LawFit &fit) {
  const double edge = fit.edge * FitSettings().noise / edge_error;
  return std::sqrt(fit.distance * fit.distance + edge_places * edge * edge);
}

std::vector<LawFit> in_order(std::vector<LawFit> fits) {
  std::stable_sort(fits.begin(), fits.end(), [](const LawFit &a, const LawFit &b) {
    return a.at_rest != b.at_rest ? a.at_rest : misfit_of(a) < misfit_of(b);
  });
  return fits;
}

std::vector<LawFit> plausible_laws(const std::vector<LawFit> &fits) {
  std::vector<LawFit> laws;
  for (const LawFit &fit : fits) {
    if (fit.at_rest == fits[0].at_rest && misfit_of(fit) <= plausible * misfit_of(fits[0]))
      laws.push_back(fit);
  }
  return laws;
}

Finding tissue_found(const std::vector<LawFit> &fits, LeafletLawId taken) {
  if (fits.empty()) {
    return {"tissue",
            FindingSource::assumed,
            0.2,
            format("%s: no coarse valve with fitted chordae could be compared with the closed "
                   "surface; give the law if it is known",
                   word_of(taken)),
            {static_cast<double>(taken)},
            ""};
  }
  std::string words;
  for (const LawFit &fit : fits) words += (words.empty() ? "" : ", ") + words_of(fit);
  const LawFit &own =
      *std::find_if(fits.begin(), fits.end(), [&](const LawFit &fit) { return fit.law == taken; });
  const bool clear = std::all_of(fits.begin(), fits.end(), [&](const LawFit &fit) {
    return fit.law == taken || misfit_of(own) <= clearly_nearer * misfit_of(fit);
  });
  return {"tissue",
          FindingSource::guessed,
          !own.at_rest ? 0.2
          : clear      ? 0.6
                       : 0.4,
          format("%s, by distances (RMS) of the closed surface from coarse valves with fitted "
                 "chordae, and by how much their free edges had to be moved out: %s; give the law "
                 "if it is known",
                 word_of(taken), words.c_str()),
          {static_cast<double>(taken)},
          ""};
}

}  // namespace mvs::core
