// The experimental interface for C++17: surfaces, ensembles, sensitivities, mesh levels,
// solver profile; may change.
#ifndef MVS_EXPERIMENTAL_HPP
#define MVS_EXPERIMENTAL_HPP

#include <mvs/experimental.h>
#include <mvs/build.hpp>
#include <mvs/ensemble.hpp>
#include <mvs/mvs.hpp>
#include <mvs/sensitivity.hpp>
#include <mvs/surface_file.hpp>

namespace mvs {

inline void refine(Simulator &sim) {
  must(mvs_refine_valve(sim.get()));
}

// By vertices or by edge; returns the changes.
inline mvs_coarsening coarsen(Simulator &sim, mvs_coarsen_options options) {
  options.struct_size = sizeof options;
  mvs_coarsening made = sized<mvs_coarsening>();
  must(mvs_coarsen_valve(sim.get(), &options, &made));
  return made;
}

// Transfers the state of a coarser or finer level of this valve.
inline void transfer_state(Simulator &sim, const Snapshot &from) {
  must(mvs_transfer_state(sim.get(), from.get()));
}

inline mvs_profile profile_of(const Simulator &sim) {
  return filled<mvs_profile>(mvs_get_profile, sim.get());
}

}  // namespace mvs

#endif
