// Which devices of a vendor are plugged in, and whether this user may talk to them (Linux).
#pragma once
#include <string>
#include <vector>

namespace driver {

struct UsbDevice {
  std::string id;      // "2988:0304"
  std::string name;    // what it says of itself; may be empty
  std::string closed;  // the first of its files that this user may not write; empty: all are open
};

// Those whose id begins with one of `ids` ("2988:", "0403:cb48"); `root` is what lies above /sys
// and /dev, "" but in tests.
std::vector<UsbDevice> usb_devices(const std::string &root, const std::vector<std::string> &ids);

}  // namespace driver
