#include "haptics/device.h"

#include <algorithm>
#include <filesystem>
#include <thread>

namespace cli {
namespace {

mvs::Device open_device(const DeviceOptions &options) {
  const std::string driver = driver_of(options), lines = lines_of(options.options);
  mvs_device_desc desc = {};
  desc.clock = options.is_virtual ? MVS_CLOCK_VIRTUAL : MVS_CLOCK_REAL;
  desc.driver = driver.c_str();
  desc.device = options.device.empty() ? nullptr : options.device.c_str();
  desc.options = lines.c_str();
  desc.rate = options.rate;
  desc.log = log_to_stderr;
  return with_list_named([&] { return mvs::Device(desc); });
}

CLI::Validator key_and_value() {
  return CLI::Validator(
      [](const std::string &given) {
        const bool good = given.find('=', 1) != given.npos && given.find('\n') == given.npos;
        return good ? std::string() : "'" + given + "' is not a driver option: give key=value";
      },
      "KEY=VALUE");
}

}  // namespace

CLI::Option *add_driver_options(CLI::App &command, DeviceOptions &options) {
  CLI::Option *driver = command.add_option("--driver", options.driver,
                                           "name of an installed driver, or path of a driver");
  command
      .add_option("--option", options.options, "option of the driver, key=value; may be repeated")
      ->check(key_and_value())
      ->allow_extra_args(false)
      ->needs(driver);
  return driver;
}

void add_device_options(CLI::App &command, DeviceOptions &options) {
  add_driver_options(command, options)->required();
  command.add_option("--device", options.device, "name from mvs haptics list [the first]");
  command.add_option("--rate", options.rate, "rate of a polled device, Hz [its default]")
      ->check(CLI::Range(100.0, 10000.0));
  command.add_flag("--virtual", options.is_virtual,
                   "use a clock that does not wait, for simulated devices");
}

std::string driver_of(const DeviceOptions &options) {
  const bool is_path = options.driver.find('/') != std::string::npos;
  return is_path ? std::filesystem::absolute(options.driver).string() : options.driver;
}

std::string lines_of(const std::vector<std::string> &options) {
  std::string lines;
  for (const std::string &option : options) lines += option + "\n";
  return lines;
}

Interruptions::Interruptions() {
  mvs::must(mvs_device_handle_signals(1));
}

Interruptions::~Interruptions() {
  mvs_device_handle_signals(0);
}

Session::Session(const DeviceOptions &options)
    : is_virtual_(options.is_virtual), device_(open_device(options)) {}

void Session::start() {
  device_.start();
  begin_ = std::chrono::steady_clock::now();
}

double Session::elapsed() const {
  if (is_virtual_) return advanced_s_;
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

std::vector<mvs_device_sample> Session::pass(double seconds) {
  if (is_virtual_) {
    device_.advance(seconds);
    advanced_s_ += seconds;
  } else {
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  }
  return device_.take_samples(lost_);
}

bool Session::is_over() const {
  return is_interrupted() || device_.state().phase == MVS_DEVICE_PHASE_LATCHED;
}

Cause cause_of(uint32_t cause) {
  static constexpr Cause causes[] = {
      {"none", "nothing is wrong"},
      {"button", "forces were switched off at the device"},
      {"velocity", "the hand moved too fast or jumped"},
      {"watchdog", "the device did not answer in time"},
      {"software", "a program requested it, or the recording ended"},
      {"unplugged", "the device was disconnected"},
      {"deadman", "the device is not held"},
      {"not_finite", "a value was not finite"},
      {"thermal", "the motors are too warm, or the device is broken"},
      {"calibration", "the device is not calibrated"}};
  return cause < std::size(causes) ? causes[cause] : Cause{"unknown", "the cause is unknown"};
}

Json info_json(const mvs_device_info &info) {
  const auto box = [](const double *corner) { return Json{corner[0], corner[1], corner[2]}; };
  return {{"driver", info.driver},
          {"model", info.model},
          {"serial", info.serial},
          {"firmware", info.firmware},
          {"freedoms_in", info.freedoms_in},
          {"freedoms_out", info.freedoms_out},
          {"buttons", info.buttons},
          {"workspace_min_m", box(info.workspace_min)},
          {"workspace_max_m", box(info.workspace_max)},
          {"peak_force_N", info.peak_force},
          {"continuous_force_N", info.continuous_force},
          {"max_stiffness_N_m", info.max_stiffness},
          {"max_damping_N_s_m", info.max_damping},
          {"max_speed_m_s", info.max_speed},
          {"rate_Hz", info.rate},
          {"peak_torque_N_m", info.peak_torque},
          {"continuous_torque_N_m", info.continuous_torque},
          {"max_angular_stiffness_N_m_rad", info.max_angular_stiffness},
          {"max_angular_damping_N_m_s_rad", info.max_angular_damping}};
}

std::string info_text(const mvs_device_info &info) {
  std::string lines = text("%s, driver %s", info.model[0] ? info.model : "device", info.driver);
  if (info.serial[0]) lines += text(", serial %s", info.serial);
  if (info.firmware[0]) lines += text(", firmware %s", info.firmware);
  double size[3];
  for (int k = 0; k < 3; ++k) size[k] = 1e3 * (info.workspace_max[k] - info.workspace_min[k]);
  lines += text("\n  %u freedoms in, %u out, %u buttons", info.freedoms_in, info.freedoms_out,
                info.buttons);
  if (size[0] > 0) lines += text(", workspace %.0f x %.0f x %.0f mm", size[0], size[1], size[2]);
  if (info.freedoms_out == 0) return lines + text(", %g Hz, no force\n", info.rate);
  lines += text("\n  %g N peak, %g N continuous, %g N/m, %g N s/m, %g Hz\n", info.peak_force,
                info.continuous_force, info.max_stiffness, info.max_damping, info.rate);
  if (info.peak_torque > 0)
    lines +=
        text("  %g N m peak, %.2g N m continuous, %.2g N m/rad, %.2g N m s/rad\n", info.peak_torque,
             info.continuous_torque, info.max_angular_stiffness, info.max_angular_damping);
  return lines;
}

}  // namespace cli
