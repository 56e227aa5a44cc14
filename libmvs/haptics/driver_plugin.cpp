// Search, trust check, negotiation and calls of driver plugins.
#include "haptics/driver_plugin.h"

#include <dlfcn.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>

#include "base/error.h"

namespace mvs::core {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds call_timeout{10000};  // calls may wait for a device
constexpr char ending[] = ".so";

// The folder mvs/drivers beside the library that contains this function.
std::filesystem::path drivers_folder() {
  Dl_info found = {};
  if (!dladdr(reinterpret_cast<const void *>(&result_of_driver), &found) || !found.dli_fname) {
    return {};
  }
  std::error_code unused;
  const auto library = std::filesystem::canonical(found.dli_fname, unused);
  return library.parent_path() / "mvs" / "drivers";
}

bool is_plain_name(const std::string &name) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  };
  return !name.empty() && std::all_of(name.begin(), name.end(), plain);
}

std::string path_of(const std::string &driver) {
  if (!driver.empty() && driver.front() == '/') return driver;
  MVS_MUST(is_plain_name(driver), MVS_E_ARGUMENT, "driver",
           "\"%s\" is neither the name of a driver (a-z, 0-9, _, -) nor an absolute path",
           driver.c_str());
  return drivers_folder() / (driver + ending);
}

// Refuses a file that another user could have written: its code runs inside the application.
void must_be_trusted(const std::string &path) {
  struct stat file = {};
  MVS_MUST(stat(path.c_str(), &file) == 0, MVS_E_IO, path,
           "there is no driver %s: mvs_get_driver gives the name of each installed one",
           path.c_str());
  MVS_MUST(S_ISREG(file.st_mode), MVS_E_IO, path, "%s is not a regular file", path.c_str());
  MVS_MUST((file.st_mode & S_IWOTH) == 0 && (file.st_uid == 0 || file.st_uid == geteuid()),
           MVS_E_IO, path,
           "%s is not loaded: it belongs to another user, or is writable by others; make it "
           "yours or root's, and chmod o-w",
           path.c_str());
}

std::map<std::string, std::string> read_options(const std::string &text) {
  std::map<std::string, std::string> options;
  for (size_t start = 0; start < text.size();) {
    const size_t end = std::min(text.find('\n', start), text.size());
    const std::string line = text.substr(start, end - start);
    start = end + 1;
    if (line.empty()) continue;
    const size_t equals = line.find('=');
    MVS_MUST(equals != std::string::npos && equals > 0, MVS_E_ARGUMENT, "options",
             "\"%s\" is not an option: each line has to be key=value", line.c_str());
    options[line.substr(0, equals)] = line.substr(equals + 1);
  }
  return options;
}

}  // namespace

mvs_result result_of_driver(int32_t code) {
  switch (code) {
    case MVS_DRIVER_E_OPTION:
      return MVS_E_ARGUMENT;
    case MVS_DRIVER_E_VERSION:
      return MVS_E_VERSION;
    case MVS_DRIVER_E_UNSUPPORTED:
      return MVS_E_UNSUPPORTED;
    default:
      return MVS_E_DEVICE;
  }
}

std::vector<DriverFile> installed_drivers() {
  std::vector<DriverFile> found;
  std::error_code failed;
  for (const auto &entry : std::filesystem::directory_iterator(drivers_folder(), failed)) {
    const std::filesystem::path &path = entry.path();
    if (path.extension() == ending) found.push_back({path.stem(), path});
  }
  std::sort(found.begin(), found.end(), [](auto &a, auto &b) { return a.name < b.name; });
  return found;
}

std::shared_ptr<DriverPlugin> DriverPlugin::load(const std::string &driver,
                                                 const std::string &options, Log log) {
  const std::string path = path_of(driver);
  must_be_trusted(path);
  std::shared_ptr<DriverPlugin> plugin(new DriverPlugin(std::filesystem::path(path).stem()));
  plugin->options_ = read_options(options);
  plugin->log_ = std::move(log);
  plugin->host_ = {sizeof(mvs_driver_host), MVS_DRIVER_VERSION, MVS_DRIVER_VERSION, 0, plugin.get(),
                   &DriverPlugin::option,   &DriverPlugin::log};
  try {
    plugin->negotiate(path);
    plugin->check_options();
  } catch (...) {
    plugin->silence();
    throw;
  }
  return plugin;
}

void DriverPlugin::check_options() const {
  for (const auto &[key, value] : options_) {
    bool known = false;
    for (const char *const *o = api_.options; o && *o; ++o) {
      known = known || (std::strncmp(*o, key.c_str(), key.size()) == 0 && (*o)[key.size()] == ':');
    }
    MVS_MUST(known, MVS_E_ARGUMENT, "options", "the driver %s has no option \"%s\"", name_.c_str(),
             key.c_str());
  }
}

