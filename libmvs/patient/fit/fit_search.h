// Gauss-Newton search for factors on rest lengths with which a valve closes to a given surface.
#pragma once

#include "patient/fit/fit_to_closed.h"
#include "patient/fit/normal_equations.h"

namespace mvs::core {

// Chordae whose factors are sought, with a normal prior for each factor.
struct FitParameters {
  std::vector<ChordGroup> groups;
  std::vector<double> mean;
  double deviation = 0.1;
};

// A closed valve with given factors on the lengths of the valve that is fitted.
struct FitTrial {
  std::vector<double> factor;
  ClosedValve closed;
  std::vector<SurfaceMatch> matches;
  double misfit = 0;  // minus twice the logarithm of the posterior
};

class FitSearch {
 public:
  // Keeps references to all arguments but the last, which is called before each closure and may
  // throw.
  FitSearch(const Valve &valve, const SurfaceMatcher &matcher, const FitSettings &settings,
            Solver &solver, const ClosedJacobian &jacobian, std::function<void()> before_closure)
      : valve_(valve),
        matcher_(matcher),
        s_(settings),
        solver_(solver),
        jacobian_(jacobian),
        before_closure_(std::move(before_closure)) {}

  Valve scaled(const FitParameters &p, const std::vector<double> &factor) const;
  FitTrial judged(const FitParameters &p, std::vector<double> factor, ClosedValve closed) const;
  // Closes from the open shape.
  FitTrial from_open(const FitParameters &p, std::vector<double> factor) const;
  // Closes from another closed trial.
  FitTrial again(const FitParameters &p, std::vector<double> factor, const ClosedValve &from) const;
  // Improves a trial in rounds: match, differentiate, solve with bounds, backtrack; each closure
  // starts from the last. Sets the posterior standard deviation of each factor at the last
  // linearisation. Returns the number of rounds.
  uint32_t improve(const FitParameters &p, FitTrial &now, std::vector<double> &deviation) const;

 private:
  bool accept(const FitParameters &p, const std::vector<double> &factor, FitTrial &now) const;
  void step_along(const FitParameters &p, std::vector<double> step, FitTrial &now) const;
  bool shorten(const FitParameters &p, size_t group, FitTrial &now) const;

  const Valve &valve_;
  const SurfaceMatcher &matcher_;
  const FitSettings &s_;
  Solver &solver_;
  const ClosedJacobian &jacobian_;
  const std::function<void()> before_closure_;
};

}  // namespace mvs::core
