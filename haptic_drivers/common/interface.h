// Helpers for drivers in C++ at the interface to libmvs: struct sizes, handshake, error messages.
#pragma once

#include <mvs/driver.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <exception>
#include <string>

namespace driver {

// Thrown by list, doctor and open; never at the device's rate, and never out of the driver.
struct Refusal {
  int32_t code;
  std::string sentence;
};

[[noreturn]] inline void refuse(int32_t code, std::string sentence) {
  throw Refusal{code, std::move(sentence)};
}

// Copies a struct to a reader, up to the reader's struct_size, which it keeps.
template <class T>
void give(T full, T *out) {
  full.struct_size = out->struct_size;
  std::memcpy(out, &full, std::min<std::size_t>(full.struct_size, sizeof full));
}

// Copies a struct of a writer, up to the writer's struct_size; the rest is zero.
template <class T>
T take(const T *in) {
  T full = {};
  std::memcpy(&full, in, std::min<std::size_t>(in->struct_size, sizeof full));
  return full;
}

// Handshake: copies `ours` if both sides support this version and the host has room for it.
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

// The error message of the last failed list, doctor or open on this thread.
inline thread_local char last_sentence[768] = "";

// Runs `work`; turns exceptions into an error code and last_sentence.
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
