// Search of /sys/bus/usb and of device files in /dev.
#include "common/usb.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace driver {
namespace {

namespace fs = std::filesystem;

std::string line_of(const fs::path &file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

bool matches(const std::string &id, const std::vector<std::string> &ids) {
  for (const std::string &wanted : ids)
    if (id.compare(0, wanted.size(), wanted) == 0) return true;
  return false;
}

// The device file that libusb opens.
std::string bus_file(const fs::path &device) {
  char file[64];
  std::snprintf(file, sizeof file, "/dev/bus/usb/%03d/%03d",
                std::atoi(line_of(device / "busnum").c_str()),   // NOLINT(cert-err34-c): 0 is
                std::atoi(line_of(device / "devnum").c_str()));  // NOLINT(cert-err34-c): no bus
  return file;
}

// Adds the serial ports (Touch USB) and raw HID files (Touch HID) of a device: the names below
// .../tty/ and .../hidraw/ of its interfaces.
void add_class_files(const fs::path &device, std::vector<std::string> &files) {
  std::error_code ignored;
  auto at = fs::recursive_directory_iterator(device, ignored);
  for (; !ignored && at != fs::recursive_directory_iterator(); at.increment(ignored)) {
    const std::string above = at->path().parent_path().filename().string();
    if (above == "tty" || above == "hidraw")
      files.push_back("/dev/" + at->path().filename().string());
    if (at.depth() > 4) at.disable_recursion_pending();
  }
}

std::string first_closed(const std::string &root, const fs::path &device) {
  std::vector<std::string> files = {bus_file(device)};
  add_class_files(device, files);
  for (const std::string &file : files) {
    const std::string path = root + file;
    if (access(path.c_str(), F_OK) == 0 && access(path.c_str(), R_OK | W_OK) != 0) return file;
  }
  return "";
}

}  // namespace

std::vector<UsbDevice> usb_devices(const std::string &root, const std::vector<std::string> &ids) {
  std::vector<UsbDevice> found;
  std::error_code ignored;
  for (const auto &entry : fs::directory_iterator(root + "/sys/bus/usb/devices", ignored)) {
    const std::string vendor = line_of(entry.path() / "idVendor");
    if (vendor.empty()) continue;  // an interface
    const std::string id = vendor + ":" + line_of(entry.path() / "idProduct");
    if (!matches(id, ids)) continue;
    // the entries are links to the devices
    const fs::path device = fs::canonical(entry.path(), ignored);
    found.push_back({id, line_of(device / "product"), first_closed(root, device)});
  }
  return found;
}

}  // namespace driver