// The table lies before bytes of a known pattern, which detects a driver that writes too
// much.
void DriverPlugin::negotiate(const std::string &path) {
  struct Room {
    mvs_driver_api api = {};
    std::array<unsigned char, 256> canary;
    int32_t code = MVS_DRIVER_E_INTERNAL;
    std::string wrong;
  };
  const auto room = std::make_shared<Room>();
  room->canary.fill(0xa5);
  room->api.struct_size = sizeof(mvs_driver_api);
  const auto ask = [room, path, self = shared_from_this()] {
    void *const library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!library) {
      const char *const why = dlerror();
      room->wrong = why ? why : "dlopen failed";
      return;
    }
    const auto function = dlsym(library, "mvs_driver_negotiate");
    if (!function) {
      room->wrong = "it exports no mvs_driver_negotiate";
      return;
    }
    room->code = reinterpret_cast<mvs_driver_negotiate_fn>(function)(&self->host_, &room->api);
  };
  MVS_MUST(worker_.run(ask, call_timeout), MVS_E_DEVICE, name_,
           "the driver %s does not come back from being loaded: do not use it", path.c_str());
  MVS_MUST(room->wrong.empty(), MVS_E_DEVICE, name_, "the driver cannot be loaded: %s",
           room->wrong.c_str());
  MVS_MUST(room->code == MVS_DRIVER_OK, MVS_E_VERSION, name_,
           "the driver %s speaks no version of the interface that this libmvs does (%u): get one "
           "that was made for it",
           path.c_str(), MVS_DRIVER_VERSION);
  const auto untouched = [](unsigned char c) { return c == 0xa5; };
  MVS_MUST(std::all_of(room->canary.begin(), room->canary.end(), untouched), MVS_E_DEVICE, name_,
           "the driver %s writes behind the struct that it was given: do not use it", path.c_str());
  api_ = room->api;
  check(path, sizeof(mvs_driver_api));
}

void DriverPlugin::check(const std::string &path, uint32_t room) const {
  MVS_MUST(api_.version == MVS_DRIVER_VERSION, MVS_E_VERSION, name_,
           "the driver %s reports version %u of the interface, which was not "
           "offered: get one that was made for version %u",
           path.c_str(), api_.version, MVS_DRIVER_VERSION);
  MVS_MUST(api_.struct_size == room, MVS_E_VERSION, name_,
           "the driver %s fills %u bytes of its table of functions, but version %u has %u",
           path.c_str(), api_.struct_size, api_.version, room);
  const bool polled = api_.read && api_.write;
  const char *missing = !api_.name             ? "name"
                        : !api_.open           ? "open"
                        : !api_.info           ? "info"
                        : !api_.start          ? "start"
                        : !api_.stop           ? "stop"
                        : !api_.close          ? "close"
                        : !api_.error          ? "error"
                        : !polled && !api_.run ? "read and write, nor run"
                                               : nullptr;
  MVS_MUST(!missing, MVS_E_DEVICE, name_, "the driver %s has no %s: it is not complete",
           path.c_str(), missing);
}

const char *DriverPlugin::option(void *host, const char *key) {
  if (!host || !key) return nullptr;
  const auto &options = static_cast<DriverPlugin *>(host)->options_;
  const auto found = options.find(key);
  return found == options.end() ? nullptr : found->second.c_str();
}

void DriverPlugin::log(void *host, const char *sentence) {
  if (!host || !sentence) return;
  DriverPlugin &self = *static_cast<DriverPlugin *>(host);
  const std::lock_guard<std::recursive_mutex> lock(self.logging_);
  if (self.log_ && !self.silent_) self.log_(MVS_LOG_INFO, sentence);
}

void DriverPlugin::silence() noexcept {
  const std::lock_guard<std::recursive_mutex> lock(logging_);
  silent_ = true;
}

DriverPlugin::Prepared DriverPlugin::prepare(mvs_driver_device *device, Work work) {
  const auto answer = std::make_shared<Answer>();
  return {answer, [answer, device, work = std::move(work), self = shared_from_this()] {
            answer->code = work(self->api_);
            if (answer->code >= 0) return;
            const char *const text = self->api_.error(device);
            answer->sentence = text ? text : "the driver does not say why";
          }};
}

bool DriverPlugin::run(Prepared prepared) {
  return prepared.call && worker_.run(std::move(prepared.call), call_timeout);
}

DriverPlugin::Answer DriverPlugin::ask(const char *what, mvs_driver_device *device, Work work) {
  Prepared prepared = prepare(device, std::move(work));
  const std::shared_ptr<Answer> answer = prepared.answer;
  if (run(std::move(prepared))) return *answer;
  return {
      MVS_DRIVER_E_LOST,
      format("the driver does not come back from %s(): unplug the device, and start anew", what)};
}

void DriverPlugin::call(const char *what, mvs_driver_device *device, Work work) {
  const Answer answer = ask(what, device, std::move(work));
  if (answer.code >= 0) return;
  fail(result_of_driver(answer.code), name_, "%s: %s", name_.c_str(), answer.sentence.c_str());
}

}  // namespace mvs::core
