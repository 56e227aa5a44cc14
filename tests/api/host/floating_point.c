/* A host that rounds otherwise, or traps invalid operations, gets the same bits, and keeps its
 * mode. */
#include <fenv.h>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include "tests/api/repair.h"

static hash128 closed_hash(void) {
  mvs_sim *sim = new_valve(200);
  const mvs_load_case systole = {
      .struct_size = sizeof systole, .pressure = MVS_SYSTOLE_PA, .boundary_fraction = 1};
  MUST(mvs_set_load(sim, &systole));
  MUST(mvs_settle(sim, NULL, NULL));
  MUST(mvs_step(sim, NULL));
  const hash128 hash = sim_hash(sim);
  mvs_destroy(sim);
  return hash;
}

static void every_rounding_gives_the_same_bits(hash128 wanted) {
  const int modes[] = {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
  for (int k = 0; k < 3; ++k) {
    fesetround(modes[k]);
    const hash128 found = closed_hash();
    const int kept = fegetround();
    fesetround(FE_TONEAREST);
    CHECK(same_hash(found, wanted));
    CHECK(kept == modes[k]);
  }
}

static void traps_of_the_host_do_not_end_a_settle(hash128 wanted) {
#if defined(__SSE2__)
  const unsigned before = _mm_getcsr();
  _mm_setcsr(before & ~(unsigned)(_MM_MASK_INVALID | _MM_MASK_DIV_ZERO | _MM_MASK_OVERFLOW));
  const hash128 found = closed_hash();
  _mm_setcsr(before);
  CHECK(same_hash(found, wanted));
#else
  (void)wanted;
#endif
}

int main(void) {
  const hash128 wanted = closed_hash();
  every_rounding_gives_the_same_bits(wanted);
  traps_of_the_host_do_not_end_a_settle(wanted);
  return finish("floating_point");
}
