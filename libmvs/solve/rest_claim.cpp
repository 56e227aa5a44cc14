// The residual of a state, as a settle measures it.
#include "solve/rest_claim.h"

#include <algorithm>

#include "base/error.h"
#include "energy/total_energy.h"
#include "solve/nodes.h"
#include "solve/settings.h"
#include "solve/static/boundary_ramp.h"

namespace mvs::core {
namespace {

// A settle in time ends a step after its last evaluation. The constant part, N, is far above the
// rounding of sums in another order.
constexpr double share_allowed = 2, rounding = 1e-12;

double residual_of(const Model &model, const State &state, ContactLaw law) {
  TotalEnergy total_energy(model, law);
  Profile profile;
  std::vector<Vec3> gradient;
  total_energy.use_verlet_list(false);
  total_energy.set_pressure(state.load.pressure);
  total_energy.prepare(state.x, state.x, 0, profile);
  total_energy.gradient(state.x, gradient, profile);
  return largest_free(model, gradient);
}

bool moves(const Model &model, const State &state) {
  for (size_t n = 0; n < state.v.size(); ++n) {
    if (!model.topology.fixed[n] && !state.v[n].isZero(0)) return true;
  }
  return false;
}

}  // namespace

std::string fault_of_rest(const Model &model, const State &state) {
  if (!state.is_at_rest()) return "";
  if (!boundary_is_there(model, state.x, state.load.boundary_fraction,
                         settings::settle::boundary_arrival)) {
    return "its annulus or a papillary head is not where its load puts it";
  }
  if (moves(model, state)) return "its nodes have velocities";
  const double most = share_allowed * state.rest_tolerance + rounding;
  const double found = residual_of(model, state, ContactLaw::barrier);
  if (found <= most) return "";
  // the explicit solver balances another law of contact
  if (residual_of(model, state, ContactLaw::penalty) <= most) return "";
  return format("its largest out-of-balance force is %g N", found);
}

}  // namespace mvs::core
