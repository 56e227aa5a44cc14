/* The parametric valve of the founding model: shape and springs of Tenenholtz et al. (2011). Tests
 * and benchmarks whose figures are those of this valve name it. */
#ifndef MVS_TESTS_FOUNDING_H
#define MVS_TESTS_FOUNDING_H

#include <mvs/sim.h>
#include <string.h>

static inline mvs_parametric_desc founding_valve(void) {
  mvs_parametric_desc desc;
  memset(&desc, 0, sizeof desc);
  desc.struct_size = sizeof desc;
  desc.shape = MVS_SHAPE_FOUNDING;
  return desc;
}

static inline mvs_result generate_founding(mvs_sim *sim) {
  const mvs_parametric_desc desc = founding_valve();
  return mvs_generate_valve(sim, &desc);
}

#endif
