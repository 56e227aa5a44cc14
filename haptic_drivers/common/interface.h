// What every driver in C++ does where it meets libmvs: sizes, versions, and sentences for failures.
#pragma once

#include <mvs/driver.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <exception>
#include <string>

namespace driver {

// Thrown while a device is listed, looked at or opened; never at the device's rate, never outside.
struct Refusal {
  int32_t code;
  std::string sentence;
};

[[noreturn]] inline void refuse(int32_t code, std::string sentence) {
  throw Refusal{code, std::move(sentence)};
}

// Gives as much of a struct as its reader has room for; the reader's struct_size stays.
template <class T>
void give(T full, T *out) {
  full.struct_size = out->struct_size;
  std::memcpy(out, &full, std::min<std::size_t>(full.struct_size, sizeof full));
}

// Takes as much of a struct as its writer filled; the rest is zero.
template <class T>
T take(const T *in) {
  T full = {};
  std::memcpy(&full, in, std::min<std::size_t>(in->struct_size, sizeof full));
  return full;
}

// The handshake: `ours` is handed over if both sides know version 1 and the host has room for it.
inline int32_t negotiate(const mvs_driver_host *host, mvs_driver_api *api,
                         const mvs_driver_api &ours) {
  const std::size_t first_version = offsetof(mvs_driver_api, error) + sizeof api->error;
  if (!host || !api || host->struct_size < offsetof(mvs_driver_host, reserved) ||
      host->oldest > MVS_DRIVER_VERSION || host->newest < MVS_DRIVER_VERSION ||
      api->struct_size < first_version)
    return MVS_DRIVER_E_VERSION;
  const std::size_t filled = std::min<std::size_t>(api->struct_size, sizeof ours);
  std::memcpy(api, &ours, filled);
  api->struct_size = static_cast<uint32_t>(filled);
  api->version = MVS_DRIVER_VERSION;
  return MVS_DRIVER_OK;
}

// The sentence of the last list, doctor or open that failed on this thread.
inline thread_local char last_sentence[768] = "";

// Does what may refuse, and says why it did.
template <class Work>
int32_t guarded(Work &&work) {
  last_sentence[0] = 0;
  try {
    work();
    return MVS_DRIVER_OK;
  } catch (const Refusal &refusal) {
    std::snprintf(last_sentence, sizeof last_sentence, "%s", refusal.sentence.c_str());
    return refusal.code;
  } catch (const std::exception &error) {
    std::snprintf(last_sentence, sizeof last_sentence, "out of means: %s", error.what());
    return MVS_DRIVER_E_INTERNAL;
  }
}

}  // namespace driver
