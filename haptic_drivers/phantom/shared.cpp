// The vendor library, loaded once per process.
#include <chrono>
#include <memory>
#include <thread>

#include "common/library.h"
#include "common/locale.h"
#include "common/sentence.h"
#include "device.h"
#include "words.h"

namespace phantom {
namespace {

std::vector<std::string> candidates(const std::string &chosen) {
  if (!chosen.empty()) return {chosen};
  return {driver::below_variable("OH_SDK_BASE", "/lib/libHD.so"),
          driver::below_variable("OH_SDK_BASE", "/usr/lib/libHD.so"),
          "libHD.so.3.4",
          "libHD.so.3",
          "libHD.so",
          "/usr/lib/libHD.so",
          "/usr/lib64/libHD.so",
          "/usr/local/lib/libHD.so",
          "/usr/lib/x86_64-linux-gnu/libHD.so"};
}

// Compares a requested path with the loaded library.
int32_t compare_with_loaded(const std::string &chosen, std::string &sentence) {
  const driver::Library other = driver::load({chosen});
  if (!other.handle)
    return fail(sentence, MVS_DRIVER_E_LIBRARY, explain_load(chosen, other.there, other.why));
  if (other.handle == shared().library) return MVS_DRIVER_OK;
  return fail(sentence, MVS_DRIVER_E_OPTION,
              "library=" + chosen + ": " + shared().path +
                  " is loaded already, and OpenHaptics can be loaded only once: start again");
}

}  // namespace

Shared &shared() {
  // never destroyed: the vendor's thread may outlive main()
  static Shared *const all = new Shared;
  return *all;
}

Slot *slot_of(unsigned handle) {
  if (handle == kInvalidHandle) return nullptr;
  for (Slot &slot : shared().slots)
    if (slot.handle == handle) return &slot;
  return nullptr;
}

std::string option(const mvs_driver_host *host, const char *key) {
  const char *const value = host && host->option ? host->option(host->host, key) : nullptr;
  return value ? value : "";
}

int32_t load(const mvs_driver_host *host, std::string &sentence) {
  Shared &all = shared();
  const std::string chosen = option(host, "library");
  if (!chosen.empty() && chosen.front() != '/')
    return fail(sentence, MVS_DRIVER_E_OPTION,
                "library=" + chosen + " is not an absolute path: give the path from the root");
  if (broken())
    return fail(sentence, MVS_DRIVER_E_FAULT,
                "OpenHaptics did not come back from its last call: start this program again");
  if (all.library) return chosen.empty() ? MVS_DRIVER_OK : compare_with_loaded(chosen, sentence);
  const driver::DecimalPoint point;
  const driver::Library one = driver::load(candidates(chosen));
  if (!one.handle)
    return fail(sentence, MVS_DRIVER_E_LIBRARY, explain_load(one.path, one.there, one.why));
  Hdapi hd = {};
  const std::string missing = bind(one.handle, hd);
  if (!missing.empty())
    return fail(sentence, MVS_DRIVER_E_LIBRARY,
                one.path + " is not OpenHaptics 3: it has no " + missing);
  all.hd = hd;
  all.library = one.handle;
  all.path = one.path;
  return MVS_DRIVER_OK;
}

void call_with_timeout(void (*call)(unsigned), unsigned argument) {
  const auto returned = std::make_shared<std::atomic<bool>>(false);
  shared().returned = returned;
  std::thread([=] {
    call(argument);
    *returned = true;
  }).detach();
  for (int i = 0; i < 500 && !*returned; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
}

bool broken() {
  return shared().returned && !*shared().returned;
}

std::string &last_sentence() {
  thread_local std::string sentence;
  return sentence;
}

int32_t fail(std::string &where, int32_t code, std::string sentence) noexcept {
  where = std::move(sentence);
  return code;
}

}  // namespace phantom
