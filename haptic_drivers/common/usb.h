// Connected USB devices of a vendor, and whether this user may open them (Linux).
#pragma once
#include <string>
#include <vector>

namespace driver {

struct UsbDevice {
  std::string id;      // "2988:0304"
  std::string name;    // product name; may be empty
  std::string closed;  // its first device file without write permission; empty: all are writable
};

// Returns the devices whose id begins with one of `ids` ("2988:", "0403:cb48"). `root` is the
// folder that contains /sys and /dev, "" except in tests.
std::vector<UsbDevice> usb_devices(const std::string &root, const std::vector<std::string> &ids);

}  // namespace driver
