// Opens the shared memory of a window and checks its size and magic number.
#include "channel.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace mouse {

Channel::~Channel() {
  if (pointer_) munmap(const_cast<mouse_pointer *>(pointer_), sizeof *pointer_);
}

int32_t Channel::open(const std::string &name, driver::Fault &fault) {
  const int file = shm_open(name.c_str(), O_RDONLY, 0);
  if (file < 0)
    return fault.set(
        errno == EACCES ? MVS_DRIVER_E_PERMISSION : MVS_DRIVER_E_ABSENT,
        "there is no window's pointer in the shared memory \"%.100s\" (%s): the window "
        "has to create it first (haptic_drivers/mouse/pointer.h)",
        name.c_str(), std::strerror(errno));
  struct stat found = {};
  // A page behind the end of the memory would end the program with SIGBUS.
  const bool fits = fstat(file, &found) == 0 && found.st_size >= off_t{sizeof(mouse_pointer)};
  void *const place =
      fits ? mmap(nullptr, sizeof(mouse_pointer), PROT_READ, MAP_SHARED, file, 0) : MAP_FAILED;
  ::close(file);
  if (place != MAP_FAILED) pointer_ = static_cast<const mouse_pointer *>(place);
  if (pointer_ && __atomic_load_n(&pointer_->magic, __ATOMIC_ACQUIRE) == MOUSE_POINTER_MAGIC &&
      pointer_->size >= sizeof(mouse_pointer))
    return MVS_DRIVER_OK;
  return fault.set(
      MVS_DRIVER_E_OPTION,
      "the shared memory \"%.100s\" is not a mouse_pointer of version 1: the window has "
      "to publish it first (haptic_drivers/mouse/pointer.h)",
      name.c_str());
}

}  // namespace mouse
