// A driver plugin: loads a shared library, negotiates the interface version, checks its function
// table, and calls it with a timeout. Only a file that its owner alone can write is loaded. A
// library is never unloaded, because vendors' libraries do not support it.
#pragma once

#include <mvs/device.h>

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "haptics/worker.h"

namespace mvs::core {

struct DriverFile {
  std::string name, path;
};

// Returns the drivers in the folder mvs/drivers beside libmvs, sorted by name.
std::vector<DriverFile> installed_drivers();

class DriverPlugin : public std::enable_shared_from_this<DriverPlugin> {
 public:
  using Log = std::function<void(mvs_log_level level, const char *text)>;

  // `driver` is a name in that folder or an absolute path; options are "key=value" lines. Throws
  // MVS_E_IO, _ARGUMENT, _VERSION or _DEVICE.
  static std::shared_ptr<DriverPlugin> load(const std::string &driver, const std::string &options,
                                            Log log);

  const mvs_driver_api &api() const { return api_; }
  const std::string &name() const { return name_; }
  const mvs_driver_host *host() const { return &host_; }
  // Passes no further message to the log; waits for one that is being received.
  void silence() noexcept;
  // Leaves this library loaded for ever: a thread hangs in the driver.
  void keep_library() { worker_.keep_library(); }

  struct Answer {
    int32_t code = MVS_DRIVER_E_INTERNAL;  // MVS_DRIVER_*
    std::string sentence;                  // the driver's error message if the code is a failure
  };
  using Work = std::function<int32_t(const mvs_driver_api &)>;
  // A call that is ready to be made: run() allocates nothing.
  struct Prepared {
    std::shared_ptr<Answer> answer;
    std::function<void()> call;
  };
  Prepared prepare(mvs_driver_device *device, Work work);
  // False if it does not return in time, or was made before.
  bool run(Prepared prepared);

  // Calls work(api) on the worker thread. After a failure the error message is read from `device`.
  // A call that does not return in 10 s gives MVS_DRIVER_E_LOST; the work must own all data it
  // uses.
  Answer ask(const char *what, mvs_driver_device *device, Work work);
  // The same, but throws on failure.
  void call(const char *what, mvs_driver_device *device, Work work);

 private:
  explicit DriverPlugin(const std::string &name) : name_(name), worker_(name) {}
  void negotiate(const std::string &path);
  void check(const std::string &path, uint32_t room) const;
  void check_options() const;
  static const char *option(void *host, const char *key);
  static void log(void *host, const char *sentence);

  std::string name_;
  std::map<std::string, std::string> options_;
  Log log_;
  // Protects `silent_`, and is held during a message; a message may lead to another one.
  std::recursive_mutex logging_;
  bool silent_ = false;
  mvs_driver_host host_ = {};
  mvs_driver_api api_ = {};
  Worker worker_;
};

// Maps a driver's error code to MVS_E_VERSION, _ARGUMENT, _UNSUPPORTED or _DEVICE.
mvs_result result_of_driver(int32_t code);

}  // namespace mvs::core
