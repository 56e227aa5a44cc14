// Fixture: the side of the window in the channel of the driver mouse.
#pragma once

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <stdexcept>
#include <string>

#include "haptic_drivers/mouse/pointer.h"

class MouseWindow {
 public:
  MouseWindow() {
    static int count = 0;
    name_ = "/mvs-test-mouse-" + std::to_string(getpid()) + "-" + std::to_string(++count);
    file_ = shm_open(name_.c_str(), O_RDWR | O_CREAT | O_EXCL, 0600);
    if (file_ < 0) throw std::runtime_error("no shared memory");
    resize(sizeof(mouse_pointer));
    void *const place =
        mmap(nullptr, sizeof(mouse_pointer), PROT_READ | PROT_WRITE, MAP_SHARED, file_, 0);
    if (place == MAP_FAILED) throw std::runtime_error("no mapping of shared memory");
    pointer_ = static_cast<mouse_pointer *>(place);
    mouse_pointer_publish(pointer_);
  }
  ~MouseWindow() {
    unlink();
    munmap(pointer_, sizeof *pointer_);
    close(file_);
  }
  MouseWindow(const MouseWindow &) = delete;
  MouseWindow &operator=(const MouseWindow &) = delete;

  const std::string &name() const { return name_; }
  mouse_pointer &pointer() { return *pointer_; }
  void point(double x, double y, double z, uint32_t buttons = 0) {
    const double at[3] = {x, y, z};
    mouse_pointer_write(pointer_, at, buttons);
  }
  void resize(off_t bytes) {
    if (ftruncate(file_, bytes) != 0) throw std::runtime_error("no room in shared memory");
  }
  void unlink() { shm_unlink(name_.c_str()); }

 private:
  std::string name_;
  int file_ = -1;
  mouse_pointer *pointer_ = nullptr;
};
