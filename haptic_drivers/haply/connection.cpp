// Reads the options and connects to the service.
#include "connection.h"

#include "common/options.h"
#include "http.h"

namespace haply {
namespace {

// Timeout of each step of open(), ms.
constexpr int kOpenMs = 1000;

}  // namespace

Options::Options(const mvs_driver_host *application) {
  const driver::Options given(application);
  const auto text = [&](const char *key, const char *otherwise) {
    return given.text(key).value_or(otherwise);
  };
  host = text("host", "localhost");
  device = text("device", "");
  grip = text("grip", "");
  preset = text("preset", "arm_front_centered");
  if (preset == "none") preset.clear();
  version = text("version", "");
  Version read;
  if (!version.empty() && !parse_version(version, read))
    driver::refuse(MVS_DRIVER_E_OPTION, "option version=" + version + ": give one like 3.5");
  port = static_cast<int>(given.number("port", 10001, 1, 65535));
  rate = given.number("rate", 2000, 50, 8000);
  timeout_ms = static_cast<int>(given.number("patience", MVS_DRIVER_PATIENCE_MS, 10, 2000));
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
                     "the Haply Inverse Service reported no device for %d ms: "
                     "restart it (systemctl restart haply-inverse-service)",
                     kOpenMs);
  return result == 1 ? read_inventory(text, inventory, fault) : result;
}

}  // namespace haply
