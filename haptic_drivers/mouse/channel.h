// Read-only mapping of a window's mouse_pointer.
#pragma once

#include <string>

#include "common/fault.h"
#include "pointer.h"

namespace mouse {

class Channel {
 public:
  Channel() = default;
  ~Channel();
  Channel(const Channel &) = delete;
  Channel &operator=(const Channel &) = delete;

  // Maps the shared memory `name` ("/name", as of shm_open) and checks its struct.
  int32_t open(const std::string &name, driver::Fault &fault);

  // Valid after open().
  const mouse_pointer &pointer() const { return *pointer_; }

 private:
  const mouse_pointer *pointer_ = nullptr;
};

}  // namespace mouse
