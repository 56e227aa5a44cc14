// Haptic devices: opens and starts them, exchanges data with a simulator.
#include "haptics/device.h"

#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "api/sim_call.h"
#include "api/structs.h"
#include "haptics/signal_handler.h"
#include "session/device_hand.h"
#include "session/tool_bodies.h"

using namespace mvs::core;

struct mvs_device {
  mvs_device(const mvs_device_desc &desc, DriverPlugin::Log log) : device(desc, std::move(log)) {
    hand.set_hand({});
  }
  mutable Device device;
  Hand hand;
  bool latched = false;    // at the last sync
  bool restarted = false;  // since the last sync
  // the simulator of the last sync, and whether it still exists
  mvs_sim *sim = nullptr;
  std::weak_ptr<const int> alive;
  std::mutex viewing;  // protects the view of the device in the scene
};

namespace {

DriverPlugin::Log log_of(const mvs_device_desc &desc) {
  if (!desc.log) return {};
  return [log = desc.log, user = desc.user](mvs_log_level level, const char *text) {
    log(user, level, text);
  };
}

template <typename Work>
mvs_result device_at_boundary(mvs_device *device, Work &&work) noexcept {
  return at_boundary([&] {
    must_point(device, "device");
    work(*device);
  });
}

mvs_body_desc body_in_hand(const mvs_body_desc &given) {
  return given;
}

// The bodies of a hand that pushes with a convex tool; vertices that are no corners are dropped.
ToolShapePtr shape_of(const mvs_device_hand &hand) {
  if (hand.mode != MVS_HAND_MODE_CONVEX) return {};
  std::vector<std::string> warnings;
  const auto bodies =
      read_list(hand.bodies, hand.body_count, hand.body_stride, "hand.bodies", body_in_hand);
  return read_bodies(bodies, "hand", false, warnings);
}

mvs_device_desc read_device(const mvs_device_desc *given) {
  const mvs_device_desc desc = read_struct(given, "desc");
  must_point(desc.driver, "desc.driver");
  MVS_MUST(desc.clock <= MVS_CLOCK_VIRTUAL, MVS_E_ARGUMENT, "desc.clock",
           "desc.clock is %u: it has to be one of MVS_CLOCK_*", desc.clock);
  must_be_in(desc.rate, 100, 10000, "desc.rate");
  return desc;
}

mvs_device_state public_state(const ServoStatus &now, const DeviceView &view) {
  mvs_device_state out = {};
  out.phase = static_cast<uint32_t>(now.phase);
  out.cause = static_cast<uint32_t>(now.cause);
  out.flags = now.flags;
  out.limited = now.limited;
  out.buttons = now.buttons;
  out.time = now.time;
  write(view.to_scene(now.pose.position), out.position);
  write(view.turned(now.pose.orientation), out.orientation);
  write(view.scale() * view.turned(now.pose.velocity), out.velocity);
  write(now.pose.position, out.hand);
  write(now.force, out.force);
  write(now.torque, out.torque);
  out.rate = now.rate;
  out.worst_period = now.worst_period;
  out.model_age = now.model_age;
  out.energy = now.energy;
  out.heat = now.heat;
  out.ticks = now.ticks;
  out.late = now.late;
  out.bad_samples = now.bad_samples;
  out.sample_faults = now.sample_faults;
  return out;
}

// Takes the tools of the hand out of the simulator that it was in before; one at work keeps them.
void leave_other(mvs_device &d, const mvs_sim &next) {
  const auto alive = d.alive.lock();
  if (!alive || alive == next.alive) return;
  call_at_boundary(d.sim, [&](mvs_sim &s) { d.hand.leave(s); });
}

// Applies the buttons and the position of the hand to the simulator, then posts the tissue model to
// the servo loop. Before the first sample of the device the hand is nowhere: a tool at the centre
// of the workspace could lie on the other side of a leaflet. The part that the hand points at is
// searched only for a report.
void sync(mvs_device &d, mvs_sim &sim, mvs_device_report *report) {
  const ServoStatus now = d.device.status();
  ServoLinks &links = d.device.links();
  d.hand.begin(now, {d.device.limits().stiffness, d.device.limits().angular_stiffness});
  leave_other(d, sim);
  if (std::exchange(d.restarted, false)) d.hand.restart(sim);
  d.sim = &sim;
  d.alive = sim.alive;
  ButtonEvent event;
  while (links.buttons.pop(event)) d.hand.take_button(event, sim);
  if (now.phase == DevicePhase::stopped) {
    d.hand.restart(sim);
  } else {
    d.hand.settle_buttons(now, sim);
    if (now.has_pose) d.hand.follow(sim);
  }
  TissueModel tissue;
  if (now.has_pose) {
    tissue = d.hand.tissue(sim);
    links.tissue.post(tissue);
  }
  const bool is_latched = now.phase == DevicePhase::latched, was_latched = d.latched;
  d.latched = is_latched;
  if (report)
    write_struct(report, d.hand.report(sim, tissue, is_latched && !was_latched), "report");
}

}  // namespace

