// Observer of a settle: reports progress to the host, and ends the settle when the host cancels it
// or when the tissue yields without end.
#pragma once

#include <vector>

#include "model/model.h"
#include "solve/solver.h"

namespace mvs::core {

// Progress is the way that the boundary has travelled, then the fall of the residual to its
// tolerance on a logarithmic scale. It never falls, and is 1 at the end.
class SettleWatch {
 public:
  // `tolerance`: N, the residual at rest; `progress` may be empty. The model must outlive it.
  SettleWatch(const Model &model, const std::vector<Vec3> &x, const Load &load, double tolerance,
              const Progress &progress);

  // To be called before each iteration, with the nodes and the residual there. Throws
  // MVS_E_CANCELLED, and MVS_E_DIVERGED with the leaflet that yields.
  void look(const std::vector<Vec3> &x, double residual);
  // To be called within a long iteration: reports as the last look did, so that the host can
  // cancel.
  void poll() const;
  // To be called once at the end: the host may cancel there as well, and then no result is kept.
  void finish(double residual) const;

 private:
  double share_of(const std::vector<Vec3> &x, double residual);
  void report(double share, double residual) const;
  void must_hold(const std::vector<Vec3> &x) const;

  const Model *model_;
  Progress progress_;
  Load load_;
  double tolerance_;
  double way_;                       // m, of the boundary from the start to its target
  double highest_ = 0;               // N, largest residual so far
  double share_ = 0, residual_ = 0;  // reported last; N
  uint32_t looks_ = 0;
};

}  // namespace mvs::core
