// The functions of haptic devices in a build without them (MVS_HAPTICS=OFF): no driver is listed,
// and the others refuse.
#include <mvs/device.h>

#include "api/exception_boundary.h"
#include "api/structs.h"
#include "base/error.h"

using namespace mvs::core;

namespace {

mvs_result refuse() noexcept {
  return at_boundary([] {
    fail(MVS_E_UNSUPPORTED, "device",
         "this build has no haptic devices: build with MVS_HAPTICS=ON");
  });
}

}  // namespace

extern "C" {

mvs_result mvs_get_driver_count(uint32_t *count) {
  return at_boundary([&] {
    must_point(count, "count");
    *count = 0;
  });
}

mvs_result mvs_get_driver(uint32_t, const char **, const char **) {
  return refuse();
}

mvs_result mvs_device_list(const char *, const char *, mvs_driver_found, void *) {
  return refuse();
}

mvs_result mvs_device_doctor(const char *, const char *, mvs_driver_finding, void *) {
  return refuse();
}

mvs_result mvs_device_open(const mvs_device_desc *, mvs_device **) {
  return refuse();
}

void mvs_device_close(mvs_device *) {}

mvs_result mvs_device_get_info(const mvs_device *, mvs_device_info *) {
  return refuse();
}

mvs_result mvs_device_set_limits(mvs_device *, const mvs_device_limits *) {
  return refuse();
}

mvs_result mvs_device_get_limits(const mvs_device *, mvs_device_limits *) {
  return refuse();
}

mvs_result mvs_device_set_view(mvs_device *, const mvs_device_view *) {
  return refuse();
}

mvs_result mvs_device_get_view(const mvs_device *, mvs_device_view *) {
  return refuse();
}

mvs_result mvs_device_set_hand(mvs_device *, const mvs_device_hand *) {
  return refuse();
}

mvs_result mvs_device_get_hand(const mvs_device *, mvs_device_hand *) {
  return refuse();
}

mvs_result mvs_device_start(mvs_device *) {
  return refuse();
}

mvs_result mvs_device_stop(mvs_device *) {
  return refuse();
}

mvs_result mvs_device_arm(mvs_device *) {
  return refuse();
}

mvs_result mvs_device_cut(mvs_device *) {
  return refuse();
}

mvs_result mvs_device_advance(mvs_device *, double) {
  return refuse();
}

mvs_result mvs_device_sync(mvs_device *, mvs_sim *, mvs_device_report *) {
  return refuse();
}

mvs_result mvs_device_get_state(mvs_device *, mvs_device_state *) {
  return refuse();
}

mvs_result mvs_device_take_samples(mvs_device *, mvs_device_sample *, uint32_t, uint64_t,
                                   uint64_t *, uint64_t *) {
  return refuse();
}

mvs_result mvs_device_handle_signals(uint32_t) {
  return refuse();
}

}  // extern "C"
