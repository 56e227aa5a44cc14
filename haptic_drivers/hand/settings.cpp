// Reads and checks the options of the simulated hand.
#include "settings.h"

#include "common/recording_file.h"

namespace hand {

namespace {

using driver::Options;
using driver::refuse;

constexpr double kTwoPi = 6.283185307179586;
constexpr double kMost = 1e6;  // bound of options without a natural bound

Device held_device(const Options &options) {
  Device held = device(options.text("device").value_or("touch"));
  held.force = options.number("force", held.force, 0, kMost);
  held.continuous_force = options.number("continuous_force", held.continuous_force, 0, kMost);
  held.stiffness = options.number("stiffness", held.stiffness, 0, kMost);
  held.damping = options.number("damping", held.damping, 0, kMost);
  held.rate = options.number("rate", held.rate, 1, 1e5);
  held.resolution = options.number("resolution", held.resolution, 0, 0.01);
  held.mass = options.number("device_mass", held.mass, 0, 100);
  held.drag = options.number("device_damping", held.drag, 0, kMost);
  held.torque = options.number("torque", held.torque, 0, kMost);
  held.angular_stiffness = options.number("angular_stiffness", held.angular_stiffness, 0, kMost);
  held.angular_damping = options.number("angular_damping", held.angular_damping, 0, kMost);
  held.turn_resolution = options.number("turn_resolution", held.turn_resolution, 0, 0.1);
  held.inertia = options.number("device_inertia", held.inertia, 0, 1);
  if (held.torque > 0 && held.freedoms_in != 6)
    refuse(MVS_DRIVER_E_OPTION, "option torque: this device does not measure orientation");
  const double delay = options.number("delay", held.delay, 0, 16);
  if (delay != std::floor(delay))
    refuse(MVS_DRIVER_E_OPTION, "option delay: give a whole number of samples");
  held.delay = static_cast<unsigned>(delay);
  return held;
}

Script script_of(const Options &options) {
  Script script;
  if (const auto file = options.text("file")) {
    for (const char *key : {"target", "amplitude", "frequency", "turned", "turn_amplitude"})
      if (options.given(key))
        refuse(MVS_DRIVER_E_OPTION,
               std::string("option file: the file leads the hand; leave out ") + key);
    script.recording = driver::RecordingFile::load(*file);
    return script;
  }
  script.target = options.vector("target", {}, 1);
  script.amplitude = options.vector("amplitude", {}, 1);
  script.frequency = options.number("frequency", 0, 0, 1000);
  const bool swings = options.given("amplitude") || options.given("turn_amplitude");
  if (swings != options.given("frequency"))
    refuse(MVS_DRIVER_E_OPTION, "options amplitude and frequency: give both or neither");
  return script;
}

// Defaults: one person, measured at the handle of a haptic device; source in README.md.
Oscillator oscillator_of(const Options &options, const Device &held, const Script &script) {
  Oscillator o;
  o.mass = options.number("mass", 0.554, 0, 100) + held.mass;
  o.stiffness = options.number("arm_stiffness", 135, 0, kMost);
  o.arm_damping = options.number("arm_damping", 6.45, 0, kMost);
  o.damping = held.drag;
  o.swing = kTwoPi * script.frequency;
  // a smaller mass only makes the equation stiff
  if (o.mass < 1e-3)
    refuse(MVS_DRIVER_E_OPTION, "option mass: hand and device together weigh less than a gram");
  return o;
}

// Defaults: the order of a hand that holds a stylus; assumed.
Rotation rotation_of(const Options &options, const Device &held, const Script &script) {
  Rotation out;
  out.oscillator.mass = options.number("inertia", 2e-4, 0, 1) + held.inertia;
  out.oscillator.stiffness = options.number("wrist_stiffness", 1, 0, kMost);
  out.oscillator.arm_damping = options.number("wrist_damping", 0.02, 0, kMost);
  out.oscillator.damping = held.turn_drag;
  out.oscillator.swing = kTwoPi * script.frequency;
  out.from = options.vector("turned", {}, 3);
  out.amplitude = options.vector("turn_amplitude", {}, 3);
  if (out.oscillator.mass < 1e-6)
    refuse(MVS_DRIVER_E_OPTION, "option inertia: hand and device together have below 1e-6 kg m2");
  return out;
}

}  // namespace

Settings settings(const mvs_driver_host *host) {
  const Options options(host);
  Settings out;
  out.device = held_device(options);
  out.script = script_of(options);
  out.oscillator = oscillator_of(options, out.device, out.script);
  out.rotation = rotation_of(options, out.device, out.script);
  const auto &recording = out.script.recording;
  const driver::Vector begin = recording ? recording->at(0).position : out.script.target;
  out.from = options.vector("from", begin, 1);
  out.push = options.vector("push", {}, kMost);
  out.measures_velocity = options.number("velocity", 0, 0, 1) != 0;
  const auto buttons = driver::count(options.text("buttons").value_or("0"));
  if (!buttons) refuse(MVS_DRIVER_E_OPTION, "option buttons: give a sum of 1, 2, 4, ...");
  out.buttons = *buttons;
  out.faults = faults(options);
  return out;
}

}  // namespace hand
