#include "connection.h"

#include <charconv>
#include <cstring>

#include "http.h"

namespace haply {
namespace {

// For what is done before the device's rate counts.
constexpr int kOpenMs = 1000;

const char *given(const mvs_driver_host *host, const char *key) {
  return host->option ? host->option(host->host, key) : nullptr;
}

int32_t number(const mvs_driver_host *host, const char *key, double least, double most,
               double &value, Fault &fault) {
  const char *text = given(host, key);
  if (!text) return MVS_DRIVER_OK;
  double told = 0;
  const char *end = text + std::strlen(text);
  const auto read = std::from_chars(text, end, told);
  if (read.ec != std::errc() || read.ptr != end || !(told >= least && told <= most))
    return fault.set(MVS_DRIVER_E_OPTION, "option %s is '%.80s': give a number from %g to %g", key,
                     text, least, most);
  value = told;
  return MVS_DRIVER_OK;
}

}  // namespace

int32_t read_options(const mvs_driver_host *host, Options &options, Fault &fault) {
  struct Text {
    const char *key;
    std::string *value;
  };
  for (const Text &text :
       {Text{"host", &options.host}, Text{"device", &options.device}, Text{"grip", &options.grip},
        Text{"preset", &options.preset}, Text{"version", &options.version}})
    if (const char *told = given(host, text.key)) *text.value = told;
  if (options.preset == "none") options.preset.clear();
  double port = options.port, patience = options.patience_ms;
  int32_t result = number(host, "port", 1, 65535, port, fault);
  if (result == MVS_DRIVER_OK) result = number(host, "rate", 50, 8000, options.rate, fault);
  if (result == MVS_DRIVER_OK) result = number(host, "patience", 10, 2000, patience, fault);
  options.port = static_cast<int>(port);
  options.patience_ms = static_cast<int>(patience);
  Version version;
  if (result == MVS_DRIVER_OK && !options.version.empty() &&
      !parse_version(options.version, version))
    return fault.set(MVS_DRIVER_E_OPTION, "option version is '%.80s': give one like 3.5",
                     options.version.c_str());
  return result;
}

int32_t Connection::open(const Options &options, Fault &fault) {
  std::string text;
  int32_t result = MVS_DRIVER_OK;
  if (!parse_version(options.version, version)) {
    result = http_get(options.host.c_str(), options.port, "/version", text, fault);
    if (result == MVS_DRIVER_OK) result = read_version(text, version, fault);
  }
  if (result != MVS_DRIVER_OK) return result;
  if (!version.at_least(3, 1))
    return fault.set(MVS_DRIVER_E_UNSUPPORTED,
                     "the Haply Inverse Service is version %d.%d: install 3.1 or later",
                     version.major, version.minor);
  result = socket.open(options.host.c_str(), options.port, kOpenMs, fault);
  if (result != MVS_DRIVER_OK) return result;
  result = socket.receive(text, kOpenMs, fault);
  if (result == 0)
    return fault.set(MVS_DRIVER_E_LOST,
                     "the Haply Inverse Service tells of no device in %d ms: "
                     "restart it (systemctl restart haply-inverse-service)",
                     kOpenMs);
  return result == 1 ? read_inventory(text, inventory, fault) : result;
}

}  // namespace haply
