// The calls that a driver of tests/haptics/liars has received.
#pragma once

#include <dlfcn.h>
#include <mvs/driver.h>

#include <string>

namespace mvs::core::test {

// As in liar.c.
struct Asked {
  mvs_driver_force last;  // written
  int stops, panics;
};

inline Asked asked_of(const std::string &driver) {
  Asked now = {};
  reinterpret_cast<void (*)(Asked *)>(
      dlsym(dlopen(driver.c_str(), RTLD_NOW | RTLD_LOCAL), "mvs_liar_asked"))(&now);
  return now;
}

}  // namespace mvs::core::test
