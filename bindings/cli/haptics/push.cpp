// The library renders only tissue, so a push is the pull of a taut chord of a closed valve: the
// gain of the hand sets its size, and the rotation of the view its direction. It therefore passes
// every limit that the forces of a surgery pass.
#include "haptics/push.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace cli {
namespace {

using Vector = std::array<double, 3>;

constexpr double sync_period = 0.005;          // s, between two calls of mvs_device_sync
constexpr double rise = 0.25, plateau = 0.25;  // s; a push falls as it rises
constexpr double pause = 0.25;                 // s, between two pushes
constexpr double slew_delay = 0.1;             // s, until the slew limit has let the force follow
constexpr double start_timeout = 5;            // s, for forces to start
constexpr double min_gain = 1e-3;              // of mvs_device_hand.gain

double dot(const Vector &a, const double *b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// The quaternion that rotates the unit vector `from` to `to`.
std::array<double, 4> turn(const Vector &from, const Vector &to) {
  const double cosine = dot(from, to.data());
  if (1 + cosine < 1e-9) {  // half a turn about any perpendicular axis
    const Vector other = std::abs(from[0]) < 0.9 ? Vector{1, 0, 0} : Vector{0, 1, 0};
    return {0, from[1] * other[2] - from[2] * other[1], from[2] * other[0] - from[0] * other[2],
            from[0] * other[1] - from[1] * other[0]};
  }
  return {1 + cosine, from[1] * to[2] - from[2] * to[1], from[2] * to[0] - from[0] * to[2],
          from[0] * to[1] - from[1] * to[0]};
}

// Runs the device in a loop with the simulator, and throws on Ctrl-C or latched forces.
class Pusher {
 public:
  Pusher(Session &session, TautChord &chord, Ticks &ticks)
      : session_(session), chord_(chord), ticks_(ticks) {}

  void begin();
  Push push(const std::string &direction, const Vector &axis, double force);

 private:
  void aim(const Vector &direction);
  void ask(double force);
  std::vector<mvs_device_sample> pass(double force);
  void pause_for(double seconds);

  Session &session_;
  TautChord &chord_;
  Ticks &ticks_;
};

// Sets the direction of the force, a unit vector in the frame of the device.
void Pusher::aim(const Vector &direction) {
  mvs_device_view view = {};
  const auto rotation = turn(direction, chord_.pull);
  std::copy(rotation.begin(), rotation.end(), view.rotation);
  session_.device().set_view(view);
}

// Sets the size of the force, N.
void Pusher::ask(double force) {
  const double gain = force / chord_.tension;
  mvs_device_hand hand = {};
  hand.mode = gain < min_gain ? MVS_HAND_MODE_LOOK : MVS_HAND_MODE_FEEL;
  hand.chord = chord_.id;
  hand.gain = gain < min_gain ? 0 : gain;
  session_.device().set_hand(hand);
  session_.device().sync(chord_.sim.get());
}

std::vector<mvs_device_sample> Pusher::pass(double force) {
  const uint64_t lost = session_.lost();
  ask(force);
  std::vector<mvs_device_sample> samples = session_.pass(sync_period);
  ticks_.take(samples, session_.lost() > lost);
  if (session_.is_interrupted()) {
    fail(MVS_E_CANCELLED, "force", "stopped by Ctrl-C; forces are off");
  }
  const mvs_device_state state = session_.device().state();
  if (state.phase == MVS_DEVICE_PHASE_LATCHED) {
    fail(MVS_E_DEVICE, "force",
         text("forces latched off (%s): %s", cause_of(state.cause).name,
              cause_of(state.cause).sentence));
  }
  return samples;
}

// Runs until gate and ramp let forces start.
void Pusher::begin() {
  session_.device().arm();
  const double begun = session_.elapsed();
  while (session_.device().state().phase != MVS_DEVICE_PHASE_ON) {
    pass(0);
    if (session_.elapsed() - begun < start_timeout) continue;
    fail(MVS_E_DEVICE, "force",
         text("forces did not start within %g s: hold the stylus in the middle of its workspace, "
              "out of its holder",
              start_timeout));
  }
}

void Pusher::pause_for(double seconds) {
  const auto syncs = static_cast<int>(std::ceil(seconds / sync_period));
  for (int k = 0; k < syncs; ++k) pass(0);
}

// Forces sent to the motors on the plateau, summed over the ticks.
struct PlateauForces {
  double along = 0, across = 0;
  size_t ticks = 0;

  void take(const std::vector<mvs_device_sample> &samples, const Vector &axis) {
    for (const mvs_device_sample &sample : samples) {
      const double *const f = sample.force;
      const double here = dot(axis, f), square = f[0] * f[0] + f[1] * f[1] + f[2] * f[2];
      along += here;
      across = std::max(across, std::sqrt(std::max(0.0, square - here * here)));
      ++ticks;
    }
  }
};

Push Pusher::push(const std::string &direction, const Vector &axis, double force) {
  Push made = {direction, force, 0, 0, 0, true};
  aim(axis);
  pause_for(pause);
  const double from = dot(axis, session_.device().state().hand);
  PlateauForces sent;
  const auto syncs = static_cast<int>(std::ceil((2 * rise + plateau) / sync_period));
  for (int k = 0; k < syncs; ++k) {
    const double t = k * sync_period;
    const double share = std::clamp(std::min(t, 2 * rise + plateau - t) / rise, 0.0, 1.0);
    const std::vector<mvs_device_sample> samples = pass(share * force);
    for (const mvs_device_sample &sample : samples) {
      made.moved_m = std::max(made.moved_m, dot(axis, sample.position) - from);
    }
    if (t < rise + slew_delay || t > rise + plateau - sync_period) continue;
    sent.take(samples, axis);
    const uint32_t flags = session_.device().state().flags;
    made.motors_on = made.motors_on && (flags & MVS_DRIVER_FLAG_FORCE_ON) != 0;
  }
  made.sent_N = sent.along / static_cast<double>(std::max<size_t>(1, sent.ticks));
  made.across_N = sent.across;
  return made;
}

}  // namespace

TautChord taut_chord() {
  TautChord found = {make_sim(), 0, 0, {}};
  mvs_parametric_desc small = {};
  small.shape = MVS_SHAPE_FOUNDING;
  small.vertices = 200;
  found.sim.generate(small);
  found.sim.set_load(120 * pa_per_mmhg);
  found.sim.settle();
  const mvs::Snapshot valve = found.sim.snapshot();
  const auto tensions = valve.view<double>(MVS_ARRAY_CHORD_TENSION);
  const auto tautest = std::max_element(tensions.begin(), tensions.end()) - tensions.begin();
  found.tension = tensions.begin()[tautest];
  found.id = valve.view<uint64_t>(MVS_ARRAY_CHORD_ID).begin()[tautest];
  const uint32_t *const ends = valve.view<uint32_t>(MVS_ARRAY_CHORD_NODES).row(tautest);
  const auto nodes = valve.view<double>(MVS_ARRAY_NODE_POSITION);
  for (int k = 0; k < 3; ++k) found.pull[k] = nodes.row(ends[0])[k] - nodes.row(ends[1])[k];
  const double length = std::sqrt(dot(found.pull, found.pull.data()));
  for (double &p : found.pull) p /= length;
  return found;
}

double push_of(const mvs_device_info &info) {
  return std::min(0.5, info.continuous_force / 4);
}

std::vector<Push> push_hand(Session &session, TautChord &chord, double push, Ticks &ticks) {
  static constexpr const char *names[] = {"+x", "-x", "+y", "-y", "+z", "-z"};
  mvs_device_limits limits = {};
  limits.force = push;
  session.device().set_limits(limits);
  Pusher pusher(session, chord, ticks);
  pusher.begin();
  std::vector<Push> pushes;
  for (size_t k = 0; k < 6; ++k) {
    Vector axis = {};
    axis[k / 2] = k % 2 == 0 ? 1 : -1;
    pushes.push_back(pusher.push(names[k], axis, push));
  }
  return pushes;
}

Json pushes_json(const std::vector<Push> &pushes) {
  Json all = Json::array();
  for (const Push &push : pushes) {
    all.push_back({{"direction", push.direction},
                   {"asked_N", push.asked_N},
                   {"sent_N", push.sent_N},
                   {"across_N", push.across_N},
                   {"moved_mm", 1e3 * push.moved_m},
                   {"motors_on", push.motors_on}});
  }
  return all;
}

std::string pushes_text(const std::vector<Push> &pushes) {
  std::string lines;
  for (const Push &push : pushes) {
    lines += text(
        "  push %s  asked %.3f N, sent to the motors %.3f N (%.3f N across), hand moved %.2f "
        "mm%s\n",
        push.direction.c_str(), push.asked_N, push.sent_N, push.across_N, 1e3 * push.moved_m,
        push.motors_on ? "" : "; the device reports that its motors did NOT follow");
  }
  return lines;
}

}  // namespace cli
