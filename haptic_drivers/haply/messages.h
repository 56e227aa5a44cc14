// JSON messages to and from the Haply Inverse Service; sources in README.md. No input or output.
#pragma once

#include <string>
#include <vector>

#include "common/fault.h"

namespace haply {

using driver::Fault;

struct Version {
  int major = 0, minor = 0;

  bool at_least(int wanted_major, int wanted_minor) const {
    return major != wanted_major ? major > wanted_major : minor >= wanted_minor;
  }
};

// Parses "3.5.0.0", the form of "project_version".
bool parse_version(const std::string &text, Version &version);
// Parses the answer to GET /version.
int32_t read_version(const std::string &answer, Version &version, Fault &fault);

struct Grip {
  std::string kind, id;  // the kind is the name of its list: "wireless_verse_grip"
  bool connected = true;
  unsigned buttons = 3;
};

struct Inverse {
  std::string id, type, serial, firmware, basis;
  bool calibrated = true, powered = true, in_use = false;
};

// The first frame after connecting: all devices with their descriptions.
struct Inventory {
  std::vector<Inverse> inverses;
  std::vector<Grip> grips;
};
int32_t read_inventory(const std::string &frame, Inventory &inventory, Fault &fault);

// State of the hand. Values absent from a frame keep their previous value.
struct Hand {
  double position[3] = {}, velocity[3] = {}, orientation[4] = {1, 0, 0, 0};
  bool has_velocity = false, calibrated = true, powered = true;
  uint32_t buttons = 0;
};
// Returns 1 if `frame` contains the device, 0 if not, otherwise an error code. The id of `grip` may
// be empty.
int32_t read_state(const std::string &frame, const std::string &device, const Grip &grip,
                   Hand &hand, Fault &fault);

// Messages to the service. force() only fills in three numbers, for use at the device's rate.
class Commands {
 public:
  Commands(const Version &version, const std::string &device);

  // The first message: session name, and the origin (`preset`, from 3.5 on; may be empty).
  std::string hello(const std::string &preset) const;
  // The result is valid until the next call; allocates only in the first call.
  const std::string &force(const double newton[3]);

 private:
  Version version_;
  std::string device_, text_;
  size_t numbers_ = 0;
};

}  // namespace haply
