// `mvs haptics doctor`: checks the requirements of a haptic device; exit code 1 for a fault.
#include <pthread.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <thread>

#include "haptics/device.h"
#include "haptics/haptics.h"

namespace cli {
namespace {

constexpr int priority = 60;  // SCHED_FIFO priority that the library requests

// A finding about "system" or about the named driver.
struct DoctorRow {
  std::string about;
  mvs::DriverFinding finding;
};

// Requests the priority in a separate thread, as the library does.
bool may_be_realtime() {
  bool granted = false;
  std::thread([&granted] {
    sched_param wanted = {};
    wanted.sched_priority = priority;
    granted = pthread_setschedparam(pthread_self(), SCHED_FIFO, &wanted) == 0;
  }).join();
  return granted;
}

mvs::DriverFinding realtime() {
  if (may_be_realtime()) return {1, "real-time priority", text("SCHED_FIFO %d granted", priority)};
  rlimit allowed = {};
  getrlimit(RLIMIT_RTPRIO, &allowed);
  const std::string why =
      allowed.rlim_cur >= priority
          ? text(
                "RLIMIT_RTPRIO is %d, but the system refuses SCHED_FIFO %d: a container or a "
                "control group without a real-time budget?",
                priority, priority)
          : text(
                "RLIMIT_RTPRIO is %llu, and %d is needed: write the line \"@audio - rtprio %d\" "
                "(or another group, or your name without @) into "
                "/etc/security/limits.d/mvs.conf, join that group, and log in again",
                static_cast<unsigned long long>(allowed.rlim_cur), priority, priority);
  return {-1, "real-time priority", why + "; without it other programs disturb the forces"};
}

mvs::DriverFinding processors() {
  const unsigned count = std::thread::hardware_concurrency();
  const bool enough = count != 1;
  return {enough ? 1 : -1, "processors",
          enough ? text("%u", count)
                 : "only one: servo and simulation share it, which disturbs the forces"};
}

mvs::DriverFinding library() {
  const uint32_t v = mvs_version();
  return {1, "library",
          text("libmvs %u.%u.%u (%s), drivers of version %u", v / 10000, v / 100 % 100, v % 100,
               mvs_features(), MVS_DRIVER_VERSION)};
}

// Findings of the named driver, or of every installed driver. A driver that cannot be loaded is a
// finding too.
std::vector<DoctorRow> driver_rows(const DeviceOptions &options) {
  std::vector<DoctorRow> rows;
  if (options.driver.empty()) {
    for (mvs::DriverFinding &found : mvs::findings_of()) {
      const size_t colon = found.check.find(": ");
      const std::string name = found.check.substr(0, colon);
      found.check.erase(0, colon + 2);
      rows.push_back({name, std::move(found)});
    }
    return rows;
  }
  try {
    for (mvs::DriverFinding &found : with_list_named(
             [&] { return mvs::findings_of(driver_of(options), lines_of(options.options)); })) {
      rows.push_back({options.driver, std::move(found)});
    }
  } catch (const mvs::Error &failure) {
    rows.push_back({options.driver, {0, "driver", failure.what()}});
  }
  return rows;
}

std::vector<DoctorRow> examine(const DeviceOptions &options) {
  std::vector<DoctorRow> rows = {
      {"system", library()}, {"system", processors()}, {"system", realtime()}};
  for (DoctorRow &row : driver_rows(options)) rows.push_back(std::move(row));
  if (options.driver.empty() && mvs::drivers().empty()) {
    rows.push_back(
        {"system",
         {0, "drivers", "no driver is installed in the folder mvs/drivers beside the library"}});
  }
  return rows;
}

const char *word_of(int32_t verdict) {
  return verdict == 2 ? "note" : verdict > 0 ? "good" : verdict < 0 ? "warning" : "fault";
}

std::string rows_text(const std::vector<DoctorRow> &rows) {
  std::string lines;
  for (const DoctorRow &row : rows) {
    const mvs::DriverFinding &found = row.finding;
    lines += text("%s%-7s  %-14s %s: %s", lines.empty() ? "" : "\n", word_of(found.verdict),
                  row.about.c_str(), found.check.c_str(), found.sentence.c_str());
  }
  return lines;
}

Json rows_json(const std::vector<DoctorRow> &rows) {
  Json all = Json::array();
  for (const DoctorRow &row : rows) {
    all.push_back({{"about", row.about},
                   {"verdict", word_of(row.finding.verdict)},
                   {"check", row.finding.check},
                   {"sentence", row.finding.sentence}});
  }
  return all;
}

void run_doctor(const DeviceOptions &options, Console &console) {
  const std::vector<DoctorRow> rows = examine(options);
  const auto count = [&](int32_t verdict) {
    return std::count_if(rows.begin(), rows.end(),
                         [&](const DoctorRow &row) { return row.finding.verdict == verdict; });
  };
  print(console, {{"faults", count(0)}, {"warnings", count(-1)}, {"findings", rows_json(rows)}},
        rows_text(rows));
  if (count(0) == 0) return;
  std::fprintf(stderr, "mvs: %td of %zu findings are faults\n", count(0), rows.size());
  console.exit_code = 1;
}

}  // namespace

void add_haptics_doctor(CLI::App &haptics, Console &console) {
  const auto [command, options] =
      add_command<DeviceOptions>(haptics, console, "doctor",
                                 "check the requirements of a device; exit code 1 for a fault; "
                                 "without --driver: of every installed driver",
                                 run_doctor);
  add_driver_options(*command, *options);
}

}  // namespace cli
