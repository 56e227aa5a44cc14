// The servo of a haptic device allocates no memory and makes no system call on any input: new
// tissue, new limits, a cut, faults of the device. A device is closed without memory, and started
// again after the system had no thread for it.
#include <mvs/experimental.h>
#include <mvs/mvs.h>

#include <dlfcn.h>
#include <pthread.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <initializer_list>

#include "check.h"
#include "tests/fault/counted.h"
#include "tests/founding.h"

#if HAS_OWN_MALLOC
namespace {
bool has_threads = true;
}

// Of every library of this process.
extern "C" [[gnu::visibility("default")]] int pthread_create(pthread_t *made,
                                                             const pthread_attr_t *attributes,
                                                             void *(*work)(void *), void *of) {
  using Create = int (*)(pthread_t *, const pthread_attr_t *, void *(*)(void *), void *);
  static const auto create = reinterpret_cast<Create>(dlsym(RTLD_NEXT, "pthread_create"));
  return has_threads ? create(made, attributes, work, of) : EAGAIN;
}
#endif

namespace {

// A simulated hand that swings through a valve, started and armed.
struct Scene {
  Scene(const char *options, uint32_t mode) {
    const mvs_load_case systole = {sizeof systole, 0, MVS_SYSTOLE_PA, 1};
    MUST(mvs_create(nullptr, &sim));
    MUST(generate_founding(sim));
    MUST(mvs_set_load(sim, &systole));
    MUST(mvs_settle(sim, nullptr, nullptr));
    mvs_device_desc desc = {};
    desc.struct_size = sizeof desc;
    desc.clock = MVS_CLOCK_VIRTUAL;
    desc.driver = "hand";
    desc.options = options;
    mvs_device_hand hand = {};
    hand.struct_size = sizeof hand;
    hand.mode = mode;
    hand.reach = 0.05;
    MUST(mvs_device_open(&desc, &device));
    MUST(mvs_device_set_hand(device, &hand));
    MUST(mvs_device_start(device));
    MUST(mvs_device_advance(device, 0.01));
    MUST(mvs_device_arm(device));
  }
  ~Scene() {
    mvs_device_close(device);
    mvs_destroy(sim);
  }
  void hand_over() const {
    MUST(mvs_device_sync(device, sim, nullptr));
    MUST(mvs_step(sim, nullptr));
  }
  mvs_device_state state() const {
    mvs_device_state state = {};
    state.struct_size = sizeof state;
    MUST(mvs_device_get_state(device, &state));
    return state;
  }

  mvs_sim *sim = nullptr;
  mvs_device *device = nullptr;
};

[[maybe_unused]] constexpr char grasping[] =
    "device=touch\namplitude=0.005,0,0\nfrequency=2\nfault=stuck_button\nfault_at=0.1";

// A device that renders the torque of the rod that it holds.
[[maybe_unused]] constexpr char turning[] =
    "device=premium6\namplitude=0.005,0,0.01\nturn_amplitude=0.1,0.1,0\nfrequency=2";

#if HAS_OWN_MALLOC
void ticks_allocate_nothing(const char *options, uint32_t phase,
                            uint32_t mode = MVS_HAND_MODE_GRASP) {
  const Scene scene(options, mode);
  long made = 0;
  bool twisted = false;
  for (int k = 0; k < 200; ++k) {
    scene.hand_over();
    const long before = allocations;
    MUST(mvs_device_advance(scene.device, 0.01));
    made += allocations - before;
    const mvs_device_state now = scene.state();
    twisted = twisted || now.torque[0] != 0;
  }
  CHECK(made == 0);
  CHECK(twisted == (mode == MVS_HAND_MODE_ROD));
  CHECK(scene.state().phase == phase);
  std::printf("%ld allocations in %llu ticks\n", made,
              static_cast<unsigned long long>(scene.state().ticks));
}
#endif

#if HAS_OWN_MALLOC
mvs_device *opened(uint32_t clock) {
  mvs_device_desc desc = {};
  desc.struct_size = sizeof desc;
  desc.clock = clock;
  desc.driver = "hand";
  mvs_device *device = nullptr;
  MUST(mvs_device_open(&desc, &device));
  return device;
}

void a_device_is_closed_without_memory() {
  for (const bool is_started : {false, true}) {
    mvs_device *device = opened(MVS_CLOCK_REAL);
    if (is_started) MUST(mvs_device_start(device));
    has_memory = false;
    mvs_device_close(device);
    has_memory = true;
    mvs_device_close(opened(MVS_CLOCK_REAL));
  }
}

void a_device_starts_again_after_the_system_had_no_thread() {
  mvs_device *device = opened(MVS_CLOCK_REAL);
  has_threads = false;
  CHECK(mvs_device_start(device) == MVS_E_MEMORY);
  CHECK(std::strstr(mvs_last_error()->message, "starts no thread"));
  has_threads = true;
  MUST(mvs_device_start(device));
  mvs_device_close(device);
}

void a_driver_without_a_thread_is_refused_with_a_sentence() {
  mvs_device_desc desc = {};
  desc.struct_size = sizeof desc;
  desc.driver = "hand";
  mvs_device *device = nullptr;
  has_threads = false;
  MUST_FAIL(mvs_device_open(&desc, &device), MVS_E_MEMORY, "hand: the system starts no thread");
  MUST_FAIL(mvs_device_list(
                "hand", nullptr, [](void *, const char *, const char *) {}, nullptr),
            MVS_E_MEMORY, "end other programs");
  has_threads = true;
  mvs_device_close(opened(MVS_CLOCK_REAL));
}
#endif

#if HAS_SECCOMP
void ticks_call_no_system(const char *options, uint32_t mode) {
  const Scene scene(options, mode);
  for (int k = 0; k < 100; ++k) {
    scene.hand_over();
    MUST(mvs_device_advance(scene.device, 0.01));
  }
  scene.hand_over();
  CHECK(computes_only([&] { return mvs_device_advance(scene.device, 1) == MVS_OK; }));
}
#endif

}  // namespace

int main() {
#if HAS_OWN_MALLOC
  ticks_allocate_nothing(grasping, MVS_DEVICE_PHASE_ON);
  ticks_allocate_nothing("fault=nan_position\nfault_at=0.5", MVS_DEVICE_PHASE_LATCHED);
  ticks_allocate_nothing("fault=jump\nfault_at=0.5", MVS_DEVICE_PHASE_LATCHED);
  ticks_allocate_nothing(turning, MVS_DEVICE_PHASE_ON, MVS_HAND_MODE_ROD);
#endif
#if HAS_OWN_MALLOC
  a_device_is_closed_without_memory();
  a_device_starts_again_after_the_system_had_no_thread();
  a_driver_without_a_thread_is_refused_with_a_sentence();
#endif
#if HAS_SECCOMP
  ticks_call_no_system(grasping, MVS_HAND_MODE_GRASP);
  ticks_call_no_system(turning, MVS_HAND_MODE_ROD);
#endif
  return finish("servo");
}
