// A driver, loaded and distrusted. Its path is one that only its owner can write; it is asked for
// its table of functions once, and the table is checked for what must be there. A driver is never
// unloaded: vendors' libraries do not bear it.
#pragma once

#include <mvs/device.h>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "haptics/worker.h"

namespace mvs::core {

struct DriverFile {
  std::string name, path;
};

// The drivers in the folder beside the library, by name.
std::vector<DriverFile> installed_drivers();

class DriverPlugin : public std::enable_shared_from_this<DriverPlugin> {
 public:
  using Log = std::function<void(mvs_log_level level, const char *text)>;

  // `driver` is a name in that folder or an absolute path; options are "key=value" lines. Throws.
  static std::shared_ptr<DriverPlugin> load(const std::string &driver, const std::string &options,
                                            Log log);

  const mvs_driver_api &api() const { return api_; }
  const std::string &name() const { return name_; }
  const mvs_driver_host *host() const { return &host_; }

  struct Answer {
    int32_t code = MVS_DRIVER_E_INTERNAL;  // MVS_DRIVER_*
    std::string sentence;                  // the driver's own, where the code is a failure
  };
  using Work = std::function<int32_t(const mvs_driver_api &)>;
  // Calls work(api) on the worker; `device` is whom the sentence is asked of. One that does not
  // come back is lost. What the work uses has to be owned by it.
  Answer ask(const char *what, mvs_driver_device *device, Work work);
  // The same where a failure is thrown.
  void call(const char *what, mvs_driver_device *device, Work work);

 private:
  DriverPlugin() = default;
  void negotiate(const std::string &path);
  void check(const std::string &path, uint32_t room) const;
  static const char *option(void *host, const char *key);
  static void log(void *host, const char *sentence);

  std::string name_;
  std::map<std::string, std::string> options_;
  Log log_;
  mvs_driver_host host_ = {};
  mvs_driver_api api_ = {};
  Worker worker_;
};

// What a driver's code means to who calls libmvs: MVS_E_VERSION, MVS_E_ARGUMENT or MVS_E_DEVICE.
mvs_result result_of_driver(int32_t code);

}  // namespace mvs::core