extern "C" {

mvs_result mvs_device_open(const mvs_device_desc *desc, mvs_device **device) {
  return at_boundary([&] {
    must_point(device, "device");
    const mvs_device_desc given = read_device(desc);
    *device = new mvs_device(given, log_of(given));
  });
}

void mvs_device_close(mvs_device *device) {
  // a refusal, as by a simulator at work, is not reported: the device is closed all the same
  if (device && !device->alive.expired()) {
    call_at_boundary(device->sim, [&](mvs_sim &s) { device->hand.leave(s); });
  }
  delete device;
}

mvs_result mvs_device_get_info(const mvs_device *device, mvs_device_info *info) {
  return at_boundary([&] {
    must_point(device, "device");
    write_struct(info, device->device.info(), "info");
  });
}

mvs_result mvs_device_set_limits(mvs_device *device, const mvs_device_limits *limits) {
  return device_at_boundary(
      device, [&](mvs_device &d) { d.device.set_limits(read_struct(limits, "limits")); });
}

mvs_result mvs_device_get_limits(const mvs_device *device, mvs_device_limits *limits) {
  return at_boundary([&] {
    must_point(device, "device");
    write_struct(limits, device->device.limits(), "limits");
  });
}

mvs_result mvs_device_set_view(mvs_device *device, const mvs_device_view *view) {
  return device_at_boundary(device, [&](mvs_device &d) {
    const mvs_device_view given = read_struct(view, "view");
    const std::lock_guard<std::mutex> lock(d.viewing);
    d.hand.set_view(given);
  });
}

mvs_result mvs_device_get_view(const mvs_device *device, mvs_device_view *view) {
  return at_boundary([&] {
    must_point(device, "device");
    write_struct(view, device->hand.view().get(), "view");
  });
}

mvs_result mvs_device_set_hand(mvs_device *device, const mvs_device_hand *hand) {
  return device_at_boundary(device, [&](mvs_device &d) {
    const mvs_device_hand read = read_struct(hand, "hand");
    d.hand.set_hand(read, shape_of(read));
  });
}

mvs_result mvs_device_get_hand(const mvs_device *device, mvs_device_hand *hand) {
  return at_boundary([&] {
    must_point(device, "device");
    write_struct(hand, device->hand.hand(), "hand");
  });
}

mvs_result mvs_device_start(mvs_device *device) {
  return device_at_boundary(device, [](mvs_device &d) {
    d.device.start();
    d.restarted = true;
  });
}

mvs_result mvs_device_stop(mvs_device *device) {
  return device_at_boundary(device, [](mvs_device &d) { d.device.stop(); });
}

mvs_result mvs_device_arm(mvs_device *device) {
  return device_at_boundary(device, [](mvs_device &d) { d.device.arm(); });
}

mvs_result mvs_device_cut(mvs_device *device) {
  return device_at_boundary(device, [](mvs_device &d) { d.device.cut(); });
}

mvs_result mvs_device_advance(mvs_device *device, double seconds) {
  return device_at_boundary(device, [&](mvs_device &d) { d.device.advance(seconds); });
}

mvs_result mvs_device_sync(mvs_device *device, mvs_sim *sim, mvs_device_report *report) {
  return call_at_boundary(sim, [&](mvs_sim &s) {
    must_point(device, "device");
    if (report) checked_struct_size(report, "report");
    sync(*device, s, report);
  });
}

mvs_result mvs_device_get_state(mvs_device *device, mvs_device_state *state) {
  return device_at_boundary(device, [&](mvs_device &d) {
    checked_struct_size(state, "state");
    const ServoStatus now = d.device.status();
    const std::lock_guard<std::mutex> lock(d.viewing);
    write_struct(state, public_state(now, d.hand.view()), "state");
  });
}

mvs_result mvs_device_take_samples(mvs_device *device, mvs_device_sample *samples, uint32_t stride,
                                   uint64_t capacity, uint64_t *count, uint64_t *lost) {
  return device_at_boundary(device, [&](mvs_device &d) {
    if (capacity > 0) must_point(samples, "samples");
    must_point(count, "count");
    must_point(lost, "lost");
    MVS_MUST(stride >= 8 && stride <= struct_size_limit && stride % 8 == 0, MVS_E_ARGUMENT,
             "stride", "stride is %u: set it to sizeof(mvs_device_sample)", stride);
    uint64_t taken = 0, missed = 0;
    mvs_device_sample sample;
    while (taken < capacity && d.device.links().trace.pop(sample, missed)) {
      write_element(samples, taken++, stride, sample);
    }
    *count = taken;
    *lost = missed;
  });
}

mvs_result mvs_device_handle_signals(uint32_t on) {
  return at_boundary([&] {
    MVS_MUST(on <= 1, MVS_E_ARGUMENT, "on", "on is %u: it has to be 0 or 1", on);
    install_signal_handler(on == 1);
  });
}

}  // extern "C"
